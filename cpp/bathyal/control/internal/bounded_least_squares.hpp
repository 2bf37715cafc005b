// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Dense>
#include <cmath>

namespace bathyal::control_internal {

inline constexpr int kMost = 32;
using Columns =
    Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor, 6 + kMost, kMost>;
using Rows = Eigen::Matrix<double, Eigen::Dynamic, 1, Eigen::ColMajor, 6 + kMost, 1>;
using Unknowns = Eigen::Matrix<double, Eigen::Dynamic, 1, Eigen::ColMajor, kMost, 1>;

/// Least |A x − b| with low ≤ x ≤ high, for A of full column rank: unknowns at a bound are let go
/// one at a time while that lowers the residual, and those that would leave their range are bound
/// (Stark and Parker 1995). Nothing is allocated. \pre low ≤ 0 ≤ high
inline Unknowns bounded_least_squares(const Columns& a, const Rows& b, const Unknowns& low,
                                      const Unknowns& high) {
  const Eigen::Index count = a.cols();
  Unknowns x = Unknowns::Zero(count);
  Eigen::Matrix<int, Eigen::Dynamic, 1, Eigen::ColMajor, kMost, 1> side(count);
  side.setZero();  // −1 at its low bound, 1 at its high one, 0 free
  const double scale = a.cwiseAbs().maxCoeff() * (b.norm() + 1e-300);
  for (int round = 0; round < 10 * static_cast<int>(count) + 10; ++round) {
    // the best of the free ones, the others where they are
    for (;;) {
      Columns part(a.rows(), (side.array() == 0).count());
      Rows rest = b;
      Eigen::Index k = 0;
      for (Eigen::Index j = 0; j < count; ++j) {
        if (side[j] == 0)
          part.col(k++) = a.col(j);
        else
          rest -= a.col(j) * x[j];
      }
      if (k == 0) break;
      const Unknowns best = part.householderQr().solve(rest);
      double share = 1.0;
      Eigen::Index stopped = -1;
      k = 0;
      for (Eigen::Index j = 0; j < count; ++j) {
        if (side[j] != 0) continue;
        const double aim = best[k++], bound = aim > high[j] ? high[j] : low[j];
        if (aim <= high[j] && aim >= low[j]) continue;
        const double part_way = aim != x[j] ? (bound - x[j]) / (aim - x[j]) : 0.0;
        if (stopped < 0 || part_way < share) {
          share = part_way;
          stopped = j;
        }
      }
      k = 0;
      for (Eigen::Index j = 0; j < count; ++j) {
        if (side[j] == 0) x[j] += share * (best[k++] - x[j]);
      }
      if (stopped < 0) break;
      const double aim_side = x[stopped] - low[stopped] < high[stopped] - x[stopped] ? -1.0 : 1.0;
      side[stopped] = aim_side < 0.0 ? -1 : 1;
      x[stopped] = aim_side < 0.0 ? low[stopped] : high[stopped];
    }
    // one whose bound holds it back
    const Unknowns pull = a.transpose() * (b - a * x);
    Eigen::Index freed = -1;
    double most = 1e-12 * scale;
    for (Eigen::Index j = 0; j < count; ++j) {
      if (side[j] == 0 || low[j] == high[j]) continue;
      if (-side[j] * pull[j] > most) {
        most = -side[j] * pull[j];
        freed = j;
      }
    }
    if (freed < 0) break;
    side[freed] = 0;
  }
  return x;
}

}  // namespace bathyal::control_internal
