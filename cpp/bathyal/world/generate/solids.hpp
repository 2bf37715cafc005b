// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>

#include "bathyal/geometry/triangle_mesh.hpp"

namespace bathyal {

// Single bodies to be put into a world: closed, normals outward, middle over the origin, and at
// rest on z = 0 unless another place is stated.

struct BoulderOptions {
  std::uint64_t seed = 0;
  double roughness = 0.04;  ///< of its faces, over its radius, 0 to 0.2
  int subdivisions = 3;     ///< 20 · 4ⁿ triangles, 1 to 6

  void check() const;
};

/// An angular boulder of the volume of a sphere of this radius [m].
TriangleMesh make_boulder(double radius, const BoulderOptions& options = {});

enum class MineKind { kCylinder, kSphere, kManta };

struct MineOptions {
  std::optional<double> diameter;  ///< [m]; else 0.53, 1.0, 0.98 (at the foot) by kind
  std::optional<double> length;    ///< of a cylinder [m], else 2.2; height of a manta, else 0.47
  int horns = 9;                   ///< of a sphere, 0 to 100
  int sides = 32;                  ///< of a circle, 8 to 1024, even

  void check() const;
};

/// A cylinder lying along x, a sphere with horns on its upper half, or a truncated cone whose top
/// has half the diameter of its foot. Horns are closed cylinders that begin inside the sphere.
TriangleMesh make_mine(MineKind kind, const MineOptions& options = {});

struct FishOptions {
  int sides = 12;  ///< of its cross-section, 4 to 256

  void check() const;
};

/// A fish of this length [m], nose to +x, its back up; its middle is at the origin.
TriangleMesh make_fish(double length, const FishOptions& options = {});

struct WreckOptions {
  std::uint64_t seed = 0;
  double beam = 9.0;        ///< [m], above 0
  double depth = 5.0;       ///< keel to deck [m], above 0
  double thickness = 0.15;  ///< of plates [m], above 0, at most a tenth of beam and depth
  double list = 0.3;        ///< by which it leans to starboard [rad], −1.4 to 1.4
  bool broken = true;       ///< in two, the bow turned away
  int holes = 6;            ///< in its sides, 0 to 1000
  double spacing = 0.5;     ///< of its plates' triangles [m], above 0

  void check(double length) const;
};

/// A sunken ship of this length [m], bow to +x: plates with holes and torn edges, deck with
/// hatches, bulkheads, superstructure, funnel, mast. Each part is a closed body, and parts overlap.
TriangleMesh make_wreck(double length, const WreckOptions& options = {});

}  // namespace bathyal
