// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/identify/fit/internal/initial_guess.hpp"

#include <algorithm>
#include <map>

namespace bathyal::identify {
namespace {

/// Poses used by the linear estimate: more would not improve it.
constexpr Index kMostPoses = 500;

std::vector<Pose> flanges(const Arm& arm, const Measurement& m) {
  Arm bare = arm;
  bare.set_base(Pose::Identity());
  bare.set_tool(Pose::Identity());
  std::vector<Pose> poses;
  RowFrames frames;
  for (Index i = 0; i < m.rows(); ++i) {
    compute_row_frames(bare, {m.q.row(i).data(), static_cast<std::size_t>(m.q.cols())}, frames);
    poses.push_back(frames.world_from_tool);
  }
  return poses;
}

Eigen::Matrix3d nearest_rotation(const Eigen::Matrix3d& matrix) {
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(matrix, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Eigen::Matrix3d flip = Eigen::Matrix3d::Identity();
  flip(2, 2) = (svd.matrixU() * svd.matrixV().transpose()).determinant() < 0.0 ? -1.0 : 1.0;
  return svd.matrixU() * flip * svd.matrixV().transpose();
}

/// Least squares of minimum norm.
Eigen::VectorXd solve_smallest(const Eigen::MatrixXd& matrix, const Eigen::VectorXd& right) {
  Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd> decomposition;
  decomposition.setThreshold(1e-9);
  return decomposition.compute(matrix).solve(right);
}

/// X_f + R_f X_TCP - X_probe = 0 for touches of one tool, with a probe for each group of rows.
struct TipEquations {
  Eigen::MatrixXd matrix;
  Eigen::VectorXd right;

  TipEquations(const std::vector<Pose>& flange, const std::vector<std::vector<int>>& groups) {
    std::size_t rows = 0;
    for (const auto& group : groups) rows += group.size();
    matrix.setZero(static_cast<Index>(3 * rows), static_cast<Index>(3 + 3 * groups.size()));
    right.resize(matrix.rows());
    Index row = 0;
    for (std::size_t g = 0; g < groups.size(); ++g) {
      for (const int i : groups[g]) {
        matrix.block<3, 3>(row, 0) = flange[i].linear();  // Omega of eq 14
        matrix.block<3, 3>(row, static_cast<Index>(3 + 3 * g)) = -Eigen::Matrix3d::Identity();
        right.segment<3>(row) = -flange[i].translation();
        row += 3;
      }
    }
  }
};

/// Eq 12-16: one tool centre point from the touches of each point, averaged over the points that
/// determine it. Where none does by itself, from all points together.
Vec3 touched_tool(const std::vector<Pose>& flange, const Measurement& m, int tool) {
  std::map<std::pair<int, int>, std::vector<int>> by_point;
  for (int i = 0; i < static_cast<int>(m.rows()); ++i) {
    if (m.tool[i] == tool && m.point[i] >= 0) by_point[{m.point[i], m.station[i]}].push_back(i);
  }
  std::vector<std::vector<int>> groups;
  Vec3 sum = Vec3::Zero();
  int determined = 0;
  for (const auto& [key, group] : by_point) {
    groups.push_back(group);
    const TipEquations equations(flange, {group});
    Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr;
    qr.setThreshold(1e-3);
    qr.compute(equations.matrix);
    if (qr.rank() < 6) continue;
    sum += qr.solve(equations.right).head<3>();  // eq 15
    ++determined;
  }
  if (determined > 0) return sum / determined;  // eq 16
  if (groups.empty()) return Vec3::Zero();
  const TipEquations together(flange, groups);
  return solve_smallest(together.matrix, together.right).head<3>();
}

/// (3, points) centroids of the tips that one station touched, in its base's frame; NaN for
/// points that it did not touch.
Eigen::Matrix3Xd station_points(const std::vector<Pose>& flange, const Measurement& m,
                                const std::vector<Pose>& tools, int station) {
  Eigen::Matrix3Xd sum = Eigen::Matrix3Xd::Zero(3, m.points());
  Eigen::VectorXd count = Eigen::VectorXd::Zero(m.points());
  for (Index i = 0; i < m.rows(); ++i) {
    if (m.station[i] != station || m.point[i] < 0) continue;
    sum.col(m.point[i]) += flange[i] * tools[m.tool[i]].translation();
    count[m.point[i]] += 1.0;
  }
  for (Index p = 0; p < sum.cols(); ++p) sum.col(p) /= count[p];
  return sum;
}

/// The rigid motion that takes the points of `from` to those of `to`, over the columns that both
/// have; fewer than three leave the rotation of `guess`.
Pose align(const Eigen::Matrix3Xd& from, const Eigen::Matrix3Xd& to, const Pose& guess) {
  Eigen::Matrix3Xd source(3, from.cols());
  Eigen::Matrix3Xd target(3, from.cols());
  Index shared = 0;
  for (Index p = 0; p < from.cols(); ++p) {
    if (!from.col(p).allFinite() || !to.col(p).allFinite()) continue;
    source.col(shared) = from.col(p);
    target.col(shared) = to.col(p);
    ++shared;
  }
  if (shared == 0) return guess;
  Pose pose = guess;
  if (shared >= 3) {
    pose.matrix() = Eigen::umeyama(source.leftCols(shared), target.leftCols(shared), false);
  } else {
    pose.translation() = target.leftCols(shared).rowwise().mean() -
                         pose.linear() * source.leftCols(shared).rowwise().mean();
  }
  return pose;
}

void start_stations(const std::vector<Pose>& flange, const Measurement& m, bool base_free,
                    InitialGuess& start) {
  Eigen::Matrix3Xd world = Eigen::Matrix3Xd::Constant(3, m.points(), std::nan(""));
  for (const KnownPoint& known : m.known_points) world.col(known.label) = known.position;
  for (int station = 0; station < m.stations; ++station) {
    const Eigen::Matrix3Xd own = station_points(flange, m, start.tools, station);
    if (station > 0 || base_free) start.bases[station] = align(own, world, start.bases[station]);
    for (Index p = 0; p < own.cols(); ++p) {
      const bool unknown = !world.col(p).allFinite();
      if (unknown && own.col(p).allFinite()) world.col(p) = start.bases[station] * own.col(p);
    }
  }
}

void start_planes(const std::vector<Pose>& flange, const Measurement& m, InitialGuess& start) {
  for (std::size_t plane = 0; plane < m.plane_names.size(); ++plane) {
    std::vector<Vec3> tips;
    for (Index i = 0; i < m.rows(); ++i) {
      if (m.plane[i] != static_cast<int>(plane)) continue;
      tips.push_back(start.bases[m.station[i]] *
                     (flange[i] * start.tools[m.tool[i]].translation()));
    }
    PlaneGuess guess;
    for (const Vec3& tip : tips) guess.center += tip / static_cast<double>(tips.size());
    Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
    for (const Vec3& tip : tips) {
      spread += (tip - guess.center) * (tip - guess.center).transpose();
    }
    guess.normal = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(spread).eigenvectors().col(0);
    start.planes.push_back(guess);
  }
}

/// Sum of squared errors of the tracked tips.
double squared_error(const std::vector<Pose>& flange, const Measurement& m,
                     const InitialGuess& start) {
  double squares = 0.0;
  for (Index i = 0; i < m.rows(); ++i) {
    const Vec3 tip = flange[i] * start.tools[m.tool[i]].translation();
    squares += (start.bases[m.station[i]] * tip - m.position.col(i)).squaredNorm();
  }
  return squares;
}

/// Bases for given tools, tools for given bases, alternately, starting with the tools of `start`:
/// each is optimal for the other.
InitialGuess alternate(const std::vector<Pose>& flange, const Measurement& m, bool tool_given,
                       bool base_free, InitialGuess start) {
  constexpr int kTurns = 20;
  std::vector<std::vector<Index>> of_station(static_cast<std::size_t>(m.stations));
  for (Index i = 0; i < m.rows(); ++i) of_station[m.station[i]].push_back(i);
  for (int turn = 0; turn < kTurns; ++turn) {
    Eigen::Matrix3Xd tips(3, m.rows());
    for (Index i = 0; i < m.rows(); ++i) {
      tips.col(i) = flange[i] * start.tools[m.tool[i]].translation();
    }
    for (int station = 0; base_free && station < m.stations; ++station) {
      const std::vector<Index>& rows = of_station[station];
      start.bases[station] =
          align(tips(Eigen::all, rows), m.position(Eigen::all, rows), start.bases[station]);
    }
    if (tool_given) break;
    Eigen::Matrix3Xd sum = Eigen::Matrix3Xd::Zero(3, m.tools);
    Eigen::VectorXd count = Eigen::VectorXd::Zero(m.tools);
    for (Index i = 0; i < m.rows(); ++i) {
      sum.col(m.tool[i]) +=
          flange[i].inverse() * (start.bases[m.station[i]].inverse() * m.position.col(i));
      count[m.tool[i]] += 1.0;
    }
    for (int tool = 0; tool < m.tools; ++tool) {
      if (count[tool] > 0.0) start.tools[tool].translation() = sum.col(tool) / count[tool];
    }
  }
  return start;
}

/// A p - c - R t = f with A the inverse rotation of a station's base, taken as any matrix, c its
/// shift and t a tool: linear in all of them.
void start_tracked(const std::vector<Pose>& flange, const Measurement& m, bool tool_given,
                   bool base_free, InitialGuess& start) {
  const Index step = std::max<Index>(1, m.rows() / kMostPoses);
  const Index used = (m.rows() + step - 1) / step;
  const Index frames = base_free ? 12 * m.stations : 0;
  const Vec3 center = m.position.rowwise().mean();
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(3 * used, frames + (tool_given ? 0 : 3 * m.tools));
  Eigen::VectorXd right(3 * used);
  for (Index k = 0; k < used; ++k) {
    const Index i = k * step;
    Vec3 target = flange[i].translation();
    if (tool_given) target += flange[i].linear() * start.tools[m.tool[i]].translation();
    if (base_free) {
      for (int axis = 0; axis < 3; ++axis) {
        matrix.block<1, 3>(3 * k + axis, 12 * m.station[i] + 3 * axis) =
            (m.position.col(i) - center).transpose();
      }
      matrix.block<3, 3>(3 * k, 12 * m.station[i] + 9) = -Eigen::Matrix3d::Identity();
    } else {
      target -= start.bases[m.station[i]].inverse() * Vec3(m.position.col(i));
    }
    if (!tool_given) {
      matrix.block<3, 3>(3 * k, frames + 3 * m.tool[i]) = -flange[i].linear();
    }
    right.segment<3>(3 * k) = target;
  }
  const Eigen::VectorXd solution = solve_smallest(matrix, right);
  const InitialGuess other = alternate(flange, m, tool_given, base_free, start);
  for (int station = 0; base_free && station < m.stations; ++station) {
    Eigen::Matrix3d base_from_world;
    for (int axis = 0; axis < 3; ++axis) {
      base_from_world.row(axis) = solution.segment<3>(12 * station + 3 * axis).transpose();
    }
    Pose& base = start.bases[station];
    base.linear() = nearest_rotation(base_from_world).transpose();
    base.translation() = center + base.linear() * solution.segment<3>(12 * station + 9);
  }
  for (int tool = 0; !tool_given && tool < m.tools; ++tool) {
    start.tools[tool].translation() = solution.segment<3>(frames + 3 * tool);
  }
  // With few joints the estimated matrix may be far from a rotation.
  constexpr double kMuchLess = 0.5;
  if (squared_error(flange, m, other) < kMuchLess * squared_error(flange, m, start)) start = other;
  if (!m.has_rotation()) return;
  std::vector<Eigen::Matrix3d> sum(static_cast<std::size_t>(m.tools), Eigen::Matrix3d::Zero());
  for (Index i = 0; i < m.rows(); ++i) {
    sum[m.tool[i]] +=
        (start.bases[m.station[i]].linear() * flange[i].linear()).transpose() * m.rotation[i];
  }
  for (int tool = 0; !tool_given && tool < m.tools; ++tool) {
    start.tools[tool].linear() = nearest_rotation(sum[tool]);
  }
}

}  // namespace

InitialGuess find_initial_guess(const Arm& arm, const Measurement& m, bool tool_given,
                                bool base_free) {
  InitialGuess start{std::vector<Pose>(static_cast<std::size_t>(m.stations), arm.base()),
                     std::vector<Pose>(static_cast<std::size_t>(m.tools), arm.tool()),
                     {}};
  const std::vector<Pose> flange = flanges(arm, m);
  if (m.tracked) {
    start_tracked(flange, m, tool_given, base_free, start);
    return start;
  }
  for (int tool = 0; !tool_given && tool < m.tools; ++tool) {
    start.tools[tool].translation() = touched_tool(flange, m, tool);
  }
  start_stations(flange, m, base_free, start);
  start_planes(flange, m, start);
  return start;
}

}  // namespace bathyal::identify
