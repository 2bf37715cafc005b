// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/identify/verify.hpp"

#include <cmath>
#include <numeric>
#include <string>

#include "bathyal/base/error.hpp"
#include "bathyal/geometry/align.hpp"

namespace bathyal {
namespace {

void check_pairs(const std::vector<Index>& pairs, Index predictions, Index positions) {
  if (static_cast<Index>(pairs.size()) != predictions) {
    throw_argument("pairs", "one for each of " + std::to_string(predictions) + " predictions",
                   std::to_string(pairs.size()));
  }
  std::vector<bool> used(static_cast<std::size_t>(positions), false);
  for (const Index row : pairs) {
    if (row < 0 || row >= positions) {
      throw_argument("pairs", "rows of the " + std::to_string(positions) + " positions",
                     std::to_string(row));
    }
    if (used[row]) throw_argument("pairs", "each row once", std::to_string(row) + " twice");
    used[row] = true;
  }
}

PointMatrix rows_of(PointView points, const std::vector<Index>& rows) {
  PointMatrix chosen(static_cast<Index>(rows.size()), 3);
  for (Index i = 0; i < chosen.rows(); ++i) chosen.row(i) = points.row(rows[i]);
  return chosen;
}

double rms(const PointMatrix& errors) {
  return std::sqrt(errors.squaredNorm() / static_cast<double>(errors.rows()));
}

}  // namespace

Verification verify_positions(PointView predicted, PointView positions,
                              const std::vector<Index>& pairs) {
  Verification result;
  result.pairs = pairs;
  if (pairs.empty()) {
    result.pairs.resize(static_cast<std::size_t>(positions.rows()));
    std::iota(result.pairs.begin(), result.pairs.end(), Index{0});
  } else {
    check_pairs(pairs, predicted.rows(), positions.rows());
  }
  const PointMatrix target = rows_of(positions, result.pairs);
  const PointView onto(target.data(), target.rows(), 3);
  const Pose motion = align(predicted, onto, "predicted", "positions");
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
