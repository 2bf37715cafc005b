// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/workspace/reach/internal/reach_grid.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "bathyal/arm/row_frames.hpp"
#include "bathyal/base/random.hpp"

namespace bathyal::workspace {
namespace {

constexpr double kTurn = 2.0 * std::numbers::pi;

/// Points of a cube's surface on a lattice of so many marks along each edge, on the unit sphere.
std::vector<Vec3> lattice_directions(const std::vector<double>& marks) {
  std::vector<Vec3> directions;
  for (const double x : marks) {
    for (const double y : marks) {
      for (const double z : marks) {
        if (std::max({std::abs(x), std::abs(y), std::abs(z)}) == 1.0) {
          directions.push_back(Vec3(x, y, z).normalized());
        }
      }
    }
  }
  return directions;
}

}  // namespace

std::array<Index, 6> neighbours(const ReachGrid& grid, std::size_t voxel) {
  const Eigen::Array3i at = grid.at(voxel);
  std::array<Index, 6> found{};
  for (std::size_t k = 0; k < 6; ++k) {
    Eigen::Array3i next = at;
    next[static_cast<Index>(k / 2)] += k % 2 == 0 ? 1 : -1;
    const bool inside = (next >= 0).all() && (next < grid.count).all();
    found[k] = inside ? static_cast<Index>(grid.index(next)) : -1;
  }
  return found;
}

std::vector<Vec3> approach_directions(int count) {
  if (count == 26) return lattice_directions({-1.0, 0.0, 1.0});
  if (count == 98) {
    const double between = std::tan(std::numbers::pi / 8.0);
    return lattice_directions({-1.0, -between, 0.0, between, 1.0});
  }
  return {-Vec3::UnitX(), Vec3::UnitX(),  -Vec3::UnitY(),
          Vec3::UnitY(),  -Vec3::UnitZ(), Vec3::UnitZ()};
}

NearestDirection::NearestDirection(const std::vector<Vec3>& directions) : directions_(directions) {
  table_.resize(static_cast<std::size_t>(6 * kCells * kCells));
  const auto middle = [](int part) { return (part + 0.5) * 2.0 / kCells - 1.0; };
  for (int face = 0; face < 6; ++face) {
    const int along = face / 2;
    for (int u = 0; u < kCells; ++u) {
      for (int v = 0; v < kCells; ++v) {
        Vec3 at;
        at[along] = face % 2 == 0 ? -1.0 : 1.0;
        at[along == 0 ? 1 : 0] = middle(u);
        at[along == 2 ? 1 : 2] = middle(v);
        table_[static_cast<std::size_t>((face * kCells + u) * kCells + v)] =
            static_cast<std::uint8_t>(exact(at));
      }
    }
  }
}

std::size_t NearestDirection::exact(const Vec3& direction) const {
  std::size_t best = 0;
  for (std::size_t i = 1; i < directions_.size(); ++i) {
    if (directions_[i].dot(direction) > directions_[best].dot(direction)) best = i;
  }
  return best;
}

ReachArm::ReachArm(const Arm& given)
    : arm(given),
      lower(given.lower().begin(), given.lower().end()),
      upper(given.upper().begin(), given.upper().end()),
      length(0.2 * chain_length(given)),
      exact_directions(given.size() >= 5) {
  if (!(length > 0.0)) length = 1.0;
  std::vector<std::size_t> users(size(), 0);
  std::vector<bool> slides(size(), false);
  const Joint* first = nullptr;
  std::size_t first_row = 0;
  for (std::size_t k = 0; k < arm.joints().size(); ++k) {
    const Joint& joint = arm.joints()[k];
    if (joint.coordinate < 0) continue;
    const auto j = static_cast<std::size_t>(joint.coordinate);
    ++users[j];
    slides[j] = slides[j] || joint.type == JointType::kPrismatic;
    if (first == nullptr) {
      first = &joint;
      first_row = k;
    }
  }
  for (std::size_t j = 0; j < size(); ++j) {
    const double half = slides[j] ? chain_length(arm) : std::numbers::pi;
    const double below = std::isfinite(upper[j]) ? upper[j] - 2.0 * half : -half;
    from.push_back(std::isfinite(lower[j]) ? lower[j] : below);
    const double to = std::isfinite(upper[j]) ? upper[j] : from[j] + 2.0 * half;
    width.push_back(std::max(0.0, to - from[j]));
  }
  if (first == nullptr || first->coordinate != 0 || users[0] != 1) return;
  const RowFrames frames = row_frames(arm, std::vector<double>(size(), 0.0));
  sweeps = true;
  turns = first->type == JointType::kRevolute;
  rate = first->multiplier;
  axis = frames.world_from_row[first_row].linear().col(2);
  axis_point = frames.world_from_row[first_row].translation();
  if (turns && std::abs(rate) * width[0] > kTurn) width[0] = kTurn / std::abs(rate);
}

PostureSequence::PostureSequence(const ReachArm& arm, std::uint64_t seed) : arm_(&arm) {
  // The root above 1 of x^(n + 1) = x + 1.
  const double n = static_cast<double>(arm.size());
  double root = 2.0;
  for (int i = 0; i < 60; ++i) root = std::pow(1.0 + root, 1.0 / (n + 1.0));
  RandomStream random(seed);
  for (std::size_t j = 0; j < arm.size(); ++j) {
    step_.push_back(std::pow(1.0 / root, static_cast<double>(j + 1)));
    shift_.push_back(random.uniform());
  }
}

void PostureSequence::posture(std::size_t index, double* q) const {
  for (std::size_t j = 0; j < step_.size(); ++j) {
    const double at = shift_[j] + static_cast<double>(index) * step_[j];
    q[j] = arm_->from[j] + (at - std::floor(at)) * arm_->width[j];
  }
}

void ReachPostures::get(std::uint32_t code, double* q) const {
  const std::size_t n = arm->size();
  if ((code & kFound) != 0) {
    const float* row = found.data() + static_cast<std::size_t>(code - kFound) * n;
    for (std::size_t j = 0; j < n; ++j)
      q[j] = std::clamp<double>(row[j], arm->lower[j], arm->upper[j]);
    return;
  }
  sequence.posture(code / kParts, q);
  if (arm->sweeps) q[0] = arm->from[0] + (code % kParts + 0.5) / kParts * arm->width[0];
}

}  // namespace bathyal::workspace
