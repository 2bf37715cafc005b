// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "bathyal/arm/arm.hpp"
#include "bathyal/arm/row_frames.hpp"
#include "bathyal/workspace/capsule.hpp"

// The body of an arm as capsules: what of it must not touch anything.

namespace bathyal {

/// The name of a link; of one without a name "link_2" by its index.
std::string link_name(const Arm& arm, int link);

/// \throw std::invalid_argument that lists the names for one that is not among them.
int link_index(const Arm& arm, std::string_view link, std::string_view argument = "link");

/// A capsule that moves with a link. Its start may be fixed in the link before: a sliding joint
/// draws it out.
struct LinkCapsule {
  int link = 0;        ///< index into arm.links(): 0 is the foot
  int start_link = 0;  ///< in whose frame the start is given; `link` or the one before
  Vec3 start = Vec3::Zero();
  Vec3 end = Vec3::Zero();
  double radius = 0.0;  ///< [m]
};

/// Segments from joint to joint, along d and then a of each row, and on to the tool centre point:
/// all that is known of an arm without shapes. `radii` has none (0), one for all links, or one a
/// link.
/// \throw std::invalid_argument for another count, a radius that is negative or not finite.
std::vector<LinkCapsule> capsules_of_rows(const Arm& arm, std::span<const double> radii = {});

/// `shapes` has one list a link, in the link's own frame; the list of a link may be empty.
/// \throw std::invalid_argument for another count of lists, and as Capsule::check.
std::vector<LinkCapsule> capsules_of_links(const Arm& arm,
                                           std::span<const std::vector<Capsule>> shapes);

/// The corners of a mesh that a shape names, along its scale; none where it cannot be read.
using MeshCorners = std::function<std::optional<Points>(const Shape&)>;

struct ArmCapsules {
  std::vector<LinkCapsule> capsules;
  std::vector<std::string> warnings;
};

/// Capsules around the shapes of an arm's links, one a shape: those for collisions, or where a link
/// (or a part of it) has none, those for the eye. A link without any has its segments of
/// capsules_of_rows, without thickness; a warning says so where no link has any, or a mesh cannot
/// be read.
ArmCapsules capsules_of_shapes(const Arm& arm, const MeshCorners& corners);

/// The same arm with a cylinder along each segment of capsules_of_rows but those that a sliding
/// joint draws out, as the collision shapes of its links. Of each link that has none, mass, volume
/// and inertia are those of its cylinders where a density is given [kg/m³].
/// \throw std::invalid_argument as capsules_of_rows, for a density that is not positive.
Arm with_link_radii(const Arm& arm, std::span<const double> radii,
                    std::optional<double> density = std::nullopt);

/// The capsules of a pose: start and end from the frames of the rows, in their common frame.
Capsule placed(const Arm& arm, const LinkCapsule& capsule, const RowFrames& frames);

/// How far any point of a capsule of `link` can move, seen from `observer` (a link; 0 is the foot),
/// while each coordinate changes by at most `change` from the pose that the frames are of [m].
///
/// The joints between the two are moved one after the other, the nearest to the capsule first. Each
/// turns the point about its own axis, by no more than the angle times the distance from that axis:
/// the distance in the pose given, plus what the joints before it have moved the point by (arc over
/// chord, triangle inequality). Sliding joints move it by their change.
double displacement_bound(const Arm& arm, const RowFrames& frames, int link, int observer,
                          const Capsule& placed, std::span<const double> change);

}  // namespace bathyal
