// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/scene/cut.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <tuple>

#include "bathyal/base/error.hpp"

namespace bathyal::scene {
namespace {

constexpr double kEpsilon = std::numeric_limits<double>::epsilon();

// In units of ε · the largest coordinate: how far rounding moves a vertex that was meant to lie in
// the plane (its own rounding, that of the plane, and that of p), and a point computed as a cut or
// a ray's hit, which a steep triangle stretches.
constexpr double kVertexRounding = 8.0;
constexpr double kPointRounding = 256.0;

// What a triangle says of an edge that lies in the plane.
constexpr unsigned kSurface = 1;   // leaves the plane here
constexpr unsigned kLeft = 2;      // lies in the plane, on the left of the edge
constexpr unsigned kRight = 4;     // the same, on the right
constexpr unsigned kSliver = 8;    // lies in the plane and has no width
constexpr unsigned kCovered = 16;  // its longest edge, which its other two cover

double reach(const Vec3& v) { return v.cwiseAbs().maxCoeff(); }

bool precedes(const Vec3& a, const Vec3& b) {
  return std::make_tuple(a.x(), a.y(), a.z()) < std::make_tuple(b.x(), b.y(), b.z());
}

std::uint64_t mix(std::uint64_t hash, std::uint64_t value) {
  hash = (hash ^ value) * 0x9e3779b97f4a7c15U;
  return hash ^ (hash >> 32U);
}

bool is_outline(unsigned evidence) {
  const bool left = (evidence & kLeft) != 0;
  const bool right = (evidence & kRight) != 0;
  const bool sliver = (evidence & kSliver) != 0;
  if ((evidence & kCovered) != 0) return false;
  if ((evidence & kSurface) != 0) return true;
  return !(left && right) && !(sliver && (left || right));
}

void check_vector(std::string_view name, const Vec3& v) {
  if (v.allFinite()) return;
  throw_argument(name, "three finite numbers",
                 "(" + to_text(v.x()) + ", " + to_text(v.y()) + ", " + to_text(v.z()) + ")");
}

}  // namespace

Cutter::Cutter(const Vec3& normal, const Vec3& anchor)
    : normal_(normal),
      anchor_(anchor),
      normal_sum_(normal.lpNorm<1>()),
      anchor_reach_(reach(anchor)) {}

Cutter Cutter::between(const Vec3& start, const Vec3& end, const Vec3& up) {
  check_vector("a", start);
  check_vector("b", end);
  check_vector("up", up);
  const double up_length = up.stableNorm();
  if (!(up_length > 0.0)) throw_argument("up", "a direction of any length but zero", "(0, 0, 0)");

  const Vec3 line = end - start;
  const Vec3 unit_up = up / up_length;
  const Vec3 normal = line.cross(unit_up);  // r of the paper
  const double horizontal = normal.stableNorm();
  const double rounding = kEpsilon * std::max(reach(start), reach(end));
  if (!(horizontal > kVertexRounding * (rounding + kEpsilon * line.stableNorm()))) {
    throw_argument("b", "a point that is not above, below or at a along up",
                   "one " + to_text(horizontal) + " m beside it");
  }
  Cutter cutter(normal, start);
  cutter.along_ = line - line.dot(unit_up) * unit_up;
  cutter.end_ = end;
  cutter.length_ = cutter.along_.dot(line);
  cutter.along_sum_ = cutter.along_.lpNorm<1>();
  cutter.anchor_reach_ = std::max(reach(start), reach(end));
  return cutter;
}

double Cutter::height_slack(double reach) const {
  return kVertexRounding * kEpsilon * normal_sum_ * std::max(reach, anchor_reach_);
}

double Cutter::along_slack(double reach) const {
  return kVertexRounding * kEpsilon * along_sum_ * std::max(reach, anchor_reach_);
}

double Cutter::height(const Vec3& vertex) const {
  const double p = normal_.dot(vertex - anchor_);
  return std::abs(p) <= height_slack(reach(vertex)) ? 0.0 : p;
}

Vec3 Cutter::cut_edge(const Vec3& v0, double p0, const Vec3& v1, double p1) const {
  if (precedes(v1, v0)) return cut_edge(v1, p1, v0, p0);
  // t = r · (A − V0) / r · (V1 − V0). The paper prints |OA · r| over a normalised edge, which is
  // wrong for half of all planes.
  const double t = p0 / (p0 - p1);
  return v0 + t * (v1 - v0);
}

bool Cutter::is_well_inside(const Vec3& point) const {
  if (!has_strip()) return true;
  const double s = along_.dot(point - anchor_);
  const double margin = kPointRounding * kEpsilon * along_sum_ * anchor_reach_;
  return s > margin && s < length_ - margin;
}

Vec3 Cutter::settle(const Vec3& point) const {
  const double near = kPointRounding * kEpsilon * anchor_reach_;
  if (reach(point - anchor_) <= near) return anchor_;
  if (reach(point - end_) <= near) return end_;
  return point;
}

double Cutter::position(const Vec3& point) const {
  const double s = along_.dot(point - anchor_);
  const double slack = along_slack(reach(point));
  if (std::abs(s) <= slack) return 0.0;
  return std::abs(s - length_) <= slack ? length_ : s;
}

bool Cutter::clip(Vec3& p, Vec3& q) const {
  const double sp = position(p);
  const double sq = position(q);
  const auto [low, high] = std::minmax(sp, sq);
  if (high < 0.0 || low > length_) return false;
  if ((high == 0.0 && low < 0.0) || (low == length_ && high > length_)) return false;  // a point
  const Vec3 start = p;
  const Vec3 step = (q - p) / (sq - sp);
  const auto at = [&](double s) { return settle(start + (s - sp) * step); };
  if (sp < 0.0) p = at(0.0);
  if (sp > length_) p = at(length_);
  if (sq < 0.0) q = at(0.0);
  if (sq > length_) q = at(length_);
  return true;
}

CutCollector::CutCollector(const Cutter& cutter, std::size_t expected) : cutter_(cutter) {
  points_.reserve(expected + 1);
  point_mesh_.reserve(expected + 1);
  pieces_.reserve(expected);
  point_index_.reserve(expected);
  piece_index_.reserve(expected);
}

template <class Same>
std::int32_t CutCollector::Index::find_or_add(std::uint64_t hash, std::int32_t next,
                                              const Same& same) {
  if (2 * (used_ + 1) > slots_.size()) resize(std::max<std::size_t>(64, 4 * slots_.size()));
  const std::size_t mask = slots_.size() - 1;
  std::size_t i = hash & mask;
  for (; slots_[i].second >= 0; i = (i + 1) & mask) {
    if (slots_[i].first == hash && same(slots_[i].second)) return slots_[i].second;
  }
  slots_[i] = {hash, next};
  ++used_;
  return next;
}

void CutCollector::Index::reserve(std::size_t count) { resize(std::bit_ceil(2 * count + 2)); }

void CutCollector::Index::resize(std::size_t slot_count) {
  const auto old = std::move(slots_);
  slots_.assign(slot_count, {0, -1});
  const std::size_t mask = slots_.size() - 1;
  for (const auto& slot : old) {
    if (slot.second < 0) continue;
    std::size_t i = slot.first & mask;
    while (slots_[i].second >= 0) i = (i + 1) & mask;
    slots_[i] = slot;
  }
}

std::int32_t CutCollector::point_number(const Vec3& point, std::int32_t mesh) {
  auto hash = static_cast<std::uint64_t>(mesh);
  for (const double x : point) hash = mix(hash, std::bit_cast<std::uint64_t>(x + 0.0));  // −0 is 0
  const auto next = static_cast<std::int32_t>(points_.size());
  const std::int32_t number = point_index_.find_or_add(hash, next, [&](std::int32_t i) {
    const auto k = static_cast<std::size_t>(i);
    return points_[k] == point && point_mesh_[k] == mesh;
  });
  if (number == next) {
    points_.push_back(point);
    point_mesh_.push_back(mesh);
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
  std::int32_t low = point_number(p, mesh);
  std::int32_t high = point_number(q, mesh);
  if (low > high) std::swap(low, high);
  const auto next = static_cast<std::int32_t>(pieces_.size());
  const std::uint64_t hash =
      mix(mix(0, static_cast<std::uint64_t>(low)), static_cast<std::uint64_t>(high));
  const std::array ends{low, high};
  const std::int32_t number = piece_index_.find_or_add(hash, next, [&](std::int32_t i) {
    return pieces_[static_cast<std::size_t>(i)].segment.ends == ends;
  });
  if (number == next) pieces_.push_back({{ends, mesh, triangle}, 0});
  Piece& piece = pieces_[static_cast<std::size_t>(number)];
  piece.evidence |= evidence;
  piece.segment.triangle = std::min(piece.segment.triangle, triangle);
}

void CutCollector::add_flat_triangle(const std::array<Vec3, 3>& corners, std::int32_t mesh,
                                     std::int32_t triangle) {
  std::array<double, 3> length{};
  for (std::size_t i = 0; i < 3; ++i) length[i] = reach(corners[(i + 1) % 3] - corners[i]);
  if (std::min({length[0], length[1], length[2]}) == 0.0)
    return;  // an edge, told by its neighbours
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

  // Cut points: the corners with p = 0 and the edges between corners of opposite sign. Any other
  // triangle than these has two of them, or one where it only touches.
  std::array<Vec3, 2> ends;
  std::size_t count = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3;
    if (p[i] == 0.0) ends[count++] = corners[i];
    if ((p[i] < 0.0 && p[j] > 0.0) || (p[i] > 0.0 && p[j] < 0.0)) {
      ends[count++] = cutter_.cut_edge(corners[i], p[i], corners[j], p[j]);
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
