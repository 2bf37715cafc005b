// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/identify/fit/calibration_search.hpp"

#include <algorithm>
#include <cmath>

#include "bathyal/identify/fit/residual_noise.hpp"
#include "bathyal/identify/fit/scale_bias.hpp"

namespace bathyal {
namespace {

constexpr int kMaxRounds = 12;
constexpr int kMaxReweightings = 60;
constexpr double kNoiseConverged = 1e-4;  ///< relative
constexpr double kWeightsConverged = 1e-4;
constexpr double kWidthByNoise = 3.0;

class CalibrationSearch {
 public:
  CalibrationSearch(CalibrationProblem& problem, const Observability& observability)
      : problem_(problem),
        observability_(observability),
        options_(problem.options),
        m_(problem.measurement),
        system_(*problem.system),
        result_{problem.start, {}, true, {}} {}

  CalibrationResult run();

 private:
  void solve() { solve(options_.max_iterations); }
  void solve(int max_iterations);
  void solve_with_noise();
  void solve_reweighted();
  void prune();
  bool noise_is_given() const;
  bool noise_matters() const;
  bool update_noise();
  Noise estimate_noise() const;
  double loss_weight(double distance_by_width) const;
  Index least_significant() const;

  CalibrationProblem& problem_;
  const Observability& observability_;
  const IdentifyOptions& options_;
  const Measurement& m_;
  ArmResiduals& system_;
  CalibrationResult result_;
};

CalibrationResult CalibrationSearch::run() {
  system_.set_linear_constraints(
      undetermined_constraints(observability_.undetermined, problem_.parameters.parameters));
  // Where a loose prior alone determines the scale, the noise is estimated with a tight one:
  // otherwise both would shrink together.
  const bool loose =
      !noise_is_given() && !problem_.scale_observed && *problem_.length_prior > options_.size_prior;
  if (loose) problem_.set_length_prior(options_.size_prior);
  solve_with_noise();
  if (loose) {
    problem_.set_length_prior(*problem_.length_prior);
    solve();
  }
  if (options_.loss != Loss::kSquare) solve_reweighted();
  if (options_.prune_sigma) prune();
  if (!m_.tracked && problem_.scale_observed) result_.x = remove_scale_bias(system_, result_.x);
  return std::move(result_);
}

void CalibrationSearch::solve(int max_iterations) {
  const LeastSquaresOptions options{.solver = options_.solver, .max_iterations = max_iterations};
  const LeastSquaresResult found = solve_least_squares(system_, system_.scaled(result_.x), options);
  result_.x = system_.values(found.y);
  result_.converged = found.converged;
  const double unit = system_.noise().position * system_.noise().position;
  for (std::size_t i = result_.history.empty() ? 0 : 1; i < found.history.size(); ++i) {
    result_.history.push_back(found.history[i] * unit);
  }
}

/// The initial noise is a guess: noise and parameters are estimated alternately, one step each,
/// until the noise has converged.
void CalibrationSearch::solve_with_noise() {
  const bool together = noise_matters() && !noise_is_given();
  for (int round = 0; together && round < kMaxRounds; ++round) {
    solve(1);
    if (!update_noise()) break;
  }
  solve();
  for (int round = 0; round < kMaxRounds && update_noise(); ++round) solve();
}

bool CalibrationSearch::noise_is_given() const {
  return options_.noise && (options_.rotation_noise || !m_.has_rotation());
}

/// Whether other rows are weighted against positions.
bool CalibrationSearch::noise_matters() const {
  const auto constraints = static_cast<Index>(system_.linear_constraints().size());
  return system_.rows() > system_.position_rows() + constraints;
}

/// False when the change does not affect the solution.
bool CalibrationSearch::update_noise() {
  if (noise_is_given()) return false;
  const Noise old = system_.noise();
  const Noise noise = estimate_noise();
  system_.set_noise(noise, result_.x);
  return noise_matters() && relative_change(noise, old) > kNoiseConverged;
}

/// The parameters use up the trace of the hat matrix of each kind of row.
Noise CalibrationSearch::estimate_noise() const {
  const Eigen::MatrixXd jacobian = system_.jacobian(result_.x);
  const Index wide = jacobian.cols();
  const Index positions = system_.position_rows();
  const Index rotations = system_.rotation_rows();
  const Index others = jacobian.rows() - positions - rotations;
  const int threads = system_.num_threads();
  const Eigen::MatrixXd of_positions = qr_factor(jacobian.topRows(positions), threads);
  const Eigen::MatrixXd of_rotations =
      qr_factor(jacobian.middleRows(positions, rotations), threads);
  Eigen::MatrixXd together(2 * wide + others, wide);
  together << of_positions, of_rotations, jacobian.bottomRows(others);
  const Eigen::MatrixXd all = qr_factor(together);
  // Every direction is determined by some row, so that the R factor is invertible.
  const auto trace = [&](const Eigen::MatrixXd& part) {
    return all.triangularView<Eigen::Upper>().transpose().solve(part.transpose()).squaredNorm();
  };
  // Not of the rows, which are pairs of touches with the paper's criterion.
  const auto squares = [&](const Eigen::Matrix3Xd& deviations, double unit) {
    double sum = 0.0;
    for (Index i = 0; i < deviations.cols(); ++i) {
      sum += system_.weight(i) * deviations.col(i).squaredNorm();
    }
    return sum / (unit * unit);
  };
  const Noise& noise = system_.noise();
  return residual_noise(system_,
                        {squares(system_.deviations(result_.x), noise.position),
                         squares(system_.rotation_deviations(result_.x), noise.rotation)},
                        {trace(of_positions), trace(of_rotations)}, options_);
}

/// Iteratively reweighted least squares.
void CalibrationSearch::solve_reweighted() {
  for (int round = 0; round < kMaxReweightings; ++round) {
    Eigen::VectorXd distances = system_.deviations(result_.x).colwise().norm();
    for (Index i = 0; i < distances.size(); ++i) distances[i] *= std::sqrt(m_.weights[i]);
    const double noise =
        options_.noise.value_or(std::max(median_noise(system_, distances), kLeastNoise));
    const double width = options_.loss_width.value_or(kWidthByNoise * noise);
    std::vector<double> observation_weights = system_.observation_weights();
    double change = 0.0;
    for (Index i = 0; i < distances.size(); ++i) {
      const double next = loss_weight(distances[i] / width);
      change = std::max(change, std::abs(next - observation_weights[i]));
      observation_weights[i] = next;
    }
    system_.set_observation_weights(std::move(observation_weights));
    system_.set_noise({noise, system_.noise().rotation}, result_.x);
    if (change < kWeightsConverged) break;
    solve();
  }
}

/// Weight of a row by the loss, from its distance in widths.
double CalibrationSearch::loss_weight(double ratio) const {
  if (options_.loss == Loss::kHuber) return ratio > 1.0 ? 1.0 / ratio : 1.0;
  return 1.0 / (1.0 + ratio * ratio);
}

/// One at a time, the least significant first.
void CalibrationSearch::prune() {
  for (Index least = least_significant(); least >= 0; least = least_significant()) {
    std::vector<int> free = system_.free();
    const int column = free[least];
    free.erase(free.begin() + least);
    result_.pruned.push_back(column);
    result_.x[column] = problem_.parameters.parameters[column].nominal;
    system_.set_free(std::move(free));
    solve();
    if (options_.loss == Loss::kSquare) update_noise();
  }
}

/// Index among the free parameters of the row parameter with the fewest std from nominal; -1 when
/// all lie beyond `prune_sigma`.
Index CalibrationSearch::least_significant() const {
  const Eigen::MatrixXd covariance =
      free_covariance(system_, result_.x, observability_.undetermined);
  const Eigen::VectorXd y = system_.scaled(result_.x);
  Index least = -1;
  double least_ratio = *options_.prune_sigma;
  for (Index i = 0; i < y.size(); ++i) {
    const int column = system_.free()[i];
    const double std = std::sqrt(covariance(i, i));
    const bool observable = !takes_part(column, observability_.null_space);
    if (!is_row(problem_.parameters.slots[column]) || !observable || !(std > 0.0)) continue;
    if (std::abs(y[i]) / std < least_ratio) {
      least = i;
      least_ratio = std::abs(y[i]) / std;
    }
  }
  return least;
}

}  // namespace

CalibrationResult search(CalibrationProblem& problem, const Observability& observability) {
  return CalibrationSearch(problem, observability).run();
}

}  // namespace bathyal
