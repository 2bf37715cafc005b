// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "bathyal/vehicle/devices/thruster.hpp"

namespace bathyal {

inline constexpr std::array<const char*, 6> kAxisNames{"surge", "sway",  "heave",
                                                       "roll",  "pitch", "yaw"};

struct AllocationOptions {
  /// Of an error in each direction, surge to yaw, all above 0. When the thrusters cannot give a
  /// wrench, what is kept first is what weighs most: heave, roll, pitch, then yaw, then the rest.
  std::array<double, 6> weights{1.0, 1.0, 100.0, 100.0, 100.0, 10.0};
  double effort = 1e-4;  ///< weight of the thrusts themselves, which shares the work out; above 0

  /// \throw std::invalid_argument that names the field
  void check() const;
};

/// What the thrusters that work can do.
struct AllocationRank {
  int rank = 0;           ///< of their matrix, 0 to 6
  std::vector<int> lost;  ///< directions that they cannot give in addition to the others, 0 to 5
};

struct AllocationResult {
  std::vector<double> thrust;    ///< (m,) [N]
  std::vector<double> command;   ///< (m,) −1 to 1
  Vec6 achieved = Vec6::Zero();  ///< what they give in still water
  bool saturated = false;        ///< one is at its limit
};

/// From a wrench to the commands of thrusters: the weighted least squares of the wrench's error
/// with the thrusts within what each can give at the voltage, solved exactly by an active set
/// (Stark and Parker 1995, Bounded-Variable Least Squares). The dead zone is in the commands.
class Allocation {
 public:
  /// \throw std::invalid_argument for none or more than 32 thrusters, or as the options' check
  explicit Allocation(std::vector<Thruster> thrusters, AllocationOptions options = {});

  const std::vector<Thruster>& thrusters() const { return thrusters_; }
  const Eigen::MatrixXd& matrix() const { return matrix_; }  ///< (6, m) wrench of 1 N of each

  /// Rank, and which directions are lost: in the order heave, yaw, surge, sway, roll, pitch a
  /// direction is kept if it is independent of those kept before it; roll and pitch come last as a
  /// vehicle rights itself in them. \param failed rows of thrusters that do not work
  /// \throw std::invalid_argument for a row that there is not
  AllocationRank rank(const std::vector<int>& failed = {}) const;

  /// Lost directions do not count, so that the others are held. \param result used again and again
  /// \throw std::invalid_argument for a wrench that is not finite or a voltage below 0
  void allocate(const Vec6& wrench, double voltage, const std::vector<int>& failed,
                AllocationResult& result) const;

 private:
  std::uint32_t working(const std::vector<int>& failed) const;
  std::uint32_t lost_axes(std::uint32_t working) const;

  std::vector<Thruster> thrusters_;
  AllocationOptions options_;
  Eigen::MatrixXd matrix_;
};

}  // namespace bathyal
