// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/identify/model/calibration_data.hpp"

#include <algorithm>
#include <numeric>
#include <set>

#include "bathyal/base/check.hpp"

namespace bathyal {
namespace {

std::vector<double> mean_one(const std::vector<double>& weights, Index rows) {
  if (weights.empty()) return std::vector<double>(static_cast<std::size_t>(rows), 1.0);
  const double sum = std::accumulate(weights.begin(), weights.end(), 0.0);
  std::vector<double> scaled = weights;
  for (double& weight : scaled) weight *= static_cast<double>(rows) / sum;
  return scaled;
}

std::vector<int> or_zeros(const std::vector<int>& numbers, Index rows) {
  return numbers.empty() ? std::vector<int>(static_cast<std::size_t>(rows), 0) : numbers;
}

template <class Data>
Measurement common_part(const Arm& arm, const Data& data) {
  data.check();
  if (data.q.cols() != arm.size()) {
    throw_argument("q", std::to_string(arm.size()) + " columns, the joints of " + arm.name(),
                   std::to_string(data.q.cols()));
  }
  Measurement m;
  m.q = data.q;
  m.weights = mean_one(data.weights, m.rows());
  m.tool = or_zeros(data.tool, m.rows());
  m.station = or_zeros(data.station, m.rows());
  m.tools = *std::max_element(m.tool.begin(), m.tool.end()) + 1;
  m.stations = *std::max_element(m.station.begin(), m.station.end()) + 1;
  return m;
}

}  // namespace

double free_position_rows(const Measurement& m) {
  if (m.tracked) return static_cast<double>(3 * m.rows());
  const auto planar = std::count_if(m.plane.begin(), m.plane.end(), [](int p) { return p >= 0; });
  return static_cast<double>(3 * (m.rows() - planar - m.points()) + planar);
}

double pair_sum(const Measurement& m, const Eigen::Matrix3Xd& deviations) {
  double sum = 0.0;
  for (int p = 0; p < m.points(); ++p) {
    Vec3 total = Vec3::Zero();
    double squares = 0.0;
    double count = 0.0;
    for (Index i = 0; i < m.rows(); ++i) {
      if (m.point[i] != p) continue;
      total += deviations.col(i);
      squares += deviations.col(i).squaredNorm();
      count += 1.0;
    }
    sum += count * squares - total.squaredNorm();
  }
  return sum;
}

Measurement subset(const Measurement& m, const std::vector<int>& rows) {
  Measurement out = m;
  out.weights = picked(m.weights, rows);
  out.tool = picked(m.tool, rows);
  out.station = picked(m.station, rows);
  out.point = picked(m.point, rows);
  out.plane = picked(m.plane, rows);
  out.rotation = picked(m.rotation, rows);
  out.perturbation_rows.clear();
  for (const int row : rows)
    out.perturbation_rows.push_back(static_cast<int>(m.perturbation_row(row)));
  out.q = m.q(rows, Eigen::all);
  if (m.tracked) out.position = m.position(Eigen::all, rows);
  return out;
}

std::string Measurement::name_of(int label) const {
  const auto found = names.find(label);
  return found == names.end() ? std::to_string(label) : found->second;
}

Measurement to_measurement(const Arm& arm, const Touches& touches) {
  Measurement m = common_part(arm, touches);
  m.plane.assign(static_cast<std::size_t>(m.rows()), -1);
  for (std::size_t p = 0; p < touches.planes.size(); ++p) {
    m.plane_names.push_back(touches.planes[p].name);
    for (const int row : touches.planes[p].rows) m.plane[row] = static_cast<int>(p);
  }
  std::set<int> labels;
  for (Index i = 0; i < m.rows(); ++i) {
    if (m.plane[i] < 0) labels.insert(touches.point[i]);
  }
  m.labels.assign(labels.begin(), labels.end());
  m.names = touches.names;
  const auto index = [&m](int label) {
    return static_cast<int>(std::lower_bound(m.labels.begin(), m.labels.end(), label) -
                            m.labels.begin());
  };
  m.point.resize(static_cast<std::size_t>(m.rows()));
  for (Index i = 0; i < m.rows(); ++i) m.point[i] = m.plane[i] < 0 ? index(touches.point[i]) : -1;
  for (const KnownDistance& known : touches.known_distances) {
    m.distances.push_back({index(known.first), index(known.second), known.distance});
  }
  for (const KnownPoint& known : touches.known_points) {
    m.known_points.push_back({index(known.label), known.position});
  }
  m.distance_std = touches.distance_std;
  m.point_std = touches.point_std;
  return m;
}

Measurement to_measurement(const Arm& arm, const Tracked& tracked) {
  Measurement m = common_part(arm, tracked);
  m.tracked = true;
  m.point.assign(static_cast<std::size_t>(m.rows()), -1);
  m.plane.assign(static_cast<std::size_t>(m.rows()), -1);
  m.position = tracked.position.transpose();
  for (const Pose& pose : tracked.pose) m.rotation.push_back(pose.linear());
  return m;
}

}  // namespace bathyal
