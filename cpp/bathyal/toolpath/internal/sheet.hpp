// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "bathyal/toolpath/internal/route.hpp"

namespace bathyal::toolpath {

/// One end of a pair: a target's point and the facet it lies on.
struct SheetPoint {
  Vec3 point;
  Vec3 normal;
  std::int32_t mesh;
  std::int32_t triangle;
};

/// How two targets are joined. With no gap there is one run; each gap adds one.
struct Leg {
  std::vector<Run> runs;
  bool detour = false;  ///< the sheet leaves the stretch between the targets (round an overhang)
};

/// The path over the meshes from `a` to `b`: the section by the upright plane through both (r =
/// (a→b × up) normalised; edges are cut at T = V0 + t (V1 − V0), t = r·(A − V0) / r·(V1 − V0), and
/// a vertex with p = 0 is a T itself, by Scene::section).
///
/// - Several sheets: the one that joins a to b is followed; where none does between them, the whole
///   section is looked at, and a sheet that joins them outside (round an overhang) is a detour. Of
///   the two ways round a closed section the shorter is taken.
/// - No sheet joins them: the path follows a's sheet to its open end, crosses straight to the next
///   open end ahead and so on to b's sheet; every crossing begins a new run. Open ends that meet
///   (to 1 µm, the tiles of one survey) are no gap.
/// - a above b: the pair determines no upright plane. The one that also holds the level part of the
///   normals at a and b is taken (straight down a wall), or where both normals are upright the one
///   across the world's axis that `up` leans least towards.
/// - Edges that lie in the plane appear once, on the lowest of their triangles, and of whole
///   triangles in it their outline (Scene::section). Pieces shorter than kCoincident are dropped.
/// - A body on the bottom that is a mesh of its own is not merged with it: the bottom's sheet goes
///   on beneath it, which flag_contacts reports.
/// - A target where sheets cross or touch is followed on the sheet of its own facet.
/// `a` and `b` are further apart than kCoincident.
Leg follow_sheet(const Scene& scene, const SheetPoint& a, const SheetPoint& b, const Vec3& up);

}  // namespace bathyal::toolpath
