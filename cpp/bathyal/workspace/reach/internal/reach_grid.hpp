// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "bathyal/arm/kinematics.hpp"

// What the steps of reach_map share: voxels, directions, and the postures that reach them.

namespace bathyal::workspace {

struct ReachGrid {
  Vec3 origin = Vec3::Zero();
  double voxel = 0.0;
  Eigen::Array3i count{0, 0, 0};

  std::size_t total() const {
    return static_cast<std::size_t>(count[0]) * static_cast<std::size_t>(count[1]) *
           static_cast<std::size_t>(count[2]);
  }
  std::size_t index(const Eigen::Array3i& at) const {
    return (static_cast<std::size_t>(at[0]) * static_cast<std::size_t>(count[1]) +
            static_cast<std::size_t>(at[1])) *
               static_cast<std::size_t>(count[2]) +
           static_cast<std::size_t>(at[2]);
  }
  Eigen::Array3i at(std::size_t index) const {
    const auto nz = static_cast<std::size_t>(count[2]);
    const auto ny = static_cast<std::size_t>(count[1]);
    return {static_cast<int>(index / (ny * nz)), static_cast<int>(index / nz % ny),
            static_cast<int>(index % nz)};
  }
  Vec3 middle(std::size_t index) const {
    return origin + voxel * (at(index).cast<double>() + 0.5).matrix();
  }
};

/// Voxels with a face in common: along +x, −x, +y …; −1 outside of the box.
std::array<Index, 6> neighbours(const ReachGrid& grid, std::size_t voxel);

/// 6, 26 or 98 unit vectors: middles of a cube's faces; and of its edges, and its corners; and
/// between them.
std::vector<Vec3> approach_directions(int count);

/// Which of a set of directions is the nearest.
class NearestDirection {
 public:
  explicit NearestDirection(const std::vector<Vec3>& directions);

  std::size_t exact(const Vec3& direction) const;

  /// From a table over the faces of a cube: of a direction on the border of two, either.
  std::size_t operator()(float x, float y, float z) const {
    const float ax = x < 0 ? -x : x;
    const float ay = y < 0 ? -y : y;
    const float az = z < 0 ? -z : z;
    if (ax >= ay && ax >= az) return table_[cell(x < 0 ? 0 : 1, y / ax, z / ax)];
    if (ay >= az) return table_[cell(y < 0 ? 2 : 3, x / ay, z / ay)];
    return table_[cell(z < 0 ? 4 : 5, x / az, y / az)];
  }

 private:
  static constexpr int kCells = 48;
  static std::size_t cell(int face, float u, float v) {
    const auto part = [](float t) {
      const int at = static_cast<int>((t + 1.0F) * (0.5F * kCells));
      return at < 0 ? 0 : at >= kCells ? kCells - 1 : at;
    };
    return static_cast<std::size_t>((face * kCells + part(u)) * kCells + part(v));
  }

  std::vector<Vec3> directions_;
  std::vector<std::uint8_t> table_;
};

/// Sets of up to 127 directions and, as the last element, of any orientation.
inline constexpr std::size_t kSetWords = 2;
using ReachSet = std::array<std::uint64_t, kSetWords>;
inline bool has(const ReachSet& set, std::size_t bit) {
  return ((set[bit / 64] >> (bit % 64)) & 1U) != 0;
}
inline void insert(ReachSet& set, std::size_t bit) {
  set[bit / 64] |= std::uint64_t{1} << (bit % 64);
}
inline void erase(ReachSet& set, std::size_t bit) {
  set[bit / 64] &= ~(std::uint64_t{1} << (bit % 64));
}

/// What an arm is made of as far as its reach goes.
struct ReachArm {
  explicit ReachArm(const Arm& arm);

  Arm arm;
  std::vector<double> lower, upper;  ///< of each coordinate; infinite where it wraps
  std::vector<double> from, width;   ///< within which it is drawn
  double length;                     ///< a radian weighs as much as so many metres
  /// How the first joint moves all that follows when its coordinate changes by 1: about an axis, or
  /// along it. `sweeps`: no other joint shares that coordinate.
  bool sweeps = false;
  bool turns = true;
  double rate = 1.0;
  Vec3 axis = Vec3::UnitZ();
  Vec3 axis_point = Vec3::Zero();
  bool exact_directions;  ///< five coordinates or more

  std::size_t size() const { return lower.size(); }
};

/// A posture of low discrepancy over the arm's limits (Roberts 2018, the R sequence), the first
/// coordinate among them.
class PostureSequence {
 public:
  PostureSequence(const ReachArm& arm, std::uint64_t seed);
  void posture(std::size_t index, double* q) const;

 private:
  const ReachArm* arm_;
  std::vector<double> step_, shift_;
};

/// A posture in 32 bits: drawn as number `sample`, with the first coordinate elsewhere in its
/// range; or number so-and-so of `found`.
struct ReachPostures {
  static constexpr std::uint32_t kNone = 0xffffffffU;
  static constexpr std::uint32_t kFound = 0x80000000U;
  static constexpr std::size_t kMostSamples = std::size_t{1} << 21U;
  static constexpr std::uint32_t kParts = 1024;  ///< of the first coordinate's range

  static std::uint32_t drawn(std::size_t sample, std::uint32_t part) {
    return static_cast<std::uint32_t>(sample) * kParts + part;
  }
  void get(std::uint32_t code, double* q) const;

  const ReachArm* arm = nullptr;
  PostureSequence sequence;
  std::vector<float> found;  ///< rows of q
};

/// What has been found out so far: of each voxel, which directions are reached, by which postures.
struct ReachState {
  std::vector<ReachSet> set;
  std::vector<std::uint32_t> posture;  ///< (voxels, directions + 1)
  std::vector<float> manipulability;  ///< best of the postures drawn with the tip in it, or below 0
  std::vector<std::uint32_t> best;    ///< that posture
  /// (voxels, directions + 1): neighbours from whose posture it was tried, a bit each.
  std::vector<std::uint8_t> tried;
};

}  // namespace bathyal::workspace
