// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/identify/fit/redundancy.hpp"

#include <algorithm>
#include <numbers>

#include "bathyal/base/random.hpp"
#include "bathyal/identify/model/arm_residuals.hpp"

namespace bathyal {
namespace {

constexpr std::uint64_t kSeed = 1;
constexpr double kClearly = 1e-3;  ///< share of a column that those before it cannot do

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

/// Three rows each: more of them than there are columns.
Index enough_poses(const ArmColumns& columns) {
  return static_cast<Index>(columns.columns.size()) / 2 + 4;
}

Eigen::MatrixXd jacobian_at(const ArmColumns& columns, const Measurement& poses,
                            const Eigen::VectorXd& x) {
  ArmSystem system(columns, poses, Criterion::kCentroid, false, 1);
  system.set_use_priors(false);
  return system.jacobian(x);
}

/// Rows without right angles, parallel axes or lengths of zero.
Eigen::VectorXd without_chance(const ArmColumns& columns) {
  Eigen::VectorXd x = columns.nominal();
  RandomStream random(kSeed, 1);
  for (Index i = 0; i < x.size(); ++i) {
    const Part part = columns.places[i].part;
    const double size = random.uniform(0.1, 0.3) * (random.uniform() < 0.5 ? -1.0 : 1.0);
    if (is_row(columns.places[i]) || part == Part::kToolShift) x[i] += size;
  }
  return x;
}

/// The base and the tool first: what they can do, rows need not.
std::vector<int> order_of(const ArmColumns& columns, bool base_known) {
  std::vector<int> order;
  const auto take = [&](auto wanted) {
    for (int i = 0; i < static_cast<int>(columns.places.size()); ++i) {
      if (wanted(columns.places[i])) order.push_back(i);
    }
  };
  take([&](const Place& p) {
    const bool base = p.part == Part::kBaseShift || p.part == Part::kBaseTurn;
    return base && !(base_known && p.index == 0);
  });
  take([](const Place& p) { return p.part == Part::kToolShift || p.part == Part::kToolTurn; });
  take(is_row);
  return order;
}

/// The columns that were kept, then those that were not.
std::vector<int> preferred(Selection selection) {
  std::vector<int> order = std::move(selection.kept);
  order.insert(order.end(), selection.dependent.begin(), selection.dependent.end());
  return order;
}

}  // namespace

std::vector<GaugeColumn> find_gauge(const ArmColumns& columns, const Measurement& measurement,
                                    const ColumnChoice& choice, bool base_known,
                                    const std::vector<int>& fixed) {
  ColumnChoice with_base = choice;
  with_base.free_base = true;
  Measurement no_planes = measurement;
  no_planes.plane_names.clear();
  const ArmColumns all =
      make_columns(columns.arm, no_planes, columns.bases, columns.tools, {}, with_base);
  const Measurement poses = random_poses(measurement, columns.arm, enough_poses(all));
  std::vector<int> order = order_of(all, base_known);
  for (const int column : fixed) {
    std::erase(order, find_column(all.columns, columns.columns[column].name));
  }
  // Where the arm stands, a column can be dark that has light anywhere else (parallel axes, sliding
  // joints at right angles): held in its stead, one that has light here would be missed. So what
  // brings something new here comes first, and the clearest of that before what a rounded angle
  // alone lets through; whatever else is new elsewhere may then be kept beside it.
  const Eigen::MatrixXd jacobian = jacobian_at(all, poses, all.nominal());
  order = preferred(select_independent(jacobian, order, {kClearly, kRankTolerance}));
  const Selection selection =
      select_independent(jacobian_at(all, poses, without_chance(all)), order);
  if (selection.dependent.empty()) return {};

  // What takes a gauge column's part is told for the arm as it is.
  Eigen::MatrixXd kept(jacobian.rows(), static_cast<Index>(selection.kept.size()));
  for (Index k = 0; k < kept.cols(); ++k) kept.col(k) = jacobian.col(selection.kept[k]);
  Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd> decomposition;
  decomposition.setThreshold(kRankTolerance);
  decomposition.compute(kept);

  std::vector<GaugeColumn> gauge;
  for (const int dependent : selection.dependent) {
    const Column& column = all.columns[dependent];
    GaugeColumn found{find_column(columns.columns, column.name), {}};
    const Eigen::VectorXd share = decomposition.solve(jacobian.col(dependent));
    for (Index k = 0; k < share.size(); ++k) {
      const Column& other = all.columns[selection.kept[k]];
      if (std::abs(share[k]) > 1e-6) {
        found.trades.push_back({other.name, other.words, -share[k] * other.scale / column.scale});
      }
    }
    std::stable_sort(found.trades.begin(), found.trades.end(), [](const Trade& a, const Trade& b) {
      return std::abs(a.factor) > std::abs(b.factor);
    });
    gauge.push_back(std::move(found));
  }
  std::sort(gauge.begin(), gauge.end(),
            [](const GaugeColumn& a, const GaugeColumn& b) { return a.column < b.column; });
  return gauge;
}

}  // namespace bathyal
