// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/identify/model/arm_residuals.hpp"

#include <algorithm>
#include <numeric>
#include <span>

#include "bathyal/base/parallel.hpp"
#include "bathyal/geometry/rotation_vector.hpp"

namespace bathyal {
namespace {

using Block = Eigen::Map<Eigen::MatrixXd, 0, Eigen::OuterStride<>>;

double plane_distance(const PlaneGuess& plane, const Vec3& point) {
  return plane.normal.dot(point - plane.center) - plane.offset;
}

}  // namespace

ArmResiduals::ArmResiduals(const ArmParameters& parameters, const Measurement& measurement,
                           Criterion criterion, bool pair_weights, int num_threads)
    : parameters_(parameters),
      m_(measurement),
      criterion_(criterion),
      pair_weights_(pair_weights),
      num_threads_(num_threads),
      free_(parameters.parameters.size()),
      observation_weights_(static_cast<std::size_t>(measurement.rows()), 1.0) {
  set_joints(measurement.q);
  std::iota(free_.begin(), free_.end(), 0);
  for (int i = 0; i < static_cast<int>(m_.rows()); ++i) {
    if (m_.plane[i] >= 0) plane_rows_.push_back(i);
  }
  set_criterion(criterion, pair_weights);
  set_noise(noise_, parameters.nominal());
}

void ArmResiduals::set_joints(const RowMatrix& q) {
  if (joints_ && joints_->q == q) return;
  const std::vector<Joint>& joint_count = parameters_.arm.joints();
  auto joints = std::make_shared<Joints>(Joints{q, {}});
  joints->motions.resize(static_cast<std::size_t>(q.rows()) * joint_count.size());
  parallel_for(static_cast<std::size_t>(q.rows()), kPosesPerChunk, num_threads_,
               [&](std::size_t begin, std::size_t end) {
                 for (std::size_t i = begin; i < end; ++i) {
                   const std::span<const double> pose(q.row(static_cast<Index>(i)).data(),
                                                      static_cast<std::size_t>(q.cols()));
                   for (std::size_t k = 0; k < joint_count.size(); ++k) {
                     joints->motions[i * joint_count.size() + k] =
                         motion_of(joint_count[k], joint_value(joint_count[k], pose));
                   }
                 }
               });
  joints_ = std::move(joints);
}

void ArmResiduals::set_criterion(Criterion criterion, bool pair_weights) {
  criterion_ = criterion;
  pair_weights_ = pair_weights;
  pairs_.clear();
  if (criterion_ == Criterion::kCentroid) return;
  const int n = static_cast<int>(m_.rows());
  for (int j = 0; j < n; ++j) {
    for (int s = j + 1; s < n; ++s) {
      if (m_.point[j] >= 0 && m_.point[j] == m_.point[s]) pairs_.emplace_back(j, s);
    }
  }
}

Index ArmResiduals::position_rows() const {
  if (criterion_ == Criterion::kCentroid) return 3 * m_.rows();
  return 3 * static_cast<Index>(pairs_.size()) + static_cast<Index>(plane_rows_.size());
}

Index ArmResiduals::known_rows() const {
  return static_cast<Index>(m_.distances.size() + 3 * m_.known_points.size());
}

Index ArmResiduals::rows() const {
  Index priors = 0;
  for (const int column : free_) {
    if (use_priors_ && parameters_.parameters[column].prior_std != Parameter::kNoPrior) ++priors;
  }
  return data_rows() + priors + static_cast<Index>(linear_.size());
}

Eigen::VectorXd ArmResiduals::values(const Eigen::VectorXd& y) const {
  Eigen::VectorXd x = parameters_.nominal();
  for (std::size_t i = 0; i < free_.size(); ++i) {
    x[free_[i]] += parameters_.parameters[free_[i]].scale * y[static_cast<Index>(i)];
  }
  return x;
}

Eigen::VectorXd ArmResiduals::scaled(const Eigen::VectorXd& x) const {
  Eigen::VectorXd y(columns());
  for (std::size_t i = 0; i < free_.size(); ++i) {
    const Parameter& column = parameters_.parameters[free_[i]];
    y[static_cast<Index>(i)] = (x[free_[i]] - column.nominal) / column.scale;
  }
  return y;
}

Eigen::Matrix3Xd ArmResiduals::tips(const Eigen::VectorXd& x) const {
  Eigen::Matrix3Xd tips(3, m_.rows());
  fill_tips(ChainDerivatives(parameters_, x, {}), {.tips = tips.data()});
  return tips;
}

Eigen::Matrix3Xd ArmResiduals::centroids(const Eigen::VectorXd& x) const {
  return centroids_of(tips(x));
}

Eigen::Matrix3d ArmResiduals::row_factor(Index row) const {
  const double size = std::sqrt(weight(row)) / noise_.position;
  return size * (row_whitening_ ? row_whitening_->factors[row] : Eigen::Matrix3d::Identity());
}

void ArmResiduals::whiten(Index row, double* error, double* jacobian, Index stride) const {
  if (!row_whitening_) return;
  const Eigen::Matrix3d& root = row_whitening_->factors[row];
  Eigen::Map<Vec3> own(error);
  own = root * Vec3(own);
  for (Index c = 0; jacobian != nullptr && c < columns(); ++c) {
    Eigen::Map<Vec3> column(jacobian + c * stride);
    column = root * Vec3(column);
  }
}

Eigen::Matrix3d ArmResiduals::precision(Index row) const {
  if (!row_whitening_) return weight(row) * Eigen::Matrix3d::Identity();
  const Eigen::Matrix3d& root = row_whitening_->factors[row];
  return weight(row) * (root * root);
}

std::vector<Eigen::Matrix3d> ArmResiduals::centroid_precisions() const {
  std::vector<Eigen::Matrix3d> out(static_cast<std::size_t>(m_.points()), Eigen::Matrix3d::Zero());
  for (Index i = 0; i < m_.rows(); ++i) {
    if (m_.point[i] >= 0) out[m_.point[i]] += precision(i);
  }
  return out;
}

Eigen::Matrix3Xd ArmResiduals::centroids_of(const Eigen::Ref<const Eigen::Matrix3Xd>& tips) const {
  Eigen::Matrix3Xd sum = Eigen::Matrix3Xd::Zero(3, m_.points());
  for (Index i = 0; i < m_.rows(); ++i) {
    if (m_.point[i] >= 0) sum.col(m_.point[i]) += precision(i) * tips.col(i);
  }
  const std::vector<Eigen::Matrix3d> total = centroid_precisions();
  for (Index p = 0; p < sum.cols(); ++p) sum.col(p) = total[p].inverse() * sum.col(p);
  return sum;
}

Eigen::Matrix3Xd ArmResiduals::deviations(const Eigen::VectorXd& x) const {
  Eigen::Matrix3Xd out = tips(x);
  if (m_.tracked) return out - m_.position;
  const Eigen::Matrix3Xd centers = centroids_of(out);
  const ArmState state = state_at(parameters_, x);
  for (Index i = 0; i < m_.rows(); ++i) {
    if (m_.point[i] >= 0) {
      out.col(i) -= centers.col(m_.point[i]);
    } else {
      const PlaneGuess& plane = state.planes[m_.plane[i]];
      out.col(i) = plane_distance(plane, out.col(i)) * plane.normal;
    }
  }
  return out;
}

Eigen::Matrix3Xd ArmResiduals::rotation_deviations(const Eigen::VectorXd& x) const {
  Eigen::Matrix3Xd positions(3, m_.rows());
  Eigen::Matrix3Xd out(3, m_.has_rotation() ? m_.rows() : 0);
  if (m_.has_rotation()) {
    fill_tips(ChainDerivatives(parameters_, x, {}),
              {.tips = positions.data(), .rotations = out.data()});
  }
  return out;
}

/// Tips (3, N) and rotation residuals, with derivatives by the free parameters.
void ArmResiduals::fill_tips(const ChainDerivatives& chain, const TipRows& out) const {
  parallel_for(static_cast<std::size_t>(m_.rows()), kPosesPerChunk, num_threads_,
               [&](std::size_t begin, std::size_t end) {
                 const auto first = static_cast<Index>(begin);
                 const auto from = [first](double* all) { return all ? all + 3 * first : all; };
                 fill_tips(chain, first, static_cast<Index>(end),
                           {from(out.tips), from(out.jacobian), from(out.rotations),
                            from(out.rotation_jacobian), out.stride});
               });
}

void ArmResiduals::fill_tips(const ChainDerivatives& chain, Index begin, Index end,
                             const TipRows& out) const {
  ChainFrames frames;
  const std::size_t joint_count = parameters_.arm.joints().size();
  for (Index i = begin; i < end; ++i) {
    const Index row = 3 * (i - begin);
    double* shift = out.jacobian == nullptr ? nullptr : out.jacobian + row;
    double* turn = out.rotation_jacobian == nullptr ? nullptr : out.rotation_jacobian + row;
    const ChainPose joints(joints_->q.row(i).data(),
                           joints_->motions.data() + static_cast<std::size_t>(i) * joint_count);
    const Pose pose = chain.tip(joints, m_.perturbation_row(i), m_.tool[i], m_.station[i], frames,
                                shift, turn, out.stride);
    Eigen::Map<Vec3>(out.tips + row) = pose.translation();
    if (out.rotations == nullptr) continue;
    const Vec3 error = vector_of(pose.linear() * m_.rotation[i].transpose());
    Eigen::Map<Vec3>(out.rotations + row) = error;
    if (turn == nullptr) continue;
    const Eigen::Matrix3d error_by_turn = left_jacobian(error).inverse();
    for (Index c = 0; c < columns(); ++c) {
      Eigen::Map<Vec3> column(turn + c * out.stride);
      column = error_by_turn * Vec3(column);
    }
  }
}

/// State of one evaluation. The Jacobian is in the units of the parameters until the end.
struct ArmResiduals::Evaluation {
  Eigen::Map<Eigen::VectorXd> residuals;
  Block jacobian;  ///< all rows; no rows without derivatives
  Eigen::Map<Eigen::Matrix3Xd> tips;
  Block tip_jacobian;               ///< (3 N, columns)
  Eigen::Matrix3Xd centers;         ///< of the touched points
  Eigen::MatrixXd center_jacobian;  ///< (3 n, columns)
  std::vector<double> total;        ///< weight of each point
  bool derive;
};

void ArmResiduals::evaluate(const double* y, double* residuals, double* jacobian) const {
  const Eigen::VectorXd x = values(Eigen::Map<const Eigen::VectorXd>(y, columns()));
  const ChainDerivatives chain(parameters_, x, free_);
  const Index n = m_.rows();
  const Index count = rows();
  const bool derive = jacobian != nullptr;

  // Tips are written in place for the centroid criterion; pairs use scratch arrays.
  const bool in_place = criterion_ == Criterion::kCentroid;
  Eigen::VectorXd tip_scratch(in_place ? 0 : 3 * n);
  Eigen::MatrixXd jacobian_scratch(in_place || !derive ? 0 : 3 * n, columns());
  TipRows out{in_place ? residuals : tip_scratch.data(),
              in_place || !derive ? jacobian : jacobian_scratch.data(), nullptr, nullptr,
              in_place ? count : 3 * n};
  if (m_.has_rotation()) {
    out.rotations = residuals + 3 * n;
    out.rotation_jacobian = derive ? jacobian + 3 * n : nullptr;
  }
  fill_tips(chain, out);

  Evaluation evaluation{
      {residuals, count},
      {jacobian, derive ? count : 0, columns(), Eigen::OuterStride<>(count)},
      {out.tips, 3, n},
      {out.jacobian, derive ? 3 * n : 0, columns(), Eigen::OuterStride<>(out.stride)},
      {},
      {},
      {},
      derive};
  if (m_.tracked) {
    compare_tracked(0, n, out);
    scale_means(evaluation.residuals, -0.5);
    if (derive) scale_means(evaluation.jacobian, -0.5);
  } else {
    find_centers(evaluation);
    if (in_place) compare_with_centers(evaluation);
    if (!in_place) compare_pairs(evaluation);
    compare_planes(chain, evaluation);
    compare_known(evaluation);
  }
  const Eigen::MatrixXd linear = linear_rows_at(y);
  evaluation.residuals.tail(linear.rows()) = linear.rightCols(1);
  if (!derive) return;
  evaluation.jacobian.bottomRows(linear.rows()) = linear.leftCols(columns());
  const Eigen::VectorXd scale = scales();
  for (Index c = 0; c < columns(); ++c) evaluation.jacobian.col(c) *= scale[c];
}

Eigen::MatrixXd ArmResiduals::jacobian(const Eigen::VectorXd& x) const {
  Eigen::VectorXd residuals(rows());
  Eigen::MatrixXd jacobian(rows(), columns());
  evaluate(scaled(x).data(), residuals.data(), jacobian.data());
  return jacobian;
}

void ArmResiduals::find_centers(Evaluation& evaluation) const {
  evaluation.centers = centroids_of(evaluation.tips);
  evaluation.total.assign(static_cast<std::size_t>(m_.points()), 0.0);
  evaluation.center_jacobian.setZero(evaluation.derive ? 3 * m_.points() : 0, columns());
  for (Index i = 0; i < m_.rows(); ++i) {
    if (m_.point[i] < 0) continue;
    evaluation.total[m_.point[i]] += weight(i);
    if (!evaluation.derive) continue;
    auto center = evaluation.center_jacobian.middleRows(3 * m_.point[i], 3);
    const auto own = evaluation.tip_jacobian.middleRows(3 * i, 3);
    if (row_whitening_) {
      center += precision(i) * own;
    } else {
      center += weight(i) * own;
    }
  }
  if (!evaluation.derive) return;
  const std::vector<Eigen::Matrix3d> total = centroid_precisions();
  for (int p = 0; p < m_.points(); ++p) {
    auto rows = evaluation.center_jacobian.middleRows(3 * p, 3);
    rows = total[p].inverse() * rows;
  }
}

/// Sum over pairs = total · sum about the centroid: with `pair_weights_` both criteria have the
/// same cost.
void ArmResiduals::compare_with_centers(Evaluation& evaluation) const {
  for (Index i = 0; i < m_.rows(); ++i) {
    const int p = m_.point[i];
    if (p < 0) continue;
    const double scale =
        std::sqrt(weight(i) * (pair_weights_ ? evaluation.total[p] : 1.0)) / noise_.position;
    evaluation.tips.col(i) = scale * (evaluation.tips.col(i) - evaluation.centers.col(p));
    if (evaluation.derive) {
      evaluation.tip_jacobian.middleRows(3 * i, 3) =
          scale * (evaluation.tip_jacobian.middleRows(3 * i, 3) -
                   evaluation.center_jacobian.middleRows(3 * p, 3));
    }
    whiten(i, evaluation.tips.col(i).data(),
           evaluation.derive ? evaluation.tip_jacobian.data() + 3 * i : nullptr,
           evaluation.tip_jacobian.outerStride());
  }
}

void ArmResiduals::compare_pairs(Evaluation& evaluation) const {
  Index row = 0;
  for (const auto& [j, s] : pairs_) {
    const double scale = std::sqrt(weight(j) * weight(s)) / noise_.position;
    evaluation.residuals.segment<3>(row) =
        scale * (evaluation.tips.col(j) - evaluation.tips.col(s));  // eq 9
    if (evaluation.derive) {
      evaluation.jacobian.middleRows(row, 3) =
          scale * (evaluation.tip_jacobian.middleRows(3 * j, 3) -
                   evaluation.tip_jacobian.middleRows(3 * s, 3));
    }
    row += 3;
  }
}

/// One residual a touch. With the centroid criterion it is the first of the three rows of the
/// touch, and the others are zero.
void ArmResiduals::compare_planes(const ChainDerivatives& chain, Evaluation& evaluation) const {
  Index row = 3 * static_cast<Index>(pairs_.size());
  for (const int i : plane_rows_) {
    const int index = m_.plane[i];
    const PlaneGuess& plane = chain.state().planes[index];
    double scale = std::sqrt(weight(i)) / noise_.position;
    // The mean over directions: with the normal alone, a change of the normal would count.
    if (row_whitening_)
      scale /= std::sqrt(row_whitening_->factors[i].inverse().squaredNorm() / 3.0);
    const Vec3 tip = evaluation.tips.col(i);
    Eigen::RowVectorXd derivative(evaluation.derive ? columns() : 0);
    for (Index c = 0; c < derivative.size(); ++c) {
      derivative[c] = plane.normal.dot(Vec3(evaluation.tip_jacobian.col(c).segment<3>(3 * i)));
      const ParameterSlot& slot = parameters_.slots[free_[c]];
      if (slot.index != index) continue;
      if (slot.kind == ParameterKind::kPlaneShift) derivative[c] -= 1.0;
      if (slot.kind == ParameterKind::kPlaneTurn) {
        derivative[c] += chain.plane_turn(static_cast<std::size_t>(c))
                             .cross(plane.normal)
                             .dot(tip - plane.center);
      }
    }
    const bool in_place = criterion_ == Criterion::kCentroid;
    const Index place = in_place ? 3 * i : row++;
    if (in_place) {
      evaluation.residuals.segment<3>(place).setZero();
      if (evaluation.derive) evaluation.jacobian.middleRows(place, 3).setZero();
    }
    evaluation.residuals[place] = scale * plane_distance(plane, tip);
    if (evaluation.derive) evaluation.jacobian.row(place) = scale * derivative;
  }
}

void ArmResiduals::compare_known(Evaluation& evaluation) const {
  if (known_rows() == 0) return;
  Eigen::VectorXd residuals;
  Eigen::MatrixXd by_center;
  known_residuals(evaluation.centers, residuals, by_center);
  evaluation.residuals.segment(position_rows(), known_rows()) = whitening_ * residuals;
  if (evaluation.derive) {
    evaluation.jacobian.middleRows(position_rows(), known_rows()) =
        whitening_ * (by_center * evaluation.center_jacobian);
  }
}

}  // namespace bathyal
