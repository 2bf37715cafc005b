// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <string_view>
#include <vector>

#include "bathyal/arm/arm.hpp"

// Many poses of an arm in one call. q is (N, n), one pose a row, [rad] or [m] a column; it must be
// finite, and may lie beyond the limits: a measured pose can. Results are row-major. The same bytes
// for any number of threads and any instruction set.

namespace bathyal {

using JointMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
using JointView = Eigen::Map<const JointMatrix>;
inline JointView view_of(const JointMatrix& q) { return {q.data(), q.rows(), q.cols()}; }

/// Axes along which a Jacobian or a wrench at the tool centre point is given.
enum class TipFrame { kWorld, kTool };

/// \throw std::invalid_argument when q is not (N, arm.size()), or not finite (the row is named).
void check_joint_values(const Arm& arm, JointView q, std::string_view name = "q");

/// world_from_tool of each pose, (N, 4, 4).
std::vector<double> forward(const Arm& arm, JointView q, int num_threads = 0);

/// world_from_link of every link in the order of arm.links(), (N, L, 4, 4).
std::vector<double> forward_links(const Arm& arm, JointView q, int num_threads = 0);

/// Geometric Jacobian at the tool centre point, (N, 6, n): rows of the linear velocity [m/s] above
/// those of the angular velocity [rad/s], for a unit speed of each coordinate.
std::vector<double> jacobian(const Arm& arm, JointView q, TipFrame frame = TipFrame::kWorld,
                             int num_threads = 0);

struct PosesAndJacobians {
  std::vector<double> poses;      ///< (N, 4, 4), as of forward
  std::vector<double> jacobians;  ///< (N, 6, n), as of jacobian
};

/// Both for little more than the Jacobian alone.
PosesAndJacobians forward_and_jacobian(const Arm& arm, JointView q,
                                       TipFrame frame = TipFrame::kWorld, int num_threads = 0);

/// Memory of the caller for what the functions above return; what is empty is not computed.
struct KinematicsOutput {
  std::span<double> poses = {};       ///< (N, 4, 4)
  std::span<double> links = {};       ///< (N, L, 4, 4)
  std::span<double> jacobians = {};   ///< (N, 6, n)
  TipFrame frame = TipFrame::kWorld;  ///< of the Jacobians
};

/// For those who call often, or have memory that nobody has touched: with many poses more than half
/// of the time of the functions above goes into the system's new pages.
/// \throw std::invalid_argument as they do, and for memory of another size.
void compute_kinematics(const Arm& arm, JointView q, const KinematicsOutput& output,
                        int num_threads = 0);

/// Whether every coordinate of a pose lies within its limits, widened by `tolerance`.
std::vector<bool> within_limits(const Arm& arm, JointView q, double tolerance = 1e-9);

/// Refuses angles that were given in degrees: on a turning joint, values that lie beyond its limits
/// (without limits: beyond one and a half turns) and more than two turns [rad] from zero.
/// \throw std::invalid_argument that names the coordinate, a value, and `name`_deg.
void check_joint_angles(const Arm& arm, JointView q, std::string_view name = "q");

enum class Manipulability {
  kYoshikawa,         ///< √det(J Jᵀ), the product of the singular values (Yoshikawa 1985)
  kSmallest,          ///< the smallest singular value
  kInverseCondition,  ///< smallest over largest: 0 singular, 1 isotropic
};

/// Which rows of the Jacobian count: all six mix metres and radians.
enum class JacobianPart { kAll, kLinear, kAngular };

/// One number a pose. With fewer coordinates than rows, of the singular values that there are.
std::vector<double> manipulability(const Arm& arm, JointView q,
                                   Manipulability kind = Manipulability::kYoshikawa,
                                   JacobianPart part = JacobianPart::kAll, int num_threads = 0);

}  // namespace bathyal
