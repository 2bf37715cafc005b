// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <memory>
#include <stdexcept>

#include "bathyal/effects/effect.hpp"

// Effects to try corrected arms with, one of each kind of site and argument, written here so that
// the tests do not rest on the library's own formulas.

namespace bathyal {

/// An effect given by its needs and its one perturbation.
class FunctionEffect final : public Effect {
 public:
  using Moves = Perturbation (*)(const EffectData&);

  FunctionEffect(std::string name, Moves moves, std::vector<std::string> needs = {},
                 bool by_difference = false)
      : name_(std::move(name)),
        moves_(moves),
        needs_(std::move(needs)),
        by_difference_(by_difference) {}

  EffectInfo info() const override {
    EffectInfo info;
    info.name = name_;
    info.needs = needs_;
    info.by_difference = by_difference_;
    return info;
  }
  std::vector<EffectVariant> variants(const EffectData&) const override { return {}; }
  std::vector<std::vector<Perturbation>> perturbations(const EffectVariant&,
                                                       const EffectData& data) const override {
    return {{moves_(data)}};
  }

 private:
  std::string name_;
  Moves moves_;
  std::vector<std::string> needs_;
  bool by_difference_;
};

inline FoundEffect found(std::string name, int joint, double value, FunctionEffect::Moves moves,
                         std::vector<std::string> needs = {}, bool by_difference = false) {
  FoundEffect effect;
  effect.variant.effect = name;
  effect.variant.joint = joint;
  effect.variant.parameters = {{"size", "rad", 1e-3}};
  effect.effect =
      std::make_shared<FunctionEffect>(std::move(name), moves, std::move(needs), by_difference);
  effect.values = Eigen::VectorXd::Constant(1, value);
  return effect;
}

/// A coordinate moved by a curve along itself and another one.
inline FoundEffect curve(double size) {
  return found("curve", 1, size, [](const EffectData& data) {
    RowMatrix values = (3.0 * data.q.col(1)).array().sin() + data.q.col(0).array().cos();
    return Perturbation{PerturbationSite::kJoint, 1, std::move(values)};
  });
}

/// The frame behind the first row bends as the arm reaches out.
inline FoundEffect bending(double size) {
  return found("bending", 0, size, [](const EffectData& data) {
    RowMatrix values(data.rows(), 6);
    for (Index i = 0; i < data.rows(); ++i) {
      const double reach = std::cos(data.q(i, 1));
      values.row(i) << 0.1 * reach, -0.2, reach * reach, reach, -2.0 * reach, 0.5;
    }
    return Perturbation{PerturbationSite::kFrame, 1, std::move(values)};
  });
}

/// The base moved between sessions 1 and 2.
inline FoundEffect moved_base(double size) {
  return found("moved_base", -1, size,
               [](const EffectData& data) {
                 RowMatrix values = RowMatrix::Zero(data.rows(), 6);
                 const RowMatrix& session = data.covariates.at("session");
                 for (Index i = 0; i < data.rows(); ++i) {
                   if (session(i, 0) == 2.0) values.row(i) << 1.0, 2.0, 3.0, 0.1, 0.2, 0.3;
                 }
                 return Perturbation{PerturbationSite::kFrame, 0, std::move(values)};
               },
               {"session"});
}

/// The flange slipped at 100 s.
inline FoundEffect slip(double size) {
  return found("slip", -1, size,
               [](const EffectData& data) {
                 RowMatrix values = RowMatrix::Zero(data.rows(), 6);
                 const RowMatrix& time = data.covariates.at("time");
                 for (Index i = 0; i < data.rows(); ++i) {
                   if (time(i, 0) >= 100.0) values(i, 1) = 1.0;
                 }
                 const auto flange = static_cast<int>(data.arm->joints().size()) + 1;
                 return Perturbation{PerturbationSite::kFrame, flange, std::move(values)};
               },
               {"time"});
}

/// All lengths grow with the temperature above 20 °C, and a little with the first coordinate.
inline FoundEffect growth(double size) {
  return found("growth", -1, size,
               [](const EffectData& data) {
                 RowMatrix values = (data.covariates.at("temperature").col(0).array() - 20.0) *
                                    (1.0 + 0.1 * data.q.col(0).array());
                 return Perturbation{PerturbationSite::kLength, 0, std::move(values)};
               },
               {"temperature"});
}

/// The payload turns the second joint.
inline FoundEffect sag(double size) {
  return found("sag", 1, size, [](const EffectData& data) {
    RowMatrix values = data.covariates.at("payload").col(0).array() * data.gravity.col(2).array();
    return Perturbation{PerturbationSite::kJoint, 1, std::move(values)};
  });
}

/// Joint values are late: what counts is how they change from row to row.
inline FoundEffect late(double size) {
  return found(
      "late", -1, size,
      [](const EffectData& data) {
        RowMatrix values = RowMatrix::Zero(data.rows(), 1);
        for (Index i = 1; i < data.rows(); ++i) values(i, 0) = data.q(i, 0) - data.q(i - 1, 0);
        return Perturbation{PerturbationSite::kJoint, 0, std::move(values)};
      },
      {"time"}, true);
}

}  // namespace bathyal
