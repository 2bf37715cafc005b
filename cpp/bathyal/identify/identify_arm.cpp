// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/identify/identify_arm.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "bathyal/base/check.hpp"
#include "bathyal/identify/examine.hpp"
#include "bathyal/identify/gauge.hpp"
#include "bathyal/identify/start.hpp"

namespace bathyal {
namespace {

constexpr double kHeldDirection = 1e-3;  ///< in units of the columns' scale
constexpr double kLeastNoise = 1e-9;     ///< [m] or [rad]; exact data have no scale of their own
constexpr int kMostRounds = 12;
constexpr double kNoiseSettled = 1e-4;  ///< relative
constexpr double kTrustSettled = 1e-4;
constexpr double kSizeSettled = 1e-6;  ///< in units of the columns' scale: nm and nrad
constexpr double kMedianOfNorm = 1.5381722544550522;  ///< of a normal 3-vector of unit std
/// A column's share in an unseen direction from which it counts as part of it.
constexpr double kUnseenShare = 1e-4;

bool is_length(const Place& place) { return place.part == Part::kD || place.part == Part::kA; }
bool is_angle(const Place& place) {
  return place.part == Part::kTheta || place.part == Part::kAlpha || place.part == Part::kBeta;
}
bool is_row(const Place& place) { return place.part <= Part::kBeta; }

double root_mean(double sum, double count) { return count > 0.0 ? std::sqrt(sum / count) : 0.0; }

/// One identification: what is set up stands in the constructor, what is found in `run`.
class Search {
 public:
  Search(const Arm& arm, const Measurement& measurement, const IdentifyOptions& options);
  ArmFit run();

 private:
  ColumnChoice choice() const;
  void make_start();
  void name_fixed();
  void set_priors();
  void set_length_prior(double std);
  void settle_frames();
  Eigen::VectorXd size_derivative() const;
  void solve();
  void solve_with_noise();
  void solve_with_trust();
  bool update_noise();
  void undo_size_draw();
  double robust_noise(const Eigen::VectorXd& norms) const;
  Eigen::VectorXd norms(const Eigen::VectorXd& x) const;
  void prune();

  void look();
  void ask_for_size();
  RowMatrix exact_joints() const;
  Eigen::MatrixXd jacobian_of(const ArmSystem& system) const;
  Eigen::MatrixXd covariance() const;

  void report_fit(ArmFit& fit) const;
  void report_parameters(ArmFit& fit) const;
  void report_scale(ArmFit& fit) const;
  void report_before(ArmFit& fit) const;
  std::vector<double> group_rms(const Eigen::Matrix3Xd& deviations) const;

  const Arm& arm_;
  const Measurement& m_;
  const IdentifyOptions& options_;
  bool base_free_ = false;
  ArmColumns columns_;
  std::vector<GaugeColumn> gauge_;
  std::vector<int> fixed_;
  std::vector<int> pruned_;
  std::optional<double> length_prior_;
  bool size_told_ = false;  ///< by the data, whatever the priors say
  std::optional<ArmSystem> system_;
  RankReport rank_;         ///< of all columns, by the data, at nominal
  Eigen::MatrixXd unseen_;  ///< (P, k) scaled changes of free columns that the data do not see
  Eigen::MatrixXd blind_;   ///< those of them that no prior holds either
  std::vector<LinearRow> holds_;  ///< keep what is blind at nominal
  Eigen::VectorXd x_;
  std::vector<double> history_;
  bool converged_ = true;
};

Search::Search(const Arm& arm, const Measurement& measurement, const IdentifyOptions& options)
    : arm_(arm),
      m_(measurement),
      options_(options),
      base_free_(options.base == BaseChoice::kFree ||
                 (options.base == BaseChoice::kAuto && measurement.tracked)),
      size_told_(measurement.tells_scale()),
      columns_{arm, {}, {}, {}, {}, {}} {
  if (base_free_ && !m_.in_world()) {
    throw_argument("base", "\"fixed\" or \"auto\" for touches of points that nobody told",
                   "\"free\"");
  }
}

ArmFit Search::run() {
  make_start();
  name_fixed();
  gauge_ = find_gauge(columns_, m_, choice(), m_.in_world() && !base_free_, fixed_);
  set_priors();
  system_.emplace(columns_, m_, options_.criterion, options_.pair_weights, options_.num_threads);
  settle_frames();
  look();
  ask_for_size();

  ArmFit fit(arm_);
  report_before(fit);
  solve_with_noise();
  if (options_.loss != Loss::kSquare) solve_with_trust();
  if (options_.prune_sigma) prune();
  if (!m_.tracked && size_told_) undo_size_draw();

  report_fit(fit);
  report_parameters(fit);
  report_scale(fit);
  examine(m_, *system_, arm_, fit);
  return fit;
}

ColumnChoice Search::choice() const {
  return {options_.parametrization, options_.nearly_parallel, base_free_};
}

void Search::make_start() {
  const bool given =
      options_.tool_start == ToolStart::kArm ||
      (options_.tool_start == ToolStart::kAuto && arm_.tool().translation() != Vec3::Zero());
  Start start = find_start(arm_, m_, given, base_free_);
  columns_ = make_columns(arm_, m_, std::move(start.bases), std::move(start.tools),
                          std::move(start.planes), choice());
  x_ = columns_.nominal();
}

void Search::name_fixed() {
  for (const std::string& name : options_.fixed) {
    const int column = find_column(columns_.columns, name);
    if (column < 0) throw_argument("fixed", "names of parameters, as \"d_1\"", name);
    fixed_.push_back(column);
  }
}

void Search::set_length_prior(double std) {
  for (std::size_t i = 0; i < columns_.columns.size(); ++i) {
    const Column& column = columns_.columns[i];
    if (is_length(columns_.places[i]) && !options_.priors.contains(column.name)) {
      columns_.columns[i].prior_std = std;
    }
  }
}

void Search::set_priors() {
  length_prior_ = options_.length_prior;
  if (!length_prior_ && !size_told_) length_prior_ = options_.size_prior;
  if (length_prior_) set_length_prior(*length_prior_);
  for (std::size_t i = 0; i < columns_.columns.size(); ++i) {
    Column& column = columns_.columns[i];
    if (options_.angle_prior && is_angle(columns_.places[i])) {
      column.prior_std = *options_.angle_prior;
    }
  }
  for (const auto& [name, std] : options_.priors) {
    const int column = find_column(columns_.columns, name);
    if (column < 0) throw_argument("priors", "names of parameters, as \"d_1\"", name);
    columns_.columns[column].prior_std = std;
  }
}

/// Bases, tools of tracked poses and planes for the nominal rows: what a user who identifies
/// nothing would find, and the frames about which turns are then told.
void Search::settle_frames() {
  std::vector<int> frames;
  for (int i = 0; i < static_cast<int>(columns_.places.size()); ++i) {
    const bool tool =
        columns_.places[i].part == Part::kToolShift || columns_.places[i].part == Part::kToolTurn;
    const bool wanted = !is_row(columns_.places[i]) && (m_.tracked || !tool);
    if (wanted && std::find(fixed_.begin(), fixed_.end(), i) == fixed_.end()) frames.push_back(i);
  }
  system_->set_free(frames);
  if (!frames.empty()) {
    system_->set_use_priors(false);
    x_ =
        system_->values(solve_least_squares(*system_, Eigen::VectorXd::Zero(system_->columns())).y);
    ArmState state = state_at(columns_, x_);
    const ArmColumns settled =
        make_columns(arm_, m_, std::move(state.bases), std::move(state.tools),
                     std::move(state.planes), choice());
    for (std::size_t i = 0; i < columns_.columns.size(); ++i) {
      columns_.columns[i].nominal = settled.columns[i].nominal;
    }
    columns_.bases = settled.bases;
    columns_.tools = settled.tools;
    columns_.planes = settled.planes;
    x_ = columns_.nominal();
  }

  std::vector<int> free;
  for (int i = 0; i < static_cast<int>(columns_.columns.size()); ++i) {
    const bool gauge = std::any_of(gauge_.begin(), gauge_.end(),
                                   [i](const GaugeColumn& g) { return g.column == i; });
    if (!gauge && std::find(fixed_.begin(), fixed_.end(), i) == fixed_.end()) free.push_back(i);
  }
  system_->set_free(free);
  Noise noise;
  const double spread =
      std::sqrt(system_->deviations(x_).squaredNorm() / static_cast<double>(3 * m_.rows()));
  noise.position = options_.noise.value_or(std::max(spread, kLeastNoise));
  if (m_.has_rotation()) {
    const double turned =
        std::sqrt(system_->turns(x_).squaredNorm() / static_cast<double>(3 * m_.rows()));
    noise.rotation = options_.rotation_noise.value_or(std::max(turned, kLeastNoise));
  }
  system_->set_noise(noise, x_);
}

/// What the data see is asked at the nominal arm, where the search starts: a direction that is dark
/// there is held, for the little light that it gets elsewhere is not to be trusted (plain DH beside
/// parallel axes runs off along such directions).
void Search::look() {
  holds_.clear();
  system_->set_linear_rows({});
  ArmSystem equal = *system_;
  equal.set_joints(exact_joints());
  equal.set_criterion(Criterion::kCentroid, false);
  std::vector<int> all(columns_.columns.size());
  std::iota(all.begin(), all.end(), 0);
  equal.set_free(all);
  equal.set_equal_noise(1e-3);
  equal.set_use_priors(false);
  const Eigen::MatrixXd full = jacobian_of(equal);
  rank_ = reveal_rank(full);

  const std::vector<int>& free = system_->free();
  Eigen::MatrixXd seen(full.rows(), system_->columns());
  for (Index i = 0; i < seen.cols(); ++i) seen.col(i) = full.col(free[i]);
  const Eigen::MatrixXd unseen = reveal_rank(seen).unseen();

  const Eigen::MatrixXd rows = jacobian_of(*system_);
  const Eigen::MatrixXd told =
      rows.bottomRows(rows.rows() - system_->data_rows()).rowwise().normalized() * unseen;
  const Eigen::MatrixXd blind = unseen * reveal_rank(told).unseen();

  const auto count = static_cast<Index>(columns_.columns.size());
  unseen_.setZero(count, unseen.cols());
  blind_.setZero(count, blind.cols());
  for (std::size_t i = 0; i < free.size(); ++i) {
    unseen_.row(free[i]) = unseen.row(i);
    blind_.row(free[i]) = blind.row(i);
  }
  for (Index k = 0; k < blind_.cols(); ++k) {
    LinearRow row{blind_.col(k), kHeldDirection};
    for (Index i = 0; i < count; ++i) row.coefficients[i] /= columns_.columns[i].scale;
    holds_.push_back(std::move(row));
  }
  system_->set_linear_rows(holds_);
}

/// The travel of a sliding joint is known, so that touches tell the size of an arm that has one: no
/// change of the size is among those that the data do not see. The prior that stood in for it goes.
void Search::ask_for_size() {
  const bool slides =
      std::any_of(arm_.joints().begin(), arm_.joints().end(),
                  [](const Joint& joint) { return joint.type == JointType::kPrismatic; });
  if (size_told_ || !slides) return;
  Eigen::VectorXd size = size_derivative();
  for (Index i = 0; i < size.size(); ++i) size[i] *= columns_.columns[i].scale;
  if ((unseen_.transpose() * size).norm() > kUnseenShare * size.norm()) return;
  size_told_ = true;
  if (options_.length_prior) return;
  length_prior_.reset();
  set_length_prior(Column::kNoPrior);
  look();
}

/// Derivative of the arm's size by the columns: Σ L (x - L) / Σ L² over the rows' lengths L. Where
/// they are all zero there is nothing but the tool that could shrink.
Eigen::VectorXd Search::size_derivative() const {
  Eigen::VectorXd derivative = Eigen::VectorXd::Zero(x_.size());
  for (Index i = 0; i < x_.size(); ++i) {
    if (is_length(columns_.places[i])) derivative[i] = columns_.columns[i].nominal;
  }
  const double square = derivative.squaredNorm();
  return square > 0.0 ? Eigen::VectorXd(derivative / square) : derivative;
}

Eigen::MatrixXd Search::jacobian_of(const ArmSystem& system) const {
  Eigen::VectorXd residuals(system.rows());
  Eigen::MatrixXd jacobian(system.rows(), system.columns());
  const Eigen::VectorXd y = system.scaled(x_);
  system.evaluate(y.data(), residuals.data(), jacobian.data());
  return jacobian;
}

void Search::solve() {
  const LeastSquaresOptions options{.solver = options_.solver,
                                    .max_iterations = options_.max_iterations};
  const LeastSquaresResult result = solve_least_squares(*system_, system_->scaled(x_), options);
  x_ = system_->values(result.y);
  converged_ = result.converged;
  const double unit = system_->noise().position * system_->noise().position;
  for (std::size_t i = history_.empty() ? 0 : 1; i < result.history.size(); ++i) {
    history_.push_back(result.history[i] * unit);
  }
}

/// Where a loose prior alone holds the size, the noise that it is weighed against is found first
/// with a firm one: else both shrink together.
void Search::solve_with_noise() {
  const bool loose = !size_told_ && *length_prior_ > options_.size_prior;
  if (loose) {
    const double asked = *length_prior_;
    set_length_prior(options_.size_prior);
    solve();
    for (int round = 0; round < kMostRounds && update_noise(); ++round) solve();
    set_length_prior(asked);
    solve();
    return;
  }
  solve();
  for (int round = 0; round < kMostRounds && update_noise(); ++round) solve();
}

/// Each kind of row by its own residuals: σ² = Σ r² / (rows - what the columns take of them).
/// False when nothing changed that the solution depends on.
bool Search::update_noise() {
  if (options_.noise && (options_.rotation_noise || !m_.has_rotation())) return false;
  // Every direction is held by something, so that the triangle can be inverted.
  const Eigen::MatrixXd jacobian = jacobian_of(*system_);
  const Eigen::HouseholderQR<Eigen::MatrixXd> qr(jacobian);
  const auto triangle = qr.matrixQR().topRows(jacobian.cols()).triangularView<Eigen::Upper>();
  const auto estimate = [&](const Eigen::Matrix3Xd& residuals, Index first, Index count,
                            double rows, double old) {
    double sum = 0.0;
    for (Index i = 0; i < m_.rows(); ++i) {
      sum += m_.weights[i] * system_->trust()[i] * residuals.col(i).squaredNorm();
    }
    const Eigen::MatrixXd taken =
        triangle.transpose().solve(jacobian.middleRows(first, count).transpose());
    const double freedom = rows - taken.squaredNorm();
    return freedom > 0.5 ? std::max(std::sqrt(sum / freedom), kLeastNoise) : old;
  };
  Noise noise = system_->noise();
  if (!options_.noise) {
    noise.position = estimate(system_->deviations(x_), 0, system_->position_rows(),
                              free_position_rows(m_), noise.position);
  }
  if (m_.has_rotation() && !options_.rotation_noise) {
    noise.rotation =
        estimate(system_->turns(x_), system_->position_rows(), system_->rotation_rows(),
                 static_cast<double>(3 * m_.rows()), noise.rotation);
  }
  const Noise old = system_->noise();
  system_->set_noise(noise, x_);
  const bool matters =
      system_->rows() > system_->position_rows() + static_cast<Index>(holds_.size());
  return matters && (std::abs(noise.position / old.position - 1.0) > kNoiseSettled ||
                     std::abs(noise.rotation / old.rotation - 1.0) > kNoiseSettled);
}

Eigen::VectorXd Search::norms(const Eigen::VectorXd& x) const {
  Eigen::VectorXd out = system_->deviations(x).colwise().norm();
  for (Index i = 0; i < out.size(); ++i) out[i] *= std::sqrt(m_.weights[i]);
  return out;
}

double Search::robust_noise(const Eigen::VectorXd& norms) const {
  std::vector<double> sorted(norms.begin(), norms.end());
  const auto middle = sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2);
  std::nth_element(sorted.begin(), middle, sorted.end());
  const double taken = static_cast<double>(system_->columns());
  const double rows = free_position_rows(m_);
  const double share =
      rows > taken ? std::sqrt(static_cast<double>(3 * m_.rows()) / (rows - taken)) : 1.0;
  return std::max(*middle / kMedianOfNorm * share, kLeastNoise);
}

/// Iteratively reweighted least squares.
void Search::solve_with_trust() {
  for (int round = 0; round < 5 * kMostRounds; ++round) {
    const Eigen::VectorXd distance = norms(x_);
    const double noise = options_.noise.value_or(robust_noise(distance));
    const double width = options_.loss_width.value_or(3.0 * noise);
    std::vector<double> trust = system_->trust();
    double change = 0.0;
    for (Index i = 0; i < distance.size(); ++i) {
      const double ratio = distance[i] / width;
      const double next = options_.loss == Loss::kHuber ? (ratio > 1.0 ? 1.0 / ratio : 1.0)
                                                        : 1.0 / (1.0 + ratio * ratio);
      change = std::max(change, std::abs(next - trust[i]));
      trust[i] = next;
    }
    system_->set_trust(std::move(trust));
    system_->set_noise({noise, system_->noise().rotation}, x_);
    if (change < kTrustSettled) break;
    solve();
  }
}

/// One at a time, the one that is least of its std first.
void Search::prune() {
  while (true) {
    const Eigen::MatrixXd known = covariance();
    const Eigen::VectorXd y = system_->scaled(x_);
    Index least = -1;
    double least_ratio = *options_.prune_sigma;
    for (Index i = 0; i < y.size(); ++i) {
      const int column = system_->free()[i];
      const double std = std::sqrt(known(i, i));
      if (!is_row(columns_.places[column]) || unseen_.row(column).norm() > kUnseenShare) continue;
      if (std > 0.0 && std::abs(y[i]) / std < least_ratio) {
        least = i;
        least_ratio = std::abs(y[i]) / std;
      }
    }
    if (least < 0) return;
    std::vector<int> free = system_->free();
    const int column = free[least];
    free.erase(free.begin() + least);
    pruned_.push_back(column);
    x_[column] = columns_.columns[column].nominal;
    system_->set_free(std::move(free));
    solve();
    if (options_.loss == Loss::kSquare) update_noise();
  }
}

/// The joint values nearest to those recorded at which every tip is where it should be.
RowMatrix Search::exact_joints() const {
  RowMatrix q = m_.q;
  if (m_.tracked) return q;
  constexpr int kMostSteps = 10;
  constexpr double kFarTurn = 0.5;  // a pose that must move so much is left where it is
  const Eigen::Matrix3Xd centers = system_->centroids(x_);
  const TipWalk walk(columns_, x_, {});
  RowFrames frames;
  for (Index i = 0; i < q.rows(); ++i) {
    Eigen::VectorXd joints = q.row(i).transpose();
    for (int step = 0; step < kMostSteps; ++step) {
      Vec3 tip;
      const Eigen::Matrix3Xd jacobian =
          walk.joint_jacobian(joints.data(), m_.tool[i], m_.station[i], frames, tip);
      Vec3 miss;
      if (m_.point[i] >= 0) {
        miss = centers.col(m_.point[i]) - tip;
      } else {
        const PlaneGuess& plane = walk.state().planes[m_.plane[i]];
        miss = (plane.offset - plane.normal.dot(tip - plane.center)) * plane.normal;
      }
      if (miss.norm() < 1e-14) break;
      Eigen::Matrix3d square = jacobian * jacobian.transpose();
      square.diagonal().array() += 1e-12 * square.trace();
      joints += jacobian.transpose() * square.ldlt().solve(miss);
    }
    if ((joints - m_.q.row(i).transpose()).cwiseAbs().maxCoeff() < kFarTurn) {
      q.row(i) = joints.transpose();
    }
  }
  return q;
}

/// Scatter is recorded in joint values, and a smaller arm shows less of it: the least sum of
/// squares is that of an arm too small by (degrees of freedom) · (relative std of its size)², many
/// std where hundreds of touches lean on a short known distance. The derivatives of exact touches
/// know nothing of the scatter, so that steps along them end where what is known of the size is
/// met. Data that no arm fits may let the steps grow: least squares stand then.
void Search::undo_size_draw() {
  const Eigen::VectorXd least = x_;
  Eigen::VectorXd residuals(system_->rows());
  double last = std::numeric_limits<double>::infinity();
  while (last > kSizeSettled) {
    ArmSystem exact = *system_;
    exact.set_joints(exact_joints());
    const Eigen::VectorXd y = system_->scaled(x_);
    system_->evaluate(y.data(), residuals.data(), nullptr);
    const Eigen::VectorXd step = jacobian_of(exact).householderQr().solve(-residuals);
    if (!(step.norm() < last)) {
      x_ = least;
      return;
    }
    last = step.norm();
    x_ = system_->values(y + step);
  }
}

/// (free, free), scaled, for exact touches; what is blind counts nothing.
Eigen::MatrixXd Search::covariance() const {
  ArmSystem exact = *system_;
  exact.set_joints(exact_joints());
  // Pair residuals are correlated; those about a centroid lose one touch to it, and no more.
  exact.set_criterion(Criterion::kCentroid, false);
  exact.set_linear_rows({});
  const Eigen::MatrixXd jacobian = jacobian_of(exact);

  Eigen::MatrixXd left = Eigen::MatrixXd::Identity(exact.columns(), exact.columns());
  if (blind_.cols() > 0) {
    Eigen::MatrixXd blind(exact.columns(), blind_.cols());
    for (Index i = 0; i < blind.rows(); ++i) blind.row(i) = blind_.row(exact.free()[i]);
    const Eigen::HouseholderQR<Eigen::MatrixXd> qr(blind);
    left = Eigen::MatrixXd(qr.householderQ()).rightCols(exact.columns() - blind.cols());
  }
  return left * inverse_square(jacobian * left) * left.transpose();
}

void Search::report_before(ArmFit& fit) const {
  const Eigen::Matrix3Xd deviations = system_->deviations(x_);
  fit.rms_before = root_mean(deviations.squaredNorm(), static_cast<double>(m_.rows()));
  fit.point_rms_before = group_rms(deviations);
  fit.rotation_rms_before =
      root_mean(system_->turns(x_).squaredNorm(), static_cast<double>(m_.rows()));
  fit.pairs_before = pair_sum(m_, deviations);
}

std::vector<double> Search::group_rms(const Eigen::Matrix3Xd& deviations) const {
  const std::vector<int>& group = m_.tracked ? m_.station : m_.point;
  const auto groups = static_cast<std::size_t>(m_.tracked ? m_.stations : m_.points());
  std::vector<double> sum(groups, 0.0);
  std::vector<double> count(groups, 0.0);
  for (Index i = 0; i < m_.rows(); ++i) {
    if (group[i] < 0) continue;
    sum[group[i]] += deviations.col(i).squaredNorm();
    count[group[i]] += 1.0;
  }
  for (std::size_t g = 0; g < groups; ++g) sum[g] = root_mean(sum[g], count[g]);
  return sum;
}

void Search::report_fit(ArmFit& fit) const {
  const ArmState state = state_at(columns_, x_);
  fit.arm = state.arm;
  fit.arm.set_base(state.bases[0]);
  fit.arm.set_tool(state.tools[0]);
  fit.bases = state.bases;
  fit.tools = state.tools;
  fit.columns = columns_;
  fit.values = x_;

  fit.residuals = system_->deviations(x_);
  fit.rms_after = root_mean(fit.residuals.squaredNorm(), static_cast<double>(m_.rows()));
  fit.point_rms_after = group_rms(fit.residuals);
  fit.rotation_rms_after =
      root_mean(system_->turns(x_).squaredNorm(), static_cast<double>(m_.rows()));
  fit.pairs_after = pair_sum(m_, fit.residuals);
  fit.history = history_;
  fit.iterations = static_cast<int>(history_.size()) - 1;
  fit.converged = converged_;

  fit.rank = rank_.rank;
  fit.singular_values = rank_.singular_values;
  for (const Eigen::VectorXd& direction : readable_directions(rank_.unseen())) {
    fit.unseen.push_back(in_words(direction, columns_.columns));
  }
  fit.noise = system_->noise().position;
  fit.rotation_noise = m_.has_rotation() ? system_->noise().rotation : 0.0;

  const auto taken = static_cast<double>(system_->columns() - unseen_.cols());
  fit.degrees_of_freedom =
      free_position_rows(m_) + static_cast<double>(system_->known_rows()) - taken;

  fit.point_labels = m_.labels;
  fit.points = system_->centroids(x_);
  for (const KnownDistance& known : m_.distances) {
    fit.distances.push_back({m_.labels[known.first], m_.labels[known.second], known.distance,
                             (fit.points.col(known.first) - fit.points.col(known.second)).norm()});
  }
}

void Search::report_parameters(ArmFit& fit) const {
  const auto count = static_cast<Index>(columns_.columns.size());
  const std::vector<int>& free = system_->free();
  const Eigen::MatrixXd known = covariance();
  fit.covariance.setZero(count, count);
  fit.blind = blind_;
  for (std::size_t i = 0; i < free.size(); ++i) {
    for (std::size_t j = 0; j < free.size(); ++j) {
      fit.covariance(free[i], free[j]) =
          known(i, j) * columns_.columns[free[i]].scale * columns_.columns[free[j]].scale;
    }
  }
  for (Index i = 0; i < count; ++i) fit.blind.row(i) *= columns_.columns[i].scale;

  for (Index c = 0; c < count; ++c) {
    const Column& column = columns_.columns[c];
    FitParameter p{column.name,
                   column.words,
                   column.unit,
                   column.group,
                   column.nominal,
                   x_[c],
                   std::sqrt(fit.covariance(c, c)),
                   Status::kIdentified,
                   {}};
    const bool blind = fit.blind.row(c).norm() > kUnseenShare * column.scale;
    const bool told = column.prior_std != Column::kNoPrior && p.std > 0.7 * column.prior_std;
    if (blind) {
      p.status = Status::kNotIdentifiable;
      p.std = std::numeric_limits<double>::infinity();
    } else if (unseen_.row(c).norm() > kUnseenShare || told) {
      p.status = Status::kPrior;
    }
    p.trades = trades_of(static_cast<int>(c), unseen_, columns_.columns);
    fit.parameters.push_back(std::move(p));
  }
  for (const GaugeColumn& gauge : gauge_) {
    fit.parameters[gauge.column].status = Status::kGauge;
    fit.parameters[gauge.column].trades = gauge.trades;
  }
  for (const int column : fixed_) fit.parameters[column].status = Status::kFixed;
  for (const int column : pruned_) fit.parameters[column].status = Status::kPruned;
}

void Search::report_scale(ArmFit& fit) const {
  const Eigen::VectorXd derivative = size_derivative();
  fit.scale = 1.0 + derivative.dot(x_ - columns_.nominal());
  fit.scale_std = std::sqrt(std::max(0.0, derivative.dot(fit.covariance * derivative)));
  double sum = 0.0;
  double found = 0.0;
  for (const FoundDistance& distance : fit.distances) {
    sum += distance.told * distance.found;
    found += distance.found * distance.found;
  }
  const double to_true_size = found > 0.0 ? sum / found : size_told_ ? 1.0 : 1.0 / fit.scale;
  fit.rms_after_scaled = fit.rms_after * to_true_size;

  if (m_.tracked) {
    fit.scale_source = "measured positions";
  } else if (!m_.known_points.empty()) {
    fit.scale_source = "known points";
  } else if (!m_.distances.empty()) {
    fit.scale_source = m_.distances.size() == 1 ? "known distance" : "known distances";
  } else if (size_told_) {
    fit.scale_source = "travel of sliding joints";
  } else {
    fit.scale_source = "prior on lengths (" + to_text(*length_prior_ * 1e3) + " mm)";
  }
}

}  // namespace

void IdentifyOptions::check() const {
  check_range("nearly_parallel", nearly_parallel, 0.0, 0.5);
  LeastSquaresOptions{.max_iterations = max_iterations}.check();
  if (length_prior) check_positive("length_prior", *length_prior);
  if (angle_prior) check_positive("angle_prior", *angle_prior);
  for (const auto& [name, std] : priors) check_positive("priors " + name, std);
  check_positive("size_prior", size_prior);
  if (noise) check_positive("noise", *noise);
  if (rotation_noise) check_positive("rotation_noise", *rotation_noise);
  if (loss_width) check_positive("loss_width", *loss_width);
  if (prune_sigma) check_positive("prune_sigma", *prune_sigma);
}

ArmFit identify_arm(const Arm& arm, const Touches& touches, const IdentifyOptions& options) {
  options.check();
  const Measurement measurement = to_measurement(arm, touches);
  return Search(arm, measurement, options).run();
}

ArmFit identify_arm(const Arm& arm, const Tracked& tracked, const IdentifyOptions& options) {
  options.check();
  const Measurement measurement = to_measurement(arm, tracked);
  return Search(arm, measurement, options).run();
}

}  // namespace bathyal
