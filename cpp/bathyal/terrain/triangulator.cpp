// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/terrain/triangulator.hpp"

#include <cstddef>

namespace bathyal {
namespace {

constexpr std::array<std::int32_t, 3> kNext{1, 2, 0};
constexpr std::array<std::int32_t, 3> kPrevious{2, 0, 1};

class Triangulator {
 public:
  Triangulator(std::span<const Point2> points, std::span<const std::int32_t> vertices)
      : points_(points.data()), vertices_(vertices) {}

  std::vector<LinkedTriangle> run() {
    if (!start()) return {};
    for (int round = kRounds; round >= 0; --round) insert_round(round);
    return std::move(triangles_);
  }

 private:
  /// An edge of the hole around a new point, from `from` to `to` counter-clockwise.
  struct Rim {
    std::int32_t outside;
    std::int32_t from;
    std::int32_t to;
  };

  static constexpr int kRounds = 4;

  /// Round of the i-th vertex: 0, the last and by far the largest, to kRounds.
  static int round_of(std::size_t i) {
    const std::uint32_t hash = (static_cast<std::uint32_t>(i) * 0x9e3779b9U) ^ 0x5bd1e995U;
    const std::uint32_t mixed = (hash ^ (hash >> 15U)) * 0x85ebca6bU;
    int round = 0;
    for (std::uint32_t bits = mixed >> 12U; round < kRounds && (bits & 15U) == 0; bits >>= 4U) {
      ++round;
    }
    return round;
  }

  const Point2& point(std::int32_t vertex) const { return points_[vertex]; }

  bool start() {
    std::size_t third = 2;
    const std::size_t count = vertices_.size();
    if (count < 3) return false;
    while (third < count &&
           orient2d(point(vertices_[0]), point(vertices_[1]), point(vertices_[third])) == 0) {
      ++third;
    }
    if (third == count) return false;
    std::int32_t a = vertices_[0], b = vertices_[1];
    const std::int32_t c = vertices_[third];
    if (orient2d(point(a), point(b), point(c)) < 0) std::swap(a, b);
    first_ = {0, 1, third};
    triangles_.reserve(2 * count - 2);
    triangles_.push_back({{a, b, c}, {4 * 1 + 2, 4 * 2 + 2, 4 * 3 + 2}});
    triangles_.push_back({{c, b, kGhost}, {4 * 3 + 1, 4 * 2 + 0, 4 * 0 + 0}});
    triangles_.push_back({{a, c, kGhost}, {4 * 1 + 1, 4 * 3 + 0, 4 * 0 + 1}});
    triangles_.push_back({{b, a, kGhost}, {4 * 2 + 1, 4 * 1 + 0, 4 * 0 + 2}});
    hint_ = 0;
    return true;
  }

  void insert_round(int round) {
    for (std::size_t i = 0; i < vertices_.size(); ++i) {
      if (round_of(i) != round) continue;
      if (i == first_[0] || i == first_[1] || i == first_[2]) continue;
      insert(vertices_[i]);
    }
  }

  void insert(std::int32_t vertex) {
    const Point2 p = point(vertex);
    open_hole(locate(p), p);
    close_hole(vertex);
  }

  /// A triangle that holds p, its edges included, or the ghost beyond the hull edge that p sees.
  std::int32_t locate(const Point2& p) const {
    const LinkedTriangle& first = triangles_[hint_];
    std::int32_t edge = -1;
    for (int i = 0; i < 3; ++i) {
      if (orient2d(point(first.vertex[kNext[i]]), point(first.vertex[kPrevious[i]]), p) < 0) {
        edge = first.across[i];
        break;
      }
    }
    if (edge < 0) return hint_;
    while (true) {
      const LinkedTriangle& t = triangles_[edge >> 2];
      if (is_ghost(t)) return edge >> 2;
      const int apex = edge & 3;
      const Point2& a = point(t.vertex[apex]);
      if (orient2d(a, point(t.vertex[kNext[apex]]), p) < 0) {
        edge = t.across[kPrevious[apex]];
      } else if (orient2d(point(t.vertex[kPrevious[apex]]), a, p) < 0) {
        edge = t.across[kNext[apex]];
      } else {
        return edge >> 2;
      }
    }
  }

  bool in_conflict(const LinkedTriangle& t, const Point2& p) const {
    if (is_ghost(t)) return ghost_in_conflict(t, p);
    return in_perturbed_circle(point(t.vertex[0]), point(t.vertex[1]), point(t.vertex[2]), p);
  }

  /// The circle of a ghost is the open half plane beyond its hull edge, and the edge itself.
  bool ghost_in_conflict(const LinkedTriangle& t, const Point2& p) const {
    const int ghost = t.vertex[0] < 0 ? 0 : t.vertex[1] < 0 ? 1 : 2;
    const Point2& a = point(t.vertex[kNext[ghost]]);
    const Point2& b = point(t.vertex[kPrevious[ghost]]);
    const int side = orient2d(a, b, p);
    return side > 0 || (side == 0 && before(a, p) == before(p, b));
  }

  /// Collects the triangles whose circle holds p, which hang together, and the rim around them.
  void open_hole(std::int32_t seed, const Point2& p) {
    hole_.clear();
    rim_.clear();
    todo_.clear();
    hole_.push_back(seed);
    const LinkedTriangle& first = triangles_[seed];
    for (int i = 2; i >= 0; --i) todo_.push_back(first.across[i]);
    while (!todo_.empty()) {
      const std::int32_t edge = todo_.back();
      todo_.pop_back();
      const LinkedTriangle& t = triangles_[edge >> 2];
      const int apex = edge & 3;
      if (in_conflict(t, p)) {
        hole_.push_back(edge >> 2);
        todo_.push_back(t.across[kPrevious[apex]]);
        todo_.push_back(t.across[kNext[apex]]);
      } else {
        rim_.push_back({edge, t.vertex[kPrevious[apex]], t.vertex[kNext[apex]]});
      }
    }
  }

  /// Fills the hole with the star of the new vertex: one triangle (from, to, vertex) for each edge
  /// of the rim, in the slots of the old ones and two new.
  void close_hole(std::int32_t vertex) {
    const std::size_t count = rim_.size();
    while (hole_.size() < count) {
      hole_.push_back(static_cast<std::int32_t>(triangles_.size()));
      triangles_.emplace_back();
    }
    std::int32_t previous = hole_[count - 1];
    for (std::size_t i = 0; i < count; ++i) {
      const Rim& rim = rim_[i];
      const std::int32_t self = hole_[i];
      const std::int32_t next = hole_[i + 1 == count ? 0 : i + 1];
      triangles_[self] = {{rim.from, rim.to, vertex}, {4 * next + 1, 4 * previous, rim.outside}};
      triangles_[rim.outside >> 2].across[rim.outside & 3] = 4 * self + 2;
      if ((rim.from | rim.to) >= 0) hint_ = self;
      previous = self;
    }
  }

  const Point2* points_;
  std::span<const std::int32_t> vertices_;
  std::vector<LinkedTriangle> triangles_;
  std::array<std::size_t, 3> first_{};
  std::int32_t hint_ = 0;
  std::vector<std::int32_t> hole_;
  std::vector<std::int32_t> todo_;
  std::vector<Rim> rim_;
};

}  // namespace

std::vector<LinkedTriangle> triangulate_points(std::span<const Point2> points,
                                               std::span<const std::int32_t> vertices) {
  return Triangulator(points, vertices).run();
}

}  // namespace bathyal
