// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "bathyal/toolpath/targets.hpp"

namespace bathyal::toolpath {

/// Targets closer than this are one target, shorter pieces of a path are dropped [m].
inline constexpr double kCoincident = 1e-6;

/// A straight piece of the path over one facet.
struct Piece {
  Vec3 from = Vec3::Zero();
  Vec3 to = Vec3::Zero();
  Vec3 normal = Vec3::UnitZ();  ///< unit, out of the bottom: a of the whole piece
  double normal_std = 0.0;      ///< [rad], NaN where unknown
  std::int32_t mesh = -1;       ///< −1 on a plane
  std::int32_t triangle = -1;   ///< −1 on a plane
  std::int32_t segment = 0;     ///< i of the pair A_i A_{i+1}

  double length() const { return (to - from).norm(); }
};

/// Pieces that hang together: never none; a lone point is one piece of no length.
struct Run {
  std::vector<Piece> pieces;
  std::int32_t gap_segment = -1;  ///< the pair whose gap ends this run; −1 for the last run
};

/// The path along the bottom; between a run and the next lies a gap.
struct Route {
  std::vector<Run> runs;
  std::vector<std::string> warnings;
};

/// Joins the targets that were found along the bottom, pair by pair. Facet normals are set, their
/// standard deviations not yet. At least one target must be found.
Route join_targets(const Surface& surface, const Targets& targets, const Vec3& up, int num_threads);

/// "aim 6 has no target" or "aims 3 and 6 have no target": what is said of `noun` in the singular
/// and in the plural. Nothing for no numbers.
void warn_of(std::vector<std::string>& warnings, const std::string& noun,
             const std::vector<std::size_t>& numbers, const std::string& one,
             const std::string& several);

/// Cuts every piece into equal parts no longer than `length` [m].
void subdivide(Route& route, double length);

}  // namespace bathyal::toolpath
