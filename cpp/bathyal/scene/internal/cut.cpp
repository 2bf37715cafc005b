// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/scene/internal/cut.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

namespace bathyal::scene {
namespace {

// What a triangle contributes about an edge that lies in the plane.
constexpr unsigned kSurface = 1;   // leaves the plane here
constexpr unsigned kLeft = 2;      // lies in the plane, on the left of the edge
constexpr unsigned kRight = 4;     // the same, on the right
constexpr unsigned kSliver = 8;    // lies in the plane and has no width
constexpr unsigned kCovered = 16;  // its longest edge, which its other two cover

/// Weyl's multiplier of the golden ratio spreads each word; the high half is the well mixed one.
std::uint64_t mix(std::uint64_t hash, std::uint64_t value) {
  return (std::rotl(hash, 23) ^ value) * 0x9e3779b97f4a7c15U;
}
std::uint32_t fold(std::uint64_t hash) { return static_cast<std::uint32_t>(hash >> 32U); }

bool is_outline(unsigned evidence) {
  const bool left = (evidence & kLeft) != 0;
  const bool right = (evidence & kRight) != 0;
  const bool sliver = (evidence & kSliver) != 0;
  if ((evidence & kCovered) != 0) return false;
  if ((evidence & kSurface) != 0) return true;
  return !(left && right) && !(sliver && (left || right));
}

}  // namespace

CutCollector::CutCollector(const Cutter& cutter, std::size_t expected) : cutter_(cutter) {
  points_.reserve(expected + 1);
  meetings_.reserve(expected + 1);
  pieces_.reserve(expected);
  point_index_.reserve(expected);
}

template <class Same>
std::int32_t CutCollector::PointIndex::find_or_add(std::uint32_t hash, std::int32_t next,
                                                   const Same& same) {
  if (2 * (used_ + 1) > slots_.size()) resize(std::max<std::size_t>(64, 4 * slots_.size()));
  const std::size_t mask = slots_.size() - 1;
  std::size_t i = hash & mask;
  for (; slots_[i].number >= 0; i = (i + 1) & mask) {
    if (slots_[i].hash == hash && same(slots_[i].number)) return slots_[i].number;
  }
  slots_[i] = {hash, next};
  ++used_;
  return next;
}

void CutCollector::PointIndex::reserve(std::size_t count) { resize(std::bit_ceil(2 * count + 2)); }

void CutCollector::PointIndex::resize(std::size_t slot_count) {
  const auto old = std::move(slots_);
  slots_.assign(slot_count, {});
  const std::size_t mask = slots_.size() - 1;
  for (const Slot& slot : old) {
    if (slot.number < 0) continue;
    std::size_t i = slot.hash & mask;
    while (slots_[i].number >= 0) i = (i + 1) & mask;
    slots_[i] = slot;
  }
}

std::int32_t CutCollector::point_number(const Vec3& point, std::int32_t mesh) {
  auto hash = static_cast<std::uint64_t>(mesh);
  for (const double x : point) hash = mix(hash, std::bit_cast<std::uint64_t>(x + 0.0));  // −0 is 0
  const auto next = static_cast<std::int32_t>(points_.size());
  const std::int32_t number = point_index_.find_or_add(fold(hash), next, [&](std::int32_t i) {
    const auto k = static_cast<std::size_t>(i);
    return points_[k] == point && meetings_[k].mesh == mesh;
  });
  if (number == next) {
    points_.push_back(point);
    meetings_.push_back({mesh, kNone, 0});
  }
  return number;
}

void CutCollector::add_piece(Vec3 p, Vec3 q, unsigned evidence, std::int32_t mesh,
                             std::int32_t triangle) {
  if (!cutter_.is_well_inside(p) || !cutter_.is_well_inside(q)) {
    p = cutter_.settle(p);
    q = cutter_.settle(q);
    if (precedes(q, p)) std::swap(p, q);  // so that every triangle clips its edge alike
    if (p == q || !cutter_.clip(p, q)) return;
  }
  if (p == q) return;
  Piece& piece = piece_between(point_number(p, mesh), point_number(q, mesh), mesh, triangle);
  piece.evidence |= evidence;
  piece.segment.triangle = std::min(piece.segment.triangle, triangle);
}

CutCollector::Piece& CutCollector::piece_between(std::int32_t p, std::int32_t q, std::int32_t mesh,
                                                 std::int32_t triangle) {
  const std::array ends{std::min(p, q), std::max(p, q)};
  std::array<Meeting*, 2> at{};
  for (const std::size_t i : {0, 1}) at[i] = &meetings_[static_cast<std::size_t>(ends[i])];
  // Looked for where fewer meet: at a hub of a flat fan there may be any number.
  const std::size_t fewer = at[1]->pieces < at[0]->pieces ? 1 : 0;
  for (std::int32_t k = at[fewer]->newest; k != kNone;) {
    Piece& piece = pieces_[static_cast<std::size_t>(k)];
    const auto [low, high] = piece.segment.ends;
    if (low == ends[0] && high == ends[1]) return piece;
    k = piece.older[low == ends[fewer] ? 0 : 1];
  }
  const auto number = static_cast<std::int32_t>(pieces_.size());
  pieces_.push_back({{ends, mesh, triangle}, 0, {at[0]->newest, at[1]->newest}});
  for (Meeting* meeting : at) {
    meeting->newest = number;
    ++meeting->pieces;
  }
  return pieces_.back();
}

void CutCollector::add_flat_triangle(const std::array<Vec3, 3>& corners, std::int32_t mesh,
                                     std::int32_t triangle) {
  std::array<double, 3> length{};
  for (std::size_t i = 0; i < 3; ++i) length[i] = reach(corners[(i + 1) % 3] - corners[i]);
  if (std::min({length[0], length[1], length[2]}) == 0.0)
    return;  // an edge, which its neighbours report
  const auto longest =
      static_cast<std::size_t>(std::max_element(length.begin(), length.end()) - length.begin());
  const double size = std::max({reach(corners[0]), reach(corners[1]), reach(corners[2])});
  for (std::size_t i = 0; i < 3; ++i) {
    Vec3 from = corners[i];
    Vec3 to = corners[(i + 1) % 3];
    if (precedes(to, from)) std::swap(from, to);
    const Vec3& apex = corners[(i + 2) % 3];
    const double side = cutter_.normal().dot((to - from).cross(apex - from));
    const bool sliver = std::abs(side) <= cutter_.height_slack(size) * length[longest];
    const unsigned evidence =
        sliver ? (i == longest ? kCovered : kSliver) : (side > 0.0 ? kLeft : kRight);
    add_piece(from, to, evidence, mesh, triangle);
  }
}

void CutCollector::add(const std::array<Vec3, 3>& corners, std::int32_t mesh,
                       std::int32_t triangle) {
  std::array<double, 3> p{};
  int above = 0;
  int below = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    p[i] = cutter_.height(corners[i]);
    if (p[i] > 0.0) ++above;
    if (p[i] < 0.0) ++below;
  }
  if (above == 3 || below == 3) return;
  if (above == 0 && below == 0) return add_flat_triangle(corners, mesh, triangle);

  const auto cut = [&](std::size_t i, std::size_t j) {
    return Cutter::cut_edge(corners[i], p[i], corners[j], p[j]);
  };
  if (above + below == 3) {  // nearly all: one corner is alone on its side
    const bool side = above == 1;
    const std::size_t alone = (p[0] > 0.0) == side ? 0 : (p[1] > 0.0) == side ? 1 : 2;
    add_piece(cut(alone, (alone + 1) % 3), cut(alone, (alone + 2) % 3), kSurface, mesh, triangle);
    return;
  }

  // Cut points: the corners with p = 0, and the edge between corners of opposite sign. Two of them,
  // or one where the triangle only touches.
  std::array<Vec3, 2> ends;
  std::size_t count = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3;
    if (p[i] == 0.0) ends[count++] = corners[i];
    if ((p[i] < 0.0 && p[j] > 0.0) || (p[i] > 0.0 && p[j] < 0.0)) {
      ends[count++] = cut(i, j);
    }
  }
  if (count == 2) add_piece(ends[0], ends[1], kSurface, mesh, triangle);
}

std::vector<Polyline> CutCollector::chain() const {
  std::vector<CutSegment> segments;
  segments.reserve(pieces_.size());
  for (const Piece& piece : pieces_) {
    if (is_outline(piece.evidence)) segments.push_back(piece.segment);
  }
  return chain_segments(points_, segments, cutter_.along(), cutter_.normal());
}

}  // namespace bathyal::scene
