// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/identify/verify.hpp"

#include <cmath>
#include <numeric>
#include <string>

#include "bathyal/base/error.hpp"
#include "bathyal/geometry/align.hpp"

namespace bathyal {
namespace {

PointMatrix rows_of(PointView points, const std::vector<Index>& rows) {
  PointMatrix chosen(static_cast<Index>(rows.size()), 3);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (rows[i] < 0 || rows[i] >= points.rows()) {
      throw_argument("pairs", "rows of the " + std::to_string(points.rows()) + " measured",
                     std::to_string(rows[i]));
    }
    chosen.row(static_cast<Index>(i)) = points.row(rows[i]);
  }
  return chosen;
}

double rms(const PointMatrix& errors) {
  return std::sqrt(errors.squaredNorm() / static_cast<double>(errors.rows()));
}

}  // namespace

Verification verify_positions(PointView predicted, PointView measured,
                              const std::vector<Index>& pairs) {
  Verification result;
  result.pairs = pairs;
  if (pairs.empty()) {
    result.pairs.resize(static_cast<std::size_t>(measured.rows()));
    std::iota(result.pairs.begin(), result.pairs.end(), Index{0});
  }
  const PointMatrix target = rows_of(measured, result.pairs);
  const PointView onto(target.data(), target.rows(), 3);
  const Pose motion = align(predicted, onto);
  result.measured_from_predicted = motion;
  const PointMatrix apart = target - predicted;
  result.rms_before = rms(apart.rowwise() - apart.colwise().mean());
  result.residual = target - ((predicted * motion.linear().transpose()).rowwise() +
                              motion.translation().transpose());
  result.rms_after = rms(result.residual);
  for (Index i = 0; i < target.rows(); ++i) {
    result.deviation.push_back(result.residual.row(i).norm());
  }
  return result;
}

}  // namespace bathyal
