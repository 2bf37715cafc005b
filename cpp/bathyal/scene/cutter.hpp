// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "bathyal/geometry/shared_array.hpp"

namespace bathyal::scene {

/// Order by x, then y, then z: in it every edge has a first end, whichever triangle asks.
bool precedes(const Vec3& a, const Vec3& b);

/// Where a section cuts: a plane and, between two points, the strip of it that is kept.
class Cutter {
 public:
  /// The whole plane through `anchor`; `normal` may have any length but zero.
  Cutter(const Vec3& normal, const Vec3& anchor);

  /// The plane through `start` and `end` along `up`, kept between the two as measured along the
  /// horizontal: Filaretov, Konoplin, Konoplin (2018), r = A_i A_{i+1} × z. Left at full length:
  /// the signs of p need no unit normal, and r · (A_{i+1} − A_i) is then exactly 0 for `up` = z.
  /// \throw std::invalid_argument when a value is not finite, `up` is zero, or `end` lies over
  /// `start` along `up` as far as double can tell.
  static Cutter between(const Vec3& start, const Vec3& end, const Vec3& up);

  /// p = r · (V − A) in units of |normal|, a function of the vertex alone, so that all triangles
  /// around it judge it alike; exactly 0 for a vertex nearer to the plane than the rounding of its
  /// coordinates.
  double height(const Vec3& vertex) const;

  /// Where the edge from v0 (p = p0) to v1 (p1 of the other sign) meets the plane: the same bytes
  /// whichever triangle asks.
  Vec3 cut_edge(const Vec3& v0, double p0, const Vec3& v1, double p1) const;

  /// Whether neither `settle` nor `clip` would touch a segment between this point and another such.
  bool is_well_inside(const Vec3& point) const;

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
  double height_slack(double reach) const;
  double along_slack(double reach) const;

 private:
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
