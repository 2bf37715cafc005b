// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

// Plain numbers, so that the kernels compiled for one instruction set may include this header.

namespace bathyal::scene {

/// Where an instance's mesh lies: x in the world = scale · rotation · x in the mesh + position.
struct InstanceFrame {
  double rotation[3][3];  ///< [row][column]
  double position[3];     ///< [m]
  double scale;           ///< metres of the world for one of the mesh
  double per_metre;       ///< 1 / scale
  std::int32_t mesh;      ///< number among the scene's distinct meshes
  bool at_identity;       ///< neither moved, turned nor scaled
};

/// What turning a point from one frame into the other may move it by, as a part of the lengths that
/// are added up on the way: a few units in the last place, and rotations to 1e-14.
inline constexpr double kInstancePad = 0x1p-44;

/// Row of an instance and triangle of its mesh as one number that orders as the pair does.
using InstanceKey = std::int64_t;

inline constexpr InstanceKey key_of(std::int32_t row, std::uint32_t triangle) {
  return static_cast<InstanceKey>(row) << 32 | static_cast<InstanceKey>(triangle);
}

}  // namespace bathyal::scene
