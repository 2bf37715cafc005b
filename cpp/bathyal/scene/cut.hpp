// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "bathyal/scene/chain.hpp"

namespace bathyal::scene {

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

/// Collects the cuts of triangles and settles which of them the section keeps: none twice, none of
/// zero length, and of the edges that lie in the plane those where the surface passes through it,
/// touches it, ends in it or leaves it; edges between two triangles in the plane are dropped, so
/// that a flat region gives its outline. A triangle met only at a corner gives nothing.
class CutCollector {
 public:
  /// `expected`: about how many triangles are cut.
  CutCollector(const Cutter& cutter, std::size_t expected);

  void add(const std::array<Vec3, 3>& corners, std::int32_t mesh, std::int32_t triangle);

  std::vector<Polyline> chain() const;

 private:
  struct Piece {
    CutSegment segment;
    unsigned evidence = 0;  // what the triangles around it say
  };

  void add_edge_in_plane(const Vec3& v0, const Vec3& v1, unsigned evidence, std::int32_t mesh,
                         std::int32_t triangle);
  void add_flat_triangle(const std::array<Vec3, 3>& corners, std::int32_t mesh,
                         std::int32_t triangle);
  void add_piece(Vec3 p, Vec3 q, unsigned evidence, std::int32_t mesh, std::int32_t triangle);
  std::int32_t point_number(const Vec3& point, std::int32_t mesh);

  /// Numbers of keys seen before, by open addressing: a section holds thousands of points, and a
  /// node-based map would take longer than the cutting.
  class Index {
   public:
    void reserve(std::size_t count);

    /// Calls `same(number)` for each number filed under `hash` until it says yes, and returns that
    /// number; files and returns `next` when none does.
    template <class Same>
    std::int32_t find_or_add(std::uint64_t hash, std::int32_t next, const Same& same);

   private:
    void resize(std::size_t slot_count);

    std::vector<std::pair<std::uint64_t, std::int32_t>> slots_;
    std::size_t used_ = 0;
  };

  Cutter cutter_;
  std::vector<Vec3> points_;
  std::vector<std::int32_t> point_mesh_;
  std::vector<Piece> pieces_;
  Index point_index_, piece_index_;
};

}  // namespace bathyal::scene
