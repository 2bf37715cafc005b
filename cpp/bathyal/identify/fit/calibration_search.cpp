// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/identify/fit/calibration_search.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace bathyal {
namespace {

constexpr int kMostRounds = 12;
constexpr int kMostTrustRounds = 60;
constexpr double kNoiseSettled = 1e-4;  ///< relative
constexpr double kTrustSettled = 1e-4;
constexpr double kSizeSettled = 1e-6;  ///< in units of the columns' scale: nm and nrad
constexpr double kWidthByNoise = 3.0;

class Search {
 public:
  Search(ArmProblem& problem, const Observability& seen)
      : problem_(problem),
        seen_(seen),
        options_(problem.options),
        m_(problem.measurement),
        system_(*problem.system),
        result_{problem.start, {}, true, {}} {}

  SearchResult run();

 private:
  void solve() { solve(options_.max_iterations); }
  void solve(int max_iterations);
  void solve_with_noise();
  void solve_with_trust();
  void prune();
  void undo_size_draw();
  bool noise_is_told() const;
  bool noise_matters() const;
  bool update_noise();
  Noise estimate_noise() const;
  double trust_in(double distance_by_width) const;
  Index least_sure() const;

  ArmProblem& problem_;
  const Observability& seen_;
  const IdentifyOptions& options_;
  const Measurement& m_;
  ArmSystem& system_;
  SearchResult result_;
};

SearchResult Search::run() {
  system_.set_linear_rows(rows_to_hold(seen_.blind, problem_.columns.columns));
  // Where a loose prior alone holds the size, the noise that it is weighed against is found with a
  // firm one: else both shrink together.
  const bool loose =
      !noise_is_told() && !problem_.size_told && *problem_.length_prior > options_.size_prior;
  if (loose) problem_.set_length_prior(options_.size_prior);
  solve_with_noise();
  if (loose) {
    problem_.set_length_prior(*problem_.length_prior);
    solve();
  }
  if (options_.loss != Loss::kSquare) solve_with_trust();
  if (options_.prune_sigma) prune();
  if (!m_.tracked && problem_.size_told) undo_size_draw();
  return std::move(result_);
}

void Search::solve(int max_iterations) {
  const LeastSquaresOptions options{.solver = options_.solver, .max_iterations = max_iterations};
  const LeastSquaresResult found = solve_least_squares(system_, system_.scaled(result_.x), options);
  result_.x = system_.values(found.y);
  result_.converged = found.converged;
  const double unit = system_.noise().position * system_.noise().position;
  for (std::size_t i = result_.history.empty() ? 0 : 1; i < found.history.size(); ++i) {
    result_.history.push_back(found.history[i] * unit);
  }
}

/// The first noise is a guess, and what it is weighed into is worth no more than a step: noise and
/// numbers are found together, a step each, until the noise stands.
void Search::solve_with_noise() {
  const bool together = noise_matters() && !noise_is_told();
  for (int round = 0; together && round < kMostRounds; ++round) {
    solve(1);
    if (!update_noise()) break;
  }
  solve();
  for (int round = 0; round < kMostRounds && update_noise(); ++round) solve();
}

bool Search::noise_is_told() const {
  return options_.noise && (options_.rotation_noise || !m_.has_rotation());
}

/// Whether anything is weighed against positions.
bool Search::noise_matters() const {
  const auto held = static_cast<Index>(system_.linear_rows().size());
  return system_.rows() > system_.position_rows() + held;
}

/// False when nothing changed that the solution depends on.
bool Search::update_noise() {
  if (noise_is_told()) return false;
  const Noise old = system_.noise();
  const Noise noise = estimate_noise();
  system_.set_noise(noise, result_.x);
  return noise_matters() && (std::abs(noise.position / old.position - 1.0) > kNoiseSettled ||
                             std::abs(noise.rotation / old.rotation - 1.0) > kNoiseSettled);
}

/// Each kind of row by its own residuals: σ² = Σ r² / (rows - what the columns take of them).
Noise Search::estimate_noise() const {
  const Eigen::MatrixXd jacobian = system_.jacobian(result_.x);
  const Index wide = jacobian.cols();
  const Index positions = system_.position_rows();
  const Index rotations = system_.rotation_rows();
  const Index others = jacobian.rows() - positions - rotations;
  const int threads = system_.num_threads();
  const Eigen::MatrixXd of_positions = triangle_of(jacobian.topRows(positions), threads);
  const Eigen::MatrixXd of_rotations =
      triangle_of(jacobian.middleRows(positions, rotations), threads);
  Eigen::MatrixXd together(2 * wide + others, wide);
  together << of_positions, of_rotations, jacobian.bottomRows(others);
  const Eigen::MatrixXd all = triangle_of(together);
  const auto estimate = [&](const Eigen::Matrix3Xd& residuals, const Eigen::MatrixXd& part,
                            double rows, double old) {
    double sum = 0.0;
    for (Index i = 0; i < m_.rows(); ++i) sum += system_.weight(i) * residuals.col(i).squaredNorm();
    // Every direction is held by something, so that the triangle can be inverted.
    const Eigen::MatrixXd taken =
        all.triangularView<Eigen::Upper>().transpose().solve(part.transpose());
    const double freedom = rows - taken.squaredNorm();
    return freedom > 0.5 ? std::max(std::sqrt(sum / freedom), kLeastNoise) : old;
  };
  Noise noise = system_.noise();
  if (!options_.noise) {
    noise.position = estimate(system_.deviations(result_.x), of_positions, free_position_rows(m_),
                              noise.position);
  }
  if (m_.has_rotation() && !options_.rotation_noise) {
    noise.rotation = estimate(system_.turns(result_.x), of_rotations,
                              static_cast<double>(3 * m_.rows()), noise.rotation);
  }
  return noise;
}

/// Iteratively reweighted least squares.
void Search::solve_with_trust() {
  for (int round = 0; round < kMostTrustRounds; ++round) {
    Eigen::VectorXd distances = system_.deviations(result_.x).colwise().norm();
    for (Index i = 0; i < distances.size(); ++i) distances[i] *= std::sqrt(m_.weights[i]);
    const double noise =
        options_.noise.value_or(std::max(median_noise(system_, distances), kLeastNoise));
    const double width = options_.loss_width.value_or(kWidthByNoise * noise);
    std::vector<double> trust = system_.trust();
    double change = 0.0;
    for (Index i = 0; i < distances.size(); ++i) {
      const double next = trust_in(distances[i] / width);
      change = std::max(change, std::abs(next - trust[i]));
      trust[i] = next;
    }
    system_.set_trust(std::move(trust));
    system_.set_noise({noise, system_.noise().rotation}, result_.x);
    if (change < kTrustSettled) break;
    solve();
  }
}

/// The weight that the loss gives a row, by its distance in widths.
double Search::trust_in(double ratio) const {
  if (options_.loss == Loss::kHuber) return ratio > 1.0 ? 1.0 / ratio : 1.0;
  return 1.0 / (1.0 + ratio * ratio);
}

/// One at a time, the one that is least of its std first.
void Search::prune() {
  for (Index least = least_sure(); least >= 0; least = least_sure()) {
    std::vector<int> free = system_.free();
    const int column = free[least];
    free.erase(free.begin() + least);
    result_.pruned.push_back(column);
    result_.x[column] = problem_.columns.columns[column].nominal;
    system_.set_free(std::move(free));
    solve();
    if (options_.loss == Loss::kSquare) update_noise();
  }
}

/// Position among the free columns of the row's number that lies the fewest std from nominal; -1
/// when all lie beyond `prune_sigma`.
Index Search::least_sure() const {
  const Eigen::MatrixXd covariance = free_covariance(system_, result_.x, seen_.blind);
  const Eigen::VectorXd y = system_.scaled(result_.x);
  Index least = -1;
  double least_ratio = *options_.prune_sigma;
  for (Index i = 0; i < y.size(); ++i) {
    const int column = system_.free()[i];
    const double std = std::sqrt(covariance(i, i));
    const bool seen = !takes_part(column, seen_.unseen);
    if (!is_row(problem_.columns.places[column]) || !seen || !(std > 0.0)) continue;
    if (std::abs(y[i]) / std < least_ratio) {
      least = i;
      least_ratio = std::abs(y[i]) / std;
    }
  }
  return least;
}

/// Scatter is recorded in joint values, and a smaller arm shows less of it: the least sum of
/// squares is that of an arm too small by (degrees of freedom) · (relative std of its size)², many
/// std where hundreds of touches lean on a short known distance. The derivatives of exact touches
/// know nothing of the scatter, so that steps along them end where what is known of the size is
/// met. Data that no arm fits may let the steps grow: least squares stand then.
void Search::undo_size_draw() {
  const Eigen::VectorXd least = result_.x;
  Eigen::VectorXd residuals(system_.rows());
  double last = std::numeric_limits<double>::infinity();
  while (last > kSizeSettled) {
    ArmSystem exact = system_;
    exact.set_joints(exact_joints(system_, result_.x));
    const Eigen::VectorXd y = system_.scaled(result_.x);
    system_.evaluate(y.data(), residuals.data(), nullptr);
    const Eigen::VectorXd step = exact.jacobian(result_.x).householderQr().solve(-residuals);
    if (!(step.norm() < last)) {
      result_.x = least;
      return;
    }
    last = step.norm();
    result_.x = system_.values(y + step);
  }
}

}  // namespace

SearchResult search(ArmProblem& problem, const Observability& seen) {
  return Search(problem, seen).run();
}

}  // namespace bathyal
