// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <numbers>
#include <string_view>
#include <variant>
#include <vector>

#include "bathyal/scene/scene.hpp"
#include "bathyal/toolpath/aims.hpp"

namespace bathyal {

/// The bottom: flat enough for a plane, or one or more meshes.
using Surface = std::variant<Plane, Scene>;

enum class TargetStatus : std::uint8_t {
  kHit,
  kMiss,      ///< meets nothing, or only beyond max_range
  kParallel,  ///< runs along the plane (|m·d| ≤ 1e-12): eq 3 divides by zero
  kBehind,    ///< meets the bottom only at t < 0, behind the camera
  kHole,      ///< passes through a gap of the mesh (see find_targets)
  kGrazing    ///< a hit, with its point, beyond the stated angle of incidence
};

/// "hit", "miss", "parallel", "behind", "hole", "grazing".
std::string_view to_text(TargetStatus status);

struct TargetOptions {
  AimsReference reference;  ///< frame of the aims, pose of the vehicle, meaning of vertical
  double grazing_angle = std::numbers::pi * 80.0 / 180.0;      ///< [rad], above 0 to π
  double max_range = std::numeric_limits<double>::infinity();  ///< [m], above 0
  int num_threads = 0;                                         ///< 0 = all

  void check() const;
};

/// Targets A_i, one a row of the aims. Everything is in the world frame.
struct Targets {
  std::vector<Vec3> point;             ///< A_i [m], NaN where there is none
  std::vector<Vec3> normal;            ///< unit, out of the bottom, NaN where there is none
  std::vector<std::int32_t> mesh;      ///< −1 where there is none and on a plane
  std::vector<std::int32_t> triangle;  ///< −1 where there is none and on a plane
  std::vector<Vec3> barycentric;       ///< (u, v, w) of eq 4: A = w V0 + u V1 + v V2; else NaN
  std::vector<double> range;           ///< along the unit direction [m], infinite where none
  std::vector<double> incidence;  ///< between −d and the normal [rad], above π/2 from beneath; NaN
  std::vector<TargetStatus> status;

  std::size_t size() const { return status.size(); }

  /// Hit or grazing.
  bool found(std::size_t i) const {
    return status[i] == TargetStatus::kHit || status[i] == TargetStatus::kGrazing;
  }
};

/// Where the camera axes meet the bottom: on a plane by eq 2–3 with t ≥ 0, on meshes the nearest
/// hit at t ≥ 0 (eq 4–9 and what they lack, by Scene::cast).
///
/// Out of the bottom is, on a mesh, the side its triangles are wound for, so that it is right under
/// overhangs too; a plane has no winding, and the normal form's m with d ≥ 0 points down for a
/// vehicle above the bottom, so there the side of `up` counts (an upright plane keeps the normal
/// it has). An axis that comes from beneath has an incidence above π/2 and is grazing.
///
/// An axis that meets nothing is a hole when, in the upright plane through it or in the plane
/// through it at right angles to that, it passes between the open ends of the bottom on its two
/// sides: there is surface to the left and to the right of it and it goes through the chord that
/// would close the gap, at t ≥ 0. Past the edge of a survey there is surface on one side only: a
/// miss. Hole is decided before behind.
///
/// No aims give no targets.
/// \throw std::invalid_argument for aims that are not finite or have no direction.
/// Filaretov, Konoplin, Konoplin (2018), eq 1–9.
Targets find_targets(const Surface& surface, const Aims& aims, const TargetOptions& options = {});

/// The plane's unit normal on the side of `up`; unchanged where the plane is upright.
Vec3 outward_normal(const Plane& plane, const Vec3& up);

/// The triangle's unit normal on the side it is wound for; zero for a triangle without area.
Vec3 outward_normal(const TriangleMesh& mesh, std::int32_t triangle);

/// The same of a triangle of row `mesh` of a scene, in the world.
Vec3 outward_normal(const Scene& scene, std::int32_t mesh, std::int32_t triangle);

}  // namespace bathyal
