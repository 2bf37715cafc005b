// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/diagnosis/arm/internal/lack_of_fit.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>

#include "bathyal/diagnosis/internal/seconds.hpp"

namespace bathyal::diagnosis {
namespace {

using Kind = Dependence::Kind;
using Functions = Eigen::MatrixXd;  ///< (N, k) one function per column

/// Frames whose axes a shift is resolved along.
enum class Axes { kBase, kFlange };

std::string number(int coordinate) { return std::to_string(coordinate + 1); }

/// Scaled to -1 … 1 over the data; 0 for a constant.
Eigen::VectorXd spread_out(const Eigen::VectorXd& values) {
  const double low = values.minCoeff(), high = values.maxCoeff();
  if (!(high > low)) return Eigen::VectorXd::Zero(values.size());
  return (2.0 * (values.array() - low) / (high - low) - 1.0).matrix();
}

/// Legendre's P1, P2, P3.
Functions curve(const Eigen::VectorXd& u) {
  const auto a = u.array();
  Functions out(u.size(), 3);
  out << u, (1.5 * a.square() - 0.5).matrix(), (2.5 * a.cube() - 1.5 * a).matrix();
  return out;
}

/// cos(π m t), t from 0 to 1, m = 1 … count: slow drift.
Functions waves(const Eigen::VectorXd& u, int count) {
  Functions out(u.size(), count);
  for (int m = 1; m <= count; ++m) {
    out.col(m - 1) = (std::numbers::pi * m * 0.5 * (u.array() + 1.0)).cos();
  }
  return out;
}

Functions products(const Functions& a, const Functions& b) {
  Functions out(a.rows(), a.cols() * b.cols());
  for (Eigen::Index i = 0; i < a.cols(); ++i) {
    for (Eigen::Index j = 0; j < b.cols(); ++j) {
      out.col(i * b.cols() + j) = a.col(i).cwiseProduct(b.col(j));
    }
  }
  return out;
}

class LackOfFitTermMaker {
 public:
  LackOfFitTermMaker(const EffectData& data, const Eigen::Matrix3Xd& position)
      : data_(data), position_(position) {
    for (const Joint& joint : data.arm->joints()) {
      if (joint.type == JointType::kFixed ||
          slides_.size() > static_cast<std::size_t>(joint.coordinate)) {
        continue;
      }
      slides_.push_back(joint.type == JointType::kPrismatic);
    }
    when_ = Eigen::VectorXd(data.rows());
    for (Index i = 0; i < data.rows(); ++i) when_[i] = data.order[i];
    if (data.has("time")) when_ = data.covariate("time").col(0);
  }

  std::vector<LackOfFitTerm> make() {
    if (position_.cols() > 0) of_position();
    of_joints();
    of_pairs();
    of_time();
    of_approach();
    of_covariates();
    return std::move(lack_of_fit_terms_);
  }

 private:
  /// First harmonic of a turning joint, two polynomials of a sliding one; with `second`, twice
  /// that.
  Functions of_joint(int j, bool second) const {
    const Eigen::VectorXd q = data_.q.col(j);
    if (slides_[j]) return curve(spread_out(q)).leftCols(second ? 3 : 2);
    Functions out(q.size(), second ? 4 : 2);
    out.col(0) = q.array().cos();
    out.col(1) = q.array().sin();
    if (second) {
      out.col(2) = (2.0 * q.array()).cos();
      out.col(3) = (2.0 * q.array()).sin();
    }
    return out;
  }

  void along_axes(Dependence dependence, std::string description, Axes axes, double multiplicity,
                  std::function<Functions()> functions, int family = -1) {
    const int frame = axes == Axes::kBase ? 0 : static_cast<int>(data_.arm->joints().size()) + 1;
    lack_of_fit_terms_.push_back({std::move(dependence), -1, std::move(description), family,
                                  multiplicity, [frame, functions = std::move(functions)] {
                                    const Functions f = functions();
                                    std::vector<Perturbation> out;
                                    for (Eigen::Index c = 0; c < f.cols(); ++c) {
                                      for (int axis = 0; axis < 3; ++axis) {
                                        Perturbation perturbation{PerturbationSite::kFrame, frame,
                                                                  RowMatrix::Zero(f.rows(), 6)};
                                        perturbation.values.col(axis) = f.col(c);
                                        out.push_back(std::move(perturbation));
                                      }
                                    }
                                    return out;
                                  }});
  }

  void on_joint(Dependence dependence, std::string description, int joint, double multiplicity,
                std::function<Functions()> functions, int family = -1) {
    lack_of_fit_terms_.push_back(
        {std::move(dependence), joint, std::move(description), family, multiplicity,
         [joint, functions = std::move(functions)] {
           const Functions f = functions();
           std::vector<Perturbation> out;
           for (Eigen::Index c = 0; c < f.cols(); ++c) {
             out.push_back({PerturbationSite::kJoint, joint, RowMatrix(f.col(c))});
           }
           return out;
         }});
  }

  void of_position() {
    for (const int degree : {2, 3}) {
      along_axes({Kind::kPosition}, "a field over the tip's position", Axes::kBase, 2.0, [=, this] {
        Functions u(position_.cols(), 3);
        for (int axis = 0; axis < 3; ++axis)
          u.col(axis) = spread_out(position_.row(axis).transpose());
        std::vector<Eigen::VectorXd> terms;
        for (int i = 0; i <= degree; ++i) {
          for (int j = 0; i + j <= degree; ++j) {
            for (int k = 0; i + j + k <= degree; ++k) {
              if (i + j + k == 0) continue;
              terms.emplace_back(u.col(0).array().pow(i) * u.col(1).array().pow(j) *
                                 u.col(2).array().pow(k));
            }
          }
        }
        Functions out(u.rows(), static_cast<Eigen::Index>(terms.size()));
        for (std::size_t t = 0; t < terms.size(); ++t)
          out.col(static_cast<Eigen::Index>(t)) = terms[t];
        return out;
      });
    }
  }

  void of_joints() {
    const int n = static_cast<int>(data_.q.cols());
    for (int i = 0; i < n; ++i) {
      const auto functions = [=, this] { return of_joint(i, true); };
      const Dependence on{Kind::kJoints, {i}};
      const std::string name = to_text(on);
      along_axes(on, "what shifts the tip in the base's axes with " + name, Axes::kBase, 2.0 * n,
                 functions);
      along_axes(on, "what shifts the tip in the tool's axes with " + name, Axes::kFlange, 2.0 * n,
                 functions);
      for (int j = 0; j < n; ++j) {
        if (j == i) continue;
        on_joint(on, "what moves joint " + number(j) + " with " + name, j, n * (n - 1.0),
                 functions);
      }
    }
  }

  void of_pairs() {
    const int n = static_cast<int>(data_.q.cols());
    const double pairs = 0.5 * n * (n - 1);
    for (int i = 0; i < n; ++i) {
      for (int j = i + 1; j < n; ++j) {
        const Dependence on{Kind::kJoints, {i, j}};
        const std::string name = to_text(on);
        const auto functions = [=, this] {
          return products(of_joint(i, false), of_joint(j, false));
        };
        along_axes(on, "what shifts the tip with " + name + " together", Axes::kBase, pairs,
                   functions);
        for (int k = 0; k < n; ++k) {
          on_joint(on, "what moves joint " + number(k) + " with " + name + " together", k,
                   pairs * n, functions);
        }
      }
    }
  }

  void of_time() {
    const Eigen::VectorXd u = spread_out(when_);
    if (u.isZero()) return;
    const Dependence on{data_.has("time") ? Kind::kTime : Kind::kOrder};
    const std::string name = to_text(on);
    const int n = static_cast<int>(data_.q.cols());
    along_axes(on, "what wanders with " + name, Axes::kBase, 1.0, [=] { return waves(u, 6); });
    for (int j = 0; j < n; ++j) {
      on_joint(on, "a zero of joint " + number(j) + " that wanders with " + name, j, n,
               [=] { return waves(u, 8); });
    }
    if (data_.has("time")) of_periods();
  }

  /// Up to one period in two poses, at the frequency resolution of a recording of this length.
  void of_periods() {
    const double whole = when_.maxCoeff() - when_.minCoeff();
    const int count = static_cast<int>(std::min<Index>(data_.rows(), kMaxPeriods));
    const int n = static_cast<int>(data_.q.cols());
    const double most = static_cast<double>(data_.rows()) / 2.0;
    for (int site = -1; site < n; ++site) {
      for (int step = 2; step < count; ++step) {
        const double cycles = most * step / count;
        const double rate = 2.0 * std::numbers::pi * cycles / whole;
        const Dependence on{Kind::kTime, {}, whole / cycles};
        const std::string period = seconds(*on.period);
        const auto functions = [=, this] {
          Functions out(when_.size(), 2);
          out.col(0) = (rate * (when_.array() - when_[0])).cos();
          out.col(1) = (rate * (when_.array() - when_[0])).sin();
          return out;
        };
        if (site < 0) {
          along_axes(on, "a vibration of period " + period, Axes::kBase, count, functions, 0);
        } else {
          on_joint(on, "a vibration of joint " + number(site) + " of period " + period, site,
                   static_cast<double>(count) * n, functions, 1 + site);
        }
      }
    }
  }

  void of_approach() {
    const int n = static_cast<int>(data_.q.cols());
    const std::vector<int>& row = data_.order;
    for (int j = 0; j < n; ++j) {
      on_joint({Kind::kApproach, {j}},
               "a play of joint " + number(j) + " that depends on where it came from", j, n,
               [=, this] {
                 Functions sign = Functions::Zero(data_.rows(), 1);
                 double last = 0.0;
                 for (std::size_t k = 1; k < row.size(); ++k) {
                   const double move = data_.q(row[k], j) - data_.q(row[k - 1], j);
                   if (move != 0.0) last = move > 0.0 ? 1.0 : -1.0;
                   sign(row[k], 0) = last;
                 }
                 return sign;
               });
    }
  }

  void of_covariates() {
    const int n = static_cast<int>(data_.q.cols());
    for (const auto& [name, table] : data_.covariates) {
      if (name == "time" || name == "gravity") continue;
      if (!data_.has(name)) continue;
      if (name == "session") {
        of_sessions(table.col(0));
        continue;
      }
      for (Eigen::Index c = 0; c < table.cols(); ++c) {
        const Eigen::VectorXd u = spread_out(table.col(c));
        if (u.isZero()) continue;
        Dependence on{Kind::kCovariate, {}, {}, name};
        if (table.cols() > 1) on.component = static_cast<int>(c);
        const std::string what = to_text(on);
        const auto functions = [=] { return curve(u); };
        along_axes(on, "what shifts the tip in the base's axes with " + what, Axes::kBase, 2.0,
                   functions);
        along_axes(on, "what shifts the tip in the tool's axes with " + what, Axes::kFlange, 2.0,
                   functions);
        for (int j = 0; j < n; ++j) {
          on_joint(on, "what moves joint " + number(j) + " with " + what, j, n, functions);
        }
      }
    }
  }

  /// A zero of a joint that differs between sessions.
  void of_sessions(const Eigen::VectorXd& session) {
    std::vector<double> names(session.data(), session.data() + session.size());
    std::sort(names.begin(), names.end());
    names.erase(std::unique(names.begin(), names.end()), names.end());
    if (names.size() < 2 || names.size() > kMaxSessions) return;
    const int n = static_cast<int>(data_.q.cols());
    for (int j = 0; j < n; ++j) {
      on_joint({Kind::kSession},
               "a zero of joint " + number(j) + " that is another in each session", j, n, [=] {
                 Functions out(session.size(), static_cast<Eigen::Index>(names.size()) - 1);
                 for (std::size_t s = 1; s < names.size(); ++s) {
                   out.col(static_cast<Eigen::Index>(s) - 1) =
                       (session.array() == names[s]).cast<double>();
                 }
                 return out;
               });
    }
  }

  static constexpr Index kMaxPeriods = 400;
  static constexpr std::size_t kMaxSessions = 20;

  const EffectData& data_;
  const Eigen::Matrix3Xd position_;
  std::vector<bool> slides_;
  Eigen::VectorXd when_;
  std::vector<LackOfFitTerm> lack_of_fit_terms_;
};

}  // namespace

std::vector<LackOfFitTerm> make_lack_of_fit_terms(const EffectData& data,
                                                  const Eigen::Matrix3Xd& position) {
  auto maker = std::make_shared<LackOfFitTermMaker>(data, position);
  std::vector<LackOfFitTerm> probes = maker->make();
  for (LackOfFitTerm& term : probes) {
    // The maker's arrays live as long as any term.
    term.perturbations = [maker, perturbations = std::move(term.perturbations)] {
      return perturbations();
    };
  }
  return probes;
}

}  // namespace bathyal::diagnosis
