// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/identify/fit/redundancy.hpp"

#include <algorithm>
#include <numbers>

#include "bathyal/base/random.hpp"
#include "bathyal/identify/model/arm_residuals.hpp"

namespace bathyal {
namespace {

constexpr std::uint64_t kSeed = 1;
constexpr double kClearly = 1e-3;  ///< independent share of a column

/// Poses all over the joints' range, for each tool and station in turn, as if tracked.
Measurement random_poses(const Measurement& like, const Arm& arm, Index count) {
  Measurement m;
  m.tracked = true;
  m.tools = like.tools;
  m.stations = like.stations;
  m.q.resize(count, arm.size());
  m.position.setZero(3, count);
  m.weights.assign(static_cast<std::size_t>(count), 1.0);
  m.point.assign(static_cast<std::size_t>(count), -1);
  m.plane.assign(static_cast<std::size_t>(count), -1);
  if (like.has_rotation()) {
    m.rotation.assign(static_cast<std::size_t>(count), Eigen::Matrix3d::Identity());
  }
  std::vector<double> reach(static_cast<std::size_t>(arm.size()), std::numbers::pi);
  for (const Joint& joint : arm.joints()) {
    if (joint.type == JointType::kPrismatic) reach[joint.coordinate] = 0.5;
  }
  RandomStream random(kSeed);
  for (Index i = 0; i < count; ++i) {
    m.tool.push_back(static_cast<int>(i) % like.tools);
    m.station.push_back(static_cast<int>(i) / like.tools % like.stations);
    for (Index j = 0; j < arm.size(); ++j) m.q(i, j) = random.uniform(-reach[j], reach[j]);
  }
  return m;
}

/// Three rows each: more rows than parameters.
Index enough_poses(const ArmParameters& parameters) {
  return static_cast<Index>(parameters.parameters.size()) / 2 + 4;
}

Eigen::MatrixXd jacobian_at(const ArmParameters& parameters, const Measurement& poses,
                            const Eigen::VectorXd& x) {
  ArmResiduals system(parameters, poses, Criterion::kCentroid, false, 1);
  system.set_use_priors(false);
  return system.jacobian(x);
}

/// Rows without right angles, parallel axes or lengths of zero.
Eigen::VectorXd without_special_angles(const ArmParameters& parameters) {
  Eigen::VectorXd x = parameters.nominal();
  RandomStream random(kSeed, 1);
  for (Index i = 0; i < x.size(); ++i) {
    const ParameterKind part = parameters.slots[i].kind;
    const double size = random.uniform(0.1, 0.3) * (random.uniform() < 0.5 ? -1.0 : 1.0);
    if (is_row(parameters.slots[i]) || part == ParameterKind::kToolShift) x[i] += size;
  }
  return x;
}

/// Base and tool first: what they can represent, rows need not.
std::vector<int> order_of(const ArmParameters& parameters, bool base_known) {
  std::vector<int> order;
  const auto take = [&](auto wanted) {
    for (int i = 0; i < static_cast<int>(parameters.slots.size()); ++i) {
      if (wanted(parameters.slots[i])) order.push_back(i);
    }
  };
  take([&](const ParameterSlot& p) {
    const bool base = p.kind == ParameterKind::kBaseShift || p.kind == ParameterKind::kBaseTurn;
    return base && !(base_known && p.index == 0);
  });
  take([](const ParameterSlot& p) {
    return p.kind == ParameterKind::kToolShift || p.kind == ParameterKind::kToolTurn;
  });
  take(is_row);
  return order;
}

/// The selected parameters, then the others.
std::vector<int> preferred(IndependentColumns selection) {
  std::vector<int> order = std::move(selection.kept);
  order.insert(order.end(), selection.dependent.begin(), selection.dependent.end());
  return order;
}

}  // namespace

std::vector<RedundantParameter> find_redundant(const ArmParameters& parameters,
                                               const Measurement& measurement,
                                               const ParameterChoice& choice, bool base_known,
                                               const std::vector<int>& fixed) {
  ParameterChoice with_base = choice;
  with_base.free_base = true;
  Measurement no_planes = measurement;
  no_planes.plane_names.clear();
  const ArmParameters all =
      make_parameters(parameters.arm, no_planes, parameters.bases, parameters.tools, {}, with_base);
  const Measurement poses = random_poses(measurement, parameters.arm, enough_poses(all));
  std::vector<int> order = order_of(all, base_known);
  for (const int column : fixed) {
    std::erase(order, find_parameter(all.parameters, parameters.parameters[column].name));
  }
  // At the actual arm a parameter can be unobservable that is observable at any other one (parallel
  // axes, prismatic joints at right angles): if it were kept, one that is observable here would be
  // missing. So parameters that are independent here come first, the clearly independent ones
  // before those that are so only by a rounded angle; whatever else is independent elsewhere may
  // then be kept in addition.
  const Eigen::MatrixXd jacobian = jacobian_at(all, poses, all.nominal());
  order = preferred(select_independent(jacobian, order, {kClearly, kRankTolerance}));
  const IndependentColumns selection =
      select_independent(jacobian_at(all, poses, without_special_angles(all)), order);
  if (selection.dependent.empty()) return {};

  // The equivalents of a redundant parameter are those at the actual arm.
  Eigen::MatrixXd kept(jacobian.rows(), static_cast<Index>(selection.kept.size()));
  for (Index k = 0; k < kept.cols(); ++k) kept.col(k) = jacobian.col(selection.kept[k]);
  Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd> decomposition;
  decomposition.setThreshold(kRankTolerance);
  decomposition.compute(kept);

  std::vector<RedundantParameter> redundant;
  for (const int dependent : selection.dependent) {
    const Parameter& column = all.parameters[dependent];
    RedundantParameter found{find_parameter(parameters.parameters, column.name), {}};
    const Eigen::VectorXd share = decomposition.solve(jacobian.col(dependent));
    for (Index k = 0; k < share.size(); ++k) {
      const Parameter& other = all.parameters[selection.kept[k]];
      if (std::abs(share[k]) > 1e-6) {
        found.partners.push_back(
            {other.name, other.description, -share[k] * other.scale / column.scale});
      }
    }
    std::stable_sort(found.partners.begin(), found.partners.end(),
                     [](const NullSpacePartner& a, const NullSpacePartner& b) {
                       return std::abs(a.factor) > std::abs(b.factor);
                     });
    redundant.push_back(std::move(found));
  }
  std::sort(
      redundant.begin(), redundant.end(),
      [](const RedundantParameter& a, const RedundantParameter& b) { return a.column < b.column; });
  return redundant;
}

}  // namespace bathyal
