// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/scene/internal/cutter.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string_view>

#include "bathyal/base/error.hpp"

namespace bathyal::scene {
namespace {

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
  const double largest = std::max(reach(start), reach(end));
  if (!(horizontal > kVertexRounding * (largest + line.stableNorm()))) {
    throw_argument("b", "a point that is not above, below or at a along up",
                   "one " + to_text(horizontal) + " m away from it");
  }
  Cutter cutter(normal, start);
  cutter.along_ = line - line.dot(unit_up) * unit_up;
  cutter.end_ = end;
  cutter.length_ = cutter.along_.dot(line);
  cutter.along_sum_ = cutter.along_.lpNorm<1>();
  cutter.anchor_reach_ = largest;
  return cutter;
}

Vec3 Cutter::settle(const Vec3& point) const {
  const double near = kPointRounding * anchor_reach_;
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

}  // namespace bathyal::scene
