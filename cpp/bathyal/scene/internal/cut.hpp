// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "bathyal/scene/internal/chain.hpp"
#include "bathyal/scene/internal/cutter.hpp"

namespace bathyal::scene {

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
    unsigned evidence = 0;                // kSurface … kCovered of the triangles around it
    std::array<std::int32_t, 2> older{};  // the piece before it at each of its ends, or kNone
  };

  /// A point where pieces meet, next to those in `points_`.
  struct Meeting {
    std::int32_t mesh;
    std::int32_t newest;  // piece that ends here
    std::int32_t pieces;  // how many do
  };

  static constexpr std::int32_t kNone = -1;

  void add_flat_triangle(const std::array<Vec3, 3>& corners, std::int32_t mesh,
                         std::int32_t triangle);
  void add_piece(Vec3 p, Vec3 q, unsigned evidence, std::int32_t mesh, std::int32_t triangle);
  std::int32_t point_number(const Vec3& point, std::int32_t mesh);
  Piece& piece_between(std::int32_t p, std::int32_t q, std::int32_t mesh, std::int32_t triangle);

  /// Numbers of points by their hash, in open addressing: a section holds thousands, and a
  /// node-based map would take longer than the cutting.
  class PointIndex {
   public:
    void reserve(std::size_t count);

    /// Calls `same(number)` for each number filed under `hash` until it says yes, and returns that
    /// number; files and returns `next` when none does.
    template <class Same>
    std::int32_t find_or_add(std::uint32_t hash, std::int32_t next, const Same& same);

   private:
    void resize(std::size_t slot_count);

    struct Slot {
      std::uint32_t hash = 0;
      std::int32_t number = kNone;
    };
    std::vector<Slot> slots_;
    std::size_t used_ = 0;
  };

  Cutter cutter_;
  std::vector<Vec3> points_;
  std::vector<Meeting> meetings_;  // one a point
  std::vector<Piece> pieces_;
  PointIndex point_index_;
};

}  // namespace bathyal::scene
