// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/diagnosis/arm_subject.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

#include "bathyal/diagnosis/blocks.hpp"
#include "bathyal/diagnosis/logged_step.hpp"
#include "bathyal/diagnosis/words.hpp"
#include "bathyal/identify/arm_report.hpp"
#include "bathyal/identify/effect_columns.hpp"
#include "bathyal/identify/least_squares.hpp"
#include "bathyal/identify/tip_walk.hpp"

namespace bathyal {
namespace {

constexpr double kTwins = 1e-3;         ///< [rad] or [m]: poses nearer than this are one pose
constexpr std::size_t kScanFrom = 16;   ///< forms of one cause of one effect that are a scan
constexpr int kNoiseRounds = 3;
constexpr double kNoiseSettled = 1e-3;  ///< relative

std::vector<int> numbered(const Eigen::VectorXd& values) {
  std::map<double, int> known;
  for (const double value : values) known.emplace(value, 0);
  int next = 0;
  for (auto& [value, index] : known) index = next++;
  std::vector<int> out;
  for (const double value : values) out.push_back(known[value]);
  return out;
}

}  // namespace

ArmSubject::ArmSubject(const Arm& arm, const Measurement& measurement, const Covariates& covariates,
                       const IdentifyOptions& options, const Effects& effects)
    : nominal_(arm),
      m_(measurement),
      problem_(arm, measurement, options),
      seen_(observe(*problem_.system, problem_.start)),
      fit_(arm) {
  if (problem_.drop_size_prior(seen_.unseen)) seen_ = observe(*problem_.system, problem_.start);
  start_ = search(problem_, seen_);
  fit_ = report(problem_, seen_, start_);
  geometry_ = problem_.columns.columns.size();
  base_free_ = problem_.system->free();
  x_ = start_.x;
  gather_data(covariates);
  gather_units();
  gather_forms(effects);
  gather_noise_forms();
  stand_at(x_);
}

void ArmSubject::gather_data(const Covariates& covariates) {
  data_ = make_effect_data(fit_.arm, m_.q, covariates, m_.has_rotation());
}

void ArmSubject::gather_units() {
  units_.order = data_.order;
  units_.twin = find_twins(m_.q, kTwins);
  units_.session = m_.station;
  if (data_.has("session")) units_.session = numbered(data_.covariate("session").col(0));
  units_.point = m_.point;
}

void ArmSubject::gather_noise_forms() {
  if (m_.tracked) {
    noise_forms_.push_back({"range_noise", "noise that grows with the range", "rate", "1", 1.0,
                            m_.position.colwise().squaredNorm().transpose()});
  }
  const double step = logged_step(m_.q, nominal_);
  if (!(step > 0.0)) return;
  Eigen::VectorXd variance(m_.rows());
  const TipWalk walk(problem_.columns, x_, {});
  WalkFrames frames;
  Vec3 tip;
  for (Index i = 0; i < m_.rows(); ++i) {
    variance[i] = walk.joint_jacobian(m_.q.row(i).data(), i, m_.tool[i], m_.station[i], frames, tip)
                      .squaredNorm() /
                  36.0;  // a twelfth of the step's square, shared by three axes
  }
  noise_forms_.push_back(
      {"quantisation", "joint values logged in steps", "step", "rad", 1.0, std::move(variance)});
  noise_forms_.back().known = step;
}

void ArmSubject::gather_forms(const Effects& effects) {
  for (const auto& effect : effects) {
    std::vector<EffectVariant> variants = effect->variants(data_);
    std::map<std::pair<int, std::string>, std::vector<int>> by_cause;
    for (EffectVariant& variant : variants) {
      by_cause[{variant.joint, variant.cause}].push_back(static_cast<int>(forms_.size()));
      forms_.push_back({variant.effect, variant.joint, variant.cause, words_of(variant, nominal_),
                        static_cast<double>(variants.size()), false});
      sources_.push_back({effect, std::move(variant), -1});
    }
    for (auto& [cause, family] : by_cause) {
      if (family.size() <= kScanFrom) continue;
      for (std::size_t i = 0; i < family.size(); ++i) {
        neighbours_[family[i]] = {i > 0 ? family[i - 1] : -1,
                                  i + 1 < family.size() ? family[i + 1] : -1};
      }
      scans_.push_back(std::move(family));
    }
  }
  probes_ = make_probes(data_, tips_from_base());
  std::map<int, std::vector<int>> families;
  for (int p = 0; p < static_cast<int>(probes_.size()); ++p) {
    const Probe& probe = probes_[p];
    if (probe.family >= 0) families[probe.family].push_back(static_cast<int>(forms_.size()));
    forms_.push_back({probe.against, -1, "probe " + probe.words, probe.words, probe.trials, true});
    sources_.push_back({nullptr, {}, p});
  }
  for (auto& [number, family] : families) scans_.push_back(std::move(family));
}

std::vector<int> ArmSubject::finer(int form) {
  const auto found = neighbours_.find(form);
  if (found == neighbours_.end()) return {};
  const auto [lower, upper] = found->second;
  std::vector<int> chain;
  const auto add_between = [&](int from, int to) {
    if (from < 0 || to < 0) return;
    const Source here = sources_[form];
    for (EffectVariant& variant :
         here.effect->between(sources_[from].variant, sources_[to].variant, data_)) {
      Form about = forms_[form];
      about.words = words_of(variant, nominal_);
      chain.push_back(static_cast<int>(forms_.size()));
      forms_.push_back(std::move(about));
      sources_.push_back({here.effect, std::move(variant), -1});
    }
  };
  if (lower >= 0) chain.push_back(lower);
  add_between(lower, form);
  chain.push_back(form);
  add_between(form, upper);
  if (upper >= 0) chain.push_back(upper);
  for (std::size_t i = 0; i < chain.size(); ++i) {
    if (chain[i] == lower || chain[i] == upper) continue;
    neighbours_[chain[i]] = {i > 0 ? chain[i - 1] : -1, i + 1 < chain.size() ? chain[i + 1] : -1};
  }
  std::erase_if(chain, [&](int f) { return f == lower || f == upper || f == form; });
  return chain;
}

std::vector<std::vector<Action>> ArmSubject::actions_of(int form) const {
  const Source& source = sources_[form];
  if (source.probe < 0) return bathyal::actions_of(*source.effect, source.variant, data_);
  std::vector<std::vector<Action>> out;
  for (Action& action : probes_[source.probe].actions()) out.push_back({std::move(action)});
  return out;
}

std::vector<Eigen::MatrixXd> ArmSubject::columns(std::span<const int> forms) const {
  ArmColumns columns = problem_.columns;
  std::vector<Index> first;
  std::vector<int> wanted;
  for (const int form : forms) {
    first.push_back(static_cast<Index>(wanted.size()));
    EffectVariant variant = sources_[form].variant;
    std::vector<std::vector<Action>> actions = actions_of(form);
    if (sources_[form].probe >= 0) {
      variant.effect = forms_[form].words;
      for (std::size_t c = 0; c < actions.size(); ++c) {
        variant.parameters.push_back({std::to_string(c), "", 1.0});
      }
    }
    const int begin = add_effect(columns, variant, std::move(actions));
    for (int c = begin; c < static_cast<int>(columns.columns.size()); ++c) wanted.push_back(c);
  }
  first.push_back(static_cast<Index>(wanted.size()));
  Eigen::VectorXd x = columns.nominal();
  x.head(x_.size()) = x_;
  ArmSystem system(columns, m_, Criterion::kCentroid, false, problem_.system->num_threads());
  system.set_trust(problem_.system->trust());
  system.set_noise(problem_.system->noise(), x);
  system.set_free(wanted);
  Eigen::MatrixXd all(linearization_.misfit.size(), static_cast<Index>(wanted.size()));
  all.setZero();
  all.topRows(system.data_rows()) = system.jacobian(x).topRows(system.data_rows());
  std::vector<Eigen::MatrixXd> out;
  for (std::size_t i = 0; i < forms.size(); ++i) {
    out.emplace_back(all.middleCols(first[i], first[i + 1] - first[i]));
  }
  return out;
}

void ArmSubject::settle(const std::vector<int>& forms) {
  // Values of forms that stay are where their search starts.
  std::map<int, Eigen::VectorXd> known;
  auto at = static_cast<Index>(geometry_);
  for (const int form : standing_) {
    const auto wide = static_cast<Index>(sources_[form].variant.parameters.size());
    known[form] = x_.segment(at, wide);
    at += wide;
  }
  truncate_columns(problem_.columns, geometry_);
  Eigen::VectorXd x = x_.head(static_cast<Index>(geometry_));
  std::vector<int> free = base_free_;
  for (const int form : forms) {
    const int begin = add_effect(problem_.columns, sources_[form].variant, actions_of(form));
    const auto end = static_cast<int>(problem_.columns.columns.size());
    for (int c = begin; c < end; ++c) free.push_back(c);
    x.conservativeResize(end);
    x.tail(end - begin).setZero();
    if (known.contains(form)) x.tail(end - begin) = known[form];
  }
  standing_ = forms;
  ArmSystem& system = *problem_.system;
  std::vector<LinearRow> held = system.linear_rows();
  for (LinearRow& row : held) {
    row.coefficients.conservativeResize(static_cast<Index>(geometry_));
    row.coefficients.conservativeResizeLike(Eigen::VectorXd::Zero(x.size()));
  }
  system.set_linear_rows(std::move(held));
  system.set_free(std::move(free));
  for (int round = 0; round < kNoiseRounds; ++round) {
    const LeastSquaresResult found = solve_least_squares(system, system.scaled(x));
    x = system.values(found.y);
    stand_at(x);
    if (!update_noise()) break;
  }
  stand_at(x);
}

void ArmSubject::stand_at(const Eigen::VectorXd& x) {
  x_ = x;
  ArmSystem& system = *problem_.system;
  const Index rows = system.rows();
  const auto wide = static_cast<Index>(base_free_.size());
  Eigen::VectorXd residuals(rows);
  Eigen::MatrixXd jacobian(rows, system.columns());
  const Eigen::VectorXd y = system.scaled(x);
  system.evaluate(y.data(), residuals.data(), jacobian.data());
  linearization_.misfit = jacobian.rightCols(system.columns() - wide) * y.tail(y.size() - wide);
  linearization_.misfit -= residuals;
  const Index points = m_.tracked ? 0 : m_.points();
  linearization_.base = Eigen::MatrixXd::Zero(rows, wide + 3 * points);
  linearization_.base.leftCols(wide) = jacobian.leftCols(wide);
  linearization_.unit.assign(static_cast<std::size_t>(rows), -1);
  linearization_.lost = 0.0;
  linearization_.noise_rows = system.position_rows();
  for (Index i = 0; i < m_.rows(); ++i) {
    const bool plane = !m_.tracked && m_.plane[i] >= 0;
    const double kinds = m_.has_rotation() ? 2.0 : 1.0;
    if (system.trust()[i] < kLeftOut * 2.0) {
      linearization_.lost += plane ? 1.0 : 3.0 * kinds;
    }
    if (plane) linearization_.lost += 2.0;  // rows that hold nothing
    for (Index axis = 0; axis < 3; ++axis) {
      linearization_.unit[3 * i + axis] = static_cast<int>(i);
      if (m_.has_rotation()) {
        linearization_.unit[3 * m_.rows() + 3 * i + axis] = static_cast<int>(i);
      }
      // Where a point is, is free: what the centroid takes of the rows, as columns.
      if (!m_.tracked && m_.point[i] >= 0) {
        linearization_.base(3 * i + axis, wide + 3 * m_.point[i] + axis) =
            std::sqrt(system.weight(i)) / system.noise().position;
      }
    }
  }
}

bool ArmSubject::update_noise() {
  ArmSystem& system = *problem_.system;
  const double taken = static_cast<double>(system.columns());
  const Index positions = system.position_rows();
  Eigen::VectorXd residuals(system.rows());
  const Eigen::VectorXd y = system.scaled(x_);
  system.evaluate(y.data(), residuals.data(), nullptr);
  const double all = static_cast<double>(positions + system.rotation_rows());
  double free = free_position_rows(m_);
  double turning = static_cast<double>(system.rotation_rows());
  for (Index i = 0; i < m_.rows(); ++i) {
    if (system.trust()[i] >= kLeftOut * 2.0) continue;
    free -= !m_.tracked && m_.plane[i] >= 0 ? 1.0 : 3.0;
    if (m_.has_rotation()) turning -= 3.0;
  }
  Noise noise = system.noise();
  const Noise old = noise;
  // Columns take of each kind of row its share.
  const auto estimate = [&](double squares, double rows, double share, double now) {
    const double freedom = rows - taken * share;
    return freedom > 0.5 ? std::max(now * std::sqrt(squares / freedom), kLeastNoise) : now;
  };
  if (!problem_.options.noise) {
    noise.position = estimate(residuals.head(positions).squaredNorm(), free,
                              static_cast<double>(positions) / all, old.position);
  }
  if (m_.has_rotation() && !problem_.options.rotation_noise) {
    noise.rotation = estimate(residuals.segment(positions, system.rotation_rows()).squaredNorm(),
                              turning, 1.0 - static_cast<double>(positions) / all, old.rotation);
  }
  system.set_noise(noise, x_);
  return std::abs(noise.position / old.position - 1.0) > kNoiseSettled ||
         std::abs(noise.rotation / old.rotation - 1.0) > kNoiseSettled;
}

void ArmSubject::set_trust(const Eigen::VectorXd& trust) {
  std::vector<double> factors(static_cast<std::size_t>(trust.size()));
  for (Index i = 0; i < trust.size(); ++i) {
    factors[i] = trust[i] > 0.0 ? std::max(trust[i], kLeftOut) : kLeftOut;
  }
  problem_.system->set_trust(std::move(factors));
}

Eigen::Matrix3Xd ArmSubject::tips_from_base() const {
  Eigen::Matrix3Xd tips(3, m_.rows());
  const Eigen::Matrix3Xd misses = deviations();
  const TipWalk walk(problem_.columns, x_, {});
  WalkFrames frames;
  for (Index i = 0; i < m_.rows(); ++i) {
    Vec3 tip =
        walk.tip(m_.q.row(i).data(), i, m_.tool[i], m_.station[i], frames, nullptr, nullptr, 0)
            .translation();
    if (!m_.tracked) tip -= misses.col(i);
    tips.col(i) = fit_.bases[m_.station[i]].inverse() * tip;
  }
  return tips;
}

std::vector<FoundEffect> ArmSubject::found() const {
  std::vector<FoundEffect> out;
  auto at = static_cast<Index>(geometry_);
  for (const int form : standing_) {
    const Source& source = sources_[form];
    const auto wide = static_cast<Index>(source.variant.parameters.size());
    out.push_back({source.effect, source.variant, x_.segment(at, wide)});
    at += wide;
  }
  return out;
}

double ArmSubject::freedom() const {
  const Eigen::MatrixXd jacobian = problem_.system->jacobian(x_);
  const auto points = static_cast<double>(m_.tracked ? 0 : 3 * m_.points());
  return static_cast<double>(jacobian.rows() - jacobian.cols()) - linearization_.lost - points;
}

Eigen::MatrixXd ArmSubject::covariance() const {
  const ArmSystem& system = *problem_.system;
  const Eigen::MatrixXd triangle = triangle_of(system.jacobian(x_), system.num_threads());
  const RankReport rank = reveal_rank(triangle);
  const auto directions = rank.directions.leftCols(rank.rank);
  const Eigen::MatrixXd root =
      directions * rank.singular_values.head(rank.rank).cwiseInverse().asDiagonal();
  const auto wide = static_cast<Index>(base_free_.size());
  Eigen::MatrixXd own = root.bottomRows(root.rows() - wide);
  for (Index i = 0; i < own.rows(); ++i) {
    own.row(i) *= problem_.columns.columns[system.free()[wide + i]].scale;
  }
  Eigen::VectorXd residuals(system.rows());
  system.evaluate(system.scaled(x_).data(), residuals.data(), nullptr);
  return residuals.squaredNorm() / freedom() * (own * own.transpose());
}

Arm ArmSubject::arm() const {
  const ArmState state = state_at(problem_.columns, x_);
  Arm arm = state.arm;
  arm.set_base(state.bases[0]);
  arm.set_tool(state.tools[0]);
  return arm;
}

Eigen::Matrix3Xd ArmSubject::deviations() const { return problem_.system->deviations(x_); }

}  // namespace bathyal
