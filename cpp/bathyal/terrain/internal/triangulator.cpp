// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/terrain/internal/triangulator.hpp"

#include <cstddef>
#include <utility>
#include <vector>

namespace bathyal::terrain {
namespace {

constexpr std::array<std::int32_t, 3> kNext{1, 2, 0};
constexpr std::array<std::int32_t, 3> kPrevious{2, 0, 1};

/// Corner i of triangle t, and the edge opposite to it, is called 4 t + i; `across_[t][i]` is the
/// same edge seen from the other side.
class Triangulator {
 public:
  Triangulator(std::span<const Point2> points, std::span<const std::int32_t> vertices)
      : points_(points.data()), vertices_(vertices) {}

  PageVector<Corners> run() {
    if (!start()) return {};
    for (int round = kRounds; round >= 0; --round) insert_round(round);
    return std::move(corners_);
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
    corners_.reserve(2 * count - 2);
    across_.reserve(2 * count - 2);
    corners_ = {{a, b, c}, {c, b, kGhost}, {a, c, kGhost}, {b, a, kGhost}};
    across_ = {{4 * 1 + 2, 4 * 2 + 2, 4 * 3 + 2},
               {4 * 3 + 1, 4 * 2 + 0, 4 * 0 + 0},
               {4 * 1 + 1, 4 * 3 + 0, 4 * 0 + 1},
               {4 * 2 + 1, 4 * 1 + 0, 4 * 0 + 2}};
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
    std::int32_t edge = -1;
    for (int i = 0; i < 3 && edge < 0; ++i) {
      const Corners& t = corners_[hint_];
      if (orient2d(point(t[kNext[i]]), point(t[kPrevious[i]]), p) < 0) edge = across_[hint_][i];
    }
    if (edge < 0) return hint_;
    while (true) {
      const std::int32_t triangle = edge >> 2, apex = edge & 3;
      const Corners& t = corners_[triangle];
      if (is_ghost(t)) return triangle;
      const Point2& a = point(t[apex]);
      if (orient2d(a, point(t[kNext[apex]]), p) < 0) {
        edge = across_[triangle][kPrevious[apex]];
      } else if (orient2d(point(t[kPrevious[apex]]), a, p) < 0) {
        edge = across_[triangle][kNext[apex]];
      } else {
        return triangle;
      }
    }
  }

  bool in_conflict(const Corners& t, const Point2& p) const {
    if (is_ghost(t)) [[unlikely]]
      return ghost_in_conflict(t, p);
    return in_perturbed_circle(point(t[0]), point(t[1]), point(t[2]), p);
  }

  /// The circle of a ghost is the open half plane beyond its hull edge, and the edge itself.
  bool ghost_in_conflict(const Corners& t, const Point2& p) const {
    const int ghost = t[0] < 0 ? 0 : t[1] < 0 ? 1 : 2;
    const Point2& a = point(t[kNext[ghost]]);
    const Point2& b = point(t[kPrevious[ghost]]);
    const int side = orient2d(a, b, p);
    return side > 0 || (side == 0 && before(a, p) == before(p, b));
  }

  /// Collects the triangles whose circle holds p, which hang together, and the rim around them.
  void open_hole(std::int32_t seed, const Point2& p) {
    hole_.assign(1, seed);
    rim_.clear();
    todo_.assign(across_[seed].rbegin(), across_[seed].rend());
    while (!todo_.empty()) {
      const std::int32_t edge = todo_.back();
      todo_.pop_back();
      const std::int32_t triangle = edge >> 2, apex = edge & 3;
      const Corners& t = corners_[triangle];
      if (in_conflict(t, p)) {
        hole_.push_back(triangle);
        todo_.push_back(across_[triangle][kPrevious[apex]]);
        todo_.push_back(across_[triangle][kNext[apex]]);
      } else {
        rim_.push_back({edge, t[kPrevious[apex]], t[kNext[apex]]});
      }
    }
  }

  /// Fills the hole with the star of the new vertex: one triangle (from, to, vertex) for each edge
  /// of the rim, in the slots of the old ones and two new.
  void close_hole(std::int32_t vertex) {
    const std::size_t count = rim_.size();
    while (hole_.size() < count) {
      hole_.push_back(static_cast<std::int32_t>(corners_.size()));
      corners_.emplace_back();  // its values are set below
      across_.emplace_back();
    }
    std::int32_t previous = hole_[count - 1];
    for (std::size_t i = 0; i < count; ++i) {
      const Rim& rim = rim_[i];
      const std::int32_t self = hole_[i];
      const std::int32_t next = hole_[i + 1 == count ? 0 : i + 1];
      corners_[self] = {rim.from, rim.to, vertex};
      across_[self] = {4 * next + 1, 4 * previous, rim.outside};
      across_[rim.outside >> 2][rim.outside & 3] = 4 * self + 2;
      if ((rim.from | rim.to) >= 0) hint_ = self;
      previous = self;
    }
  }

  const Point2* points_;
  std::span<const std::int32_t> vertices_;
  PageVector<Corners> corners_;
  PageVector<Corners> across_;
  std::array<std::size_t, 3> first_{};
  std::int32_t hint_ = 0;  ///< a triangle near the last point
  std::vector<std::int32_t> hole_;
  std::vector<std::int32_t> todo_;
  std::vector<Rim> rim_;
};

}  // namespace

PageVector<Corners> triangulate_points(std::span<const Point2> points,
                                       std::span<const std::int32_t> vertices) {
  return Triangulator(points, vertices).run();
}

}  // namespace bathyal::terrain
