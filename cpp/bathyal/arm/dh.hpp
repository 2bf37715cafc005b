// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "bathyal/arm/arm.hpp"

namespace bathyal {

/// How the rows of a table are read.
enum class DhConvention {
  kStandard,  ///< Rz(theta) Tz(d) Tx(a) Rx(alpha) Ry(beta): Denavit and Hartenberg 1955
  kModified,  ///< Tx(a) Rx(alpha) Ry(beta) Rz(theta) Tz(d): Craig 1986, a and alpha before the
              ///< joint
};

/// A Denavit-Hartenberg table, one row a joint [m, rad]:
/// base_from_flange = root * row 1 * … * row m * flange.
struct DhTable {
  DhConvention convention = DhConvention::kStandard;
  std::vector<DhRow> rows = {};
  std::vector<JointType> types = {};  ///< of each row
  Pose root = Pose::Identity();
  Pose flange = Pose::Identity();
};

/// What is known of the joints and links besides the table; empty lists are unknown.
struct DhArmOptions {
  std::string name = {};
  std::string source = {};
  std::vector<std::string> names = {};  ///< of the rows; else "joint_1" …
  std::vector<double> lower = {};       ///< [rad] or [m], one a row
  std::vector<double> upper = {};
  std::vector<double> velocity = {};  ///< [rad/s] or [m/s]
  std::vector<double> effort = {};    ///< [N m] or [N]
  std::vector<Link> links = {};       ///< one more than rows
};

/// The arm of a table. A table in the modified convention is taken over exactly: the first row's a,
/// alpha and beta go to the arm's root, each other row's to the row before it.
/// \throw std::invalid_argument for lists of unequal length, and as Arm does.
Arm arm_from_dh(const DhTable& table, const DhArmOptions& options = {});

/// The table of an arm (base and tool are not part of it). In the modified convention, a root that
/// is no more than Tx(a) Rx(alpha) Ry(beta) becomes part of the first row, any other stays `root`.
/// A mimic joint is a row of its own: arm.joints() names the joint that it follows.
DhTable dh_table(const Arm& arm, DhConvention convention = DhConvention::kStandard);

}  // namespace bathyal
