// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/arm/internal/inverse_stepping.hpp"

#include <algorithm>

#include "bathyal/arm/inverse_problem.hpp"

namespace bathyal::arm {
namespace {

/// A smaller singular value of the Jacobian, over the largest, counts as none.
constexpr double kRankTolerance = 1e-6;

Index task_rank(InverseTask task) {
  switch (task) {
    case InverseTask::kPose:
      return 6;
    case InverseTask::kPosition:
      return 3;
    case InverseTask::kPositionAxis:
      return 5;
  }
  return 6;
}

class Stepping final : public InverseRows {
 public:
  Stepping(const Arm& arm, const InverseOptions& options)
      : options_(options), problem_(arm, options) {}

  void solve(std::span<const PlainPose> targets, std::size_t begin, std::size_t end,
             const double* starts, std::size_t start_step, InverseResult& result) const override {
    TipState state(problem_.program.view, problem_.task);
    for (std::size_t row = begin; row < end; ++row) {
      solve_row(state, problem_.relative(targets[row]),
                starts == nullptr ? problem_.middle.data() : starts + row * start_step, row,
                result);
    }
  }

 private:
  using Rows = Eigen::Matrix<double, 6, Eigen::Dynamic, Eigen::RowMajor>;

  void solve_row(TipState& state, const PlainPose& target, const double* start, std::size_t row,
                 InverseResult& result) const {
    Eigen::VectorXd q = Eigen::Map<const Eigen::VectorXd>(start, size());
    bool singular = false;
    int iteration = 0;
    for (;; ++iteration) {
      state.evaluate(target, q.data());
      // The k-th of `steps` takes 1 / (steps − k) of the rest: equal parts of the way.
      const int left = std::max(options_.steps - iteration, 1);
      if ((left == 1 && reached(state)) || singular ||
          iteration == options_.steps + options_.max_iterations) {
        break;
      }
      singular = !advance(state, 1.0 / left, q);
    }
    problem_.unwind({start, problem_.size()}, q.data());
    result.q.row(static_cast<Index>(row)) = q.transpose();
    result.error[row] = state.error();
    result.position_error[row] = state.position_error();
    result.angle_error[row] = state.angle_error();
    result.iterations[row] = iteration;
    result.starts[row] = 1;
    result.status[row] = reached(state) ? problem_.within_limits(q.data()) ? InverseStatus::kReached
                                                                           : InverseStatus::kLimit
                         : singular     ? InverseStatus::kSingular
                                        : InverseStatus::kOutOfReach;
  }

  /// q += J⁺ (share of the residual); false where J has not the rank of the task.
  bool advance(const TipState& state, double share, Eigen::VectorXd& q) const {
    const Eigen::Map<const Rows> jacobian(state.jacobian(), 6, size());
    const Eigen::Map<const Eigen::Matrix<double, 6, 1>> residual(state.residual());
    Eigen::JacobiSVD<Eigen::MatrixXd> svd(jacobian, Eigen::ComputeThinU | Eigen::ComputeThinV);
    svd.setThreshold(kRankTolerance);
    if (svd.rank() < std::min(task_rank(problem_.task.kind), size())) return false;
    q += svd.solve(share * residual);
    return q.allFinite();
  }

  bool reached(const TipState& state) const {
    return state.position_error() <= problem_.position_tolerance &&
           state.angle_error() <= problem_.angle_tolerance;
  }

  Index size() const { return static_cast<Index>(problem_.size()); }

  const InverseOptions options_;
  const InverseProblem problem_;
};

}  // namespace

std::unique_ptr<InverseRows> make_stepping(const Arm& arm, const InverseOptions& options) {
  return std::make_unique<Stepping>(arm, options);
}

}  // namespace bathyal::arm
