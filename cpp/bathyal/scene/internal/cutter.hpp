// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "bathyal/geometry/shared_array.hpp"

namespace bathyal::scene {

/// Order by x, y, then z: in it every edge has a first end, the same for each of its triangles.
inline bool precedes(const Vec3& a, const Vec3& b) {
  if (a.x() != b.x()) return a.x() < b.x();
  return a.y() != b.y() ? a.y() < b.y() : a.z() < b.z();
}

/// Largest coordinate, to which a point's rounding is relative.
inline double reach(const Vec3& point) { return point.cwiseAbs().maxCoeff(); }

/// Where a section cuts: a plane and, between two points, the strip of it that is kept.
class Cutter {
 public:
  /// The whole plane through `anchor`; `normal` may have any length but zero.
  Cutter(const Vec3& normal, const Vec3& anchor);

  /// The plane through `start` and `end` along `up`, kept between the two as measured along the
  /// horizontal: Filaretov, Konoplin, Konoplin (2018), r = A_i A_{i+1} × z. Left at full length:
  /// the signs of p need no unit normal, and r · (A_{i+1} − A_i) is then exactly 0 for `up` = z.
  /// \throw std::invalid_argument when a value is not finite, `up` is zero, or `end` lies over
  /// `start` along `up` to the precision of double.
  static Cutter between(const Vec3& start, const Vec3& end, const Vec3& up);

  /// p = r · (V − A) in units of |normal|, a function of the vertex alone, so that all triangles
  /// around it agree on it; exactly 0 for a vertex nearer to the plane than the rounding of its
  /// coordinates.
  double height(const Vec3& vertex) const {
    const double p = normal_.dot(vertex - anchor_);
    return std::abs(p) <= height_slack(reach(vertex)) ? 0.0 : p;
  }

  /// Where the edge from v0 (p = p0) to v1 (p1 of the other sign) meets the plane: the same bytes
  /// from either of its triangles.
  static Vec3 cut_edge(const Vec3& v0, double p0, const Vec3& v1, double p1) {
    if (precedes(v1, v0)) return cut_between(v1, p1, v0, p0);
    return cut_between(v0, p0, v1, p1);
  }

  /// Whether neither `settle` nor `clip` would touch a segment between this point and another such.
  bool is_well_inside(const Vec3& point) const {
    if (!has_strip()) return true;
    const double s = along_.dot(point - anchor_);
    const double margin = kPointRounding * along_sum_ * anchor_reach_;
    return s > margin && s < length_ - margin;
  }

  /// `point`, or the strip's own start or end where it is that point to rounding.
  /// \pre has_strip()
  Vec3 settle(const Vec3& point) const;

  /// Shortens the segment from p to q to the strip; false where nothing of it is left.
  /// \pre has_strip()
  bool clip(Vec3& p, Vec3& q) const;

  bool has_strip() const { return length_ > 0.0; }
  const Vec3& normal() const { return normal_; }
  const Vec3& anchor() const { return anchor_; }

  /// Across the strip: along() · (x − anchor()) runs from 0 at its start to length() at its end.
  const Vec3& along() const { return along_; }
  double length() const { return length_; }

  /// |p| (and |along · (x − anchor)|) below which a point with coordinates up to `reach` [m] may be
  /// taken for one that lies on the plane (or on an end of the strip).
  double height_slack(double reach) const {
    return kVertexRounding * normal_sum_ * std::max(reach, anchor_reach_);
  }
  double along_slack(double reach) const {
    return kVertexRounding * along_sum_ * std::max(reach, anchor_reach_);
  }

 private:
  // As parts of the largest coordinate: how far rounding moves a vertex that was meant to lie in
  // the plane (its own rounding, that of the plane, and that of p), and a point computed as a cut
  // or a ray's hit, which a steep triangle stretches.
  static constexpr double kVertexRounding = 8.0 * std::numeric_limits<double>::epsilon();
  static constexpr double kPointRounding = 256.0 * std::numeric_limits<double>::epsilon();

  static Vec3 cut_between(const Vec3& v0, double p0, const Vec3& v1, double p1) {
    // t = r · (A − V0) / r · (V1 − V0). The paper prints |OA · r| over a normalised edge, which is
    // wrong for half of all planes.
    const double t = p0 / (p0 - p1);
    return v0 + t * (v1 - v0);
  }
  double position(const Vec3& point) const;

  Vec3 normal_, anchor_;
  Vec3 along_ = Vec3::Zero();
  Vec3 end_ = Vec3::Zero();
  double length_ = 0.0;
  double normal_sum_ = 0.0;    // |normal|₁
  double along_sum_ = 0.0;     // |along|₁
  double anchor_reach_ = 0.0;  // |anchor|∞, of both ends where there is a strip
};

}  // namespace bathyal::scene
