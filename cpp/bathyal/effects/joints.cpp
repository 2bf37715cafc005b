// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <set>

#include "bathyal/base/text.hpp"
#include "bathyal/effects/internal/library.hpp"

// Errors along one joint: encoders, gears, screws.

namespace bathyal::effects {
namespace {

double span_of(const EffectData& data, int j) {
  return data.q.col(j).maxCoeff() - data.q.col(j).minCoeff();
}

/// Curves along one joint are aliases of one cause in any parametrization; a scale is one too.
std::string curve_of(int j) { return "curve of joint " + std::to_string(j); }

template <class Body>
void for_each_moving(const EffectData& data, const Body& body) {
  for (int j = 0; j < static_cast<int>(data.q.cols()); ++j) {
    if (moves(data, j)) body(j);
  }
}

class JointHarmonic final : public Effect {
 public:
  EffectInfo info() const override {
    return {
        .name = "joint_harmonic",
        .description =
            "a wave along one joint: an eccentric encoder, a gear's teeth, a screw's pitch",
        .formula = "q' = q + cos · cos(order · q) + sin · sin(order · q)",
        .source =
            "Whitney, Lozinski, Rourke: Industrial robot forward calibration method and results, "
            "1986 (gear eccentricity); Tuttle, Seering: A nonlinear model of a harmonic drive gear "
            "transmission, 1996",
        .ranges = {{.parameter = "cos", .unit = "rad or m", .low = 1e-6, .high = 2e-2},
                   {.parameter = "sin", .unit = "rad or m", .low = 1e-6, .high = 2e-2}},
        .combinable = true};
  }
  std::string describe(const EffectVariant& variant, const Arm& arm) const override {
    return "a wave of order " + three_digits(setting_of(variant, "order")) + " along " +
           describe_joint(variant.joint, arm);
  }

  std::vector<EffectVariant> variants(const EffectData& data) const override {
    std::vector<EffectVariant> out;
    for_each_moving(data, [&](int j) {
      const std::string unit = unit_of(*data.arm, j);
      for (const double order : orders(data, j)) {
        out.push_back({"joint_harmonic",
                       j,
                       {{"order", order}},
                       {{"cos", unit, kTypicalError}, {"sin", unit, kTypicalError}},
                       curve_of(j)});
      }
    });
    return out;
  }

  Perturbations perturbations(const EffectVariant& variant, const EffectData& data) const override {
    const int j = joint_of(variant, data);
    const Eigen::ArrayXd phase = setting_of(variant, "order") * data.q.col(j).array();
    return {{move_joint(j, phase.cos())}, {move_joint(j, phase.sin())}};
  }

  double period(const EffectVariant& variant) const override {
    return 2.0 * std::numbers::pi / std::abs(setting_of(variant, "order"));
  }

  std::vector<EffectVariant> between(const EffectVariant& lower, const EffectVariant& upper,
                                     const EffectData&) const override {
    constexpr int kParts = 8;
    const double low = lower.settings.at("order"), high = upper.settings.at("order");
    std::vector<EffectVariant> out;
    for (int i = 1; i < kParts; ++i) {
      out.push_back(lower);
      out.back().settings["order"] = low + (high - low) * i / kParts;
    }
    // Teeth and encoders cause whole orders: one in between is tried in addition.
    const double whole = std::round(0.5 * (low + high));
    if (low < whole && whole < high) {
      const auto at = std::find_if(out.begin(), out.end(), [&](const EffectVariant& v) {
        return v.settings.at("order") >= whole;
      });
      EffectVariant variant = lower;
      variant.settings["order"] = whole;
      if (at == out.end() || at->settings.at("order") > whole) out.insert(at, std::move(variant));
    }
    return out;
  }

 private:
  /// Two orders that differ by one period over the span (2π / span) are distinguishable; a grid of
  /// a quarter of that loses 3 % of the amplitude between its points, one of half 10 %, and the
  /// search refines what it finds.
  static std::vector<double> orders(const EffectData& data, int j) {
    constexpr double kLeastStep = 0.25;
    constexpr double kFineEnd = 20.0, kEnd = 200.0;
    constexpr int kWholeOrders = 12;
    constexpr double kFineWaves = 10.0, kMostWaves = 100.0;  // of a sliding joint, over its span
    const double wave = 2.0 * std::numbers::pi / span_of(data, j);
    const bool turning = !slides(*data.arm, j);
    const double least = turning ? kLeastStep : 0.0;
    const double fine_end = turning ? kFineEnd : kFineWaves * wave;
    const double end = turning ? kEnd : kMostWaves * wave;
    const double fine = std::max(least, 0.25 * wave), coarse = std::max(least, 0.5 * wave);
    std::set<double> found;
    for (int k = 1; turning && k <= kWholeOrders; ++k) found.insert(k);
    // Less than a quarter of a period over the span is equivalent to an offset and a scale.
    int step = 0;
    double order = 0.25 * wave;
    for (; order <= fine_end; order = 0.25 * wave + ++step * fine) found.insert(order);
    const double from = order;
    for (step = 0; order <= end; order = from + ++step * coarse) found.insert(order);
    return {found.begin(), found.end()};
  }
};

class JointMap final : public Effect {
  static constexpr Index kRowsForTerm = 6;  ///< poses for each term, else it is not determined

 public:
  EffectInfo info() const override {
    return {
        .name = "joint_map",
        .description =
            "a smooth periodic curve along one joint: an encoder's whole error over the turn",
        .formula =
            "q' = q + Σ cos_i · cos(i w q) + sin_i · sin(i w q), i = 1 … terms; w = 1 of a turning "
            "joint, 2π / (1.5 span) of a sliding one",
        .source =
            "Judd, Knasinski: A technique to calibrate industrial robots with experimental "
            "verification, 1990 (gear errors as Fourier series)",
        .ranges = {{.parameter = "cos_1", .unit = "rad or m", .low = 1e-6, .high = 2e-2},
                   {.parameter = "sin_1", .unit = "rad or m", .low = 1e-6, .high = 2e-2}},
        .combinable = true};
  }
  std::string describe(const EffectVariant& variant, const Arm& arm) const override {
    return "a periodic curve along " + describe_joint(variant.joint, arm);
  }

  std::vector<EffectVariant> variants(const EffectData& data) const override {
    constexpr std::array<int, 6> kTerms{2, 3, 4, 6, 8, 12};  // one term is a harmonic
    std::vector<EffectVariant> out;
    for_each_moving(data, [&](int j) {
      const std::string unit = unit_of(*data.arm, j);
      const double wave =
          slides(*data.arm, j) ? 2.0 * std::numbers::pi / (1.5 * span_of(data, j)) : 1.0;
      for (const int terms : kTerms) {
        if (kRowsForTerm * terms > data.rows()) break;
        out.push_back({"joint_map", j, {{"terms", terms}, {"wave", wave}}, {}, curve_of(j)});
        for (int term = 1; term <= terms; ++term) {
          const std::string number = std::to_string(term);
          out.back().parameters.push_back({"cos_" + number, unit, kTypicalError});
          out.back().parameters.push_back({"sin_" + number, unit, kTypicalError});
        }
      }
    });
    return out;
  }

  Perturbations perturbations(const EffectVariant& variant, const EffectData& data) const override {
    const int j = joint_of(variant, data);
    const Eigen::ArrayXd angle = setting_of(variant, "wave") * data.q.col(j).array();
    Perturbations out;
    for (std::size_t term = 1; 2 * term <= variant.parameters.size(); ++term) {
      const Eigen::ArrayXd phase = static_cast<double>(term) * angle;
      out.push_back({move_joint(j, phase.cos())});
      out.push_back({move_joint(j, phase.sin())});
    }
    return out;
  }

  double period(const EffectVariant& variant) const override {
    const auto terms = static_cast<double>(variant.parameters.size() / 2);
    return 2.0 * std::numbers::pi / std::abs(terms * setting_of(variant, "wave"));
  }
};

class JointScale final : public Effect {
 public:
  EffectInfo info() const override {
    return {.name = "joint_scale",
            .description =
                "a joint that reports more, or less, than it moves: a wrong gear ratio, a "
                "stretched belt",
            .formula = "q' = q (1 + scale)",
            .source = "Mooring, Roth, Driels: Fundamentals of manipulator calibration, 1991",
            .ranges = {{.parameter = "scale", .unit = "1", .low = 1e-6, .high = 2e-2}},
            .extrapolates = true};
  }
  std::string describe(const EffectVariant& variant, const Arm& arm) const override {
    return "a wrong scale of " + describe_joint(variant.joint, arm);
  }

  std::vector<EffectVariant> variants(const EffectData& data) const override {
    std::vector<EffectVariant> out;
    for_each_moving(data, [&](int j) {
      out.push_back({"joint_scale", j, {}, {{"scale", "1", kTypicalError}}, curve_of(j)});
    });
    return out;
  }

  Perturbations perturbations(const EffectVariant& variant, const EffectData& data) const override {
    const int j = joint_of(variant, data);
    return {{move_joint(j, data.q.col(j))}};
  }
};

class JointCoupling final : public Effect {
 public:
  EffectInfo info() const override {
    return {
        .name = "joint_coupling",
        .description =
            "a joint that another one moves along: gears, belts or cables that pass through it",
        .formula = "q' = q + ratio · q_by",
        .source =
            "Whitney, Lozinski, Rourke: Industrial robot forward calibration method and results, "
            "1986 (cross-coupling)",
        .ranges = {{.parameter = "ratio", .unit = "1, rad/m or m/rad", .low = 1e-6, .high = 2e-2}},
        .extrapolates = true};
  }
  std::string describe(const EffectVariant& variant, const Arm& arm) const override {
    return describe_joint(variant.joint, arm) + " moved along by " +
           describe_joint(static_cast<int>(setting_of(variant, "by")), arm);
  }

  std::vector<EffectVariant> variants(const EffectData& data) const override {
    std::vector<EffectVariant> out;
    for (int j = 0; j < static_cast<int>(data.q.cols()); ++j) {
      for_each_moving(data, [&](int by) {
        if (by == j) return;
        const std::string mine = unit_of(*data.arm, j), other = unit_of(*data.arm, by);
        out.push_back({"joint_coupling",
                       j,
                       {{"by", by}},
                       {{"ratio", mine == other ? "1" : mine + "/" + other, kTypicalError}},
                       "coupling of joint " + std::to_string(j) + " to " + std::to_string(by)});
      });
    }
    return out;
  }

  Perturbations perturbations(const EffectVariant& variant, const EffectData& data) const override {
    const int by = index_of(variant, "by", data.q.cols());
    return {{move_joint(joint_of(variant, data), data.q.col(by))}};
  }
};

class Backlash final : public Effect {
 public:
  EffectInfo info() const override {
    return {.name = "backlash",
            .description = "play in a joint: it stops short of the side from which it came",
            .formula = "q' = q - gap / 2 · direction",
            .source =
                "Whitney, Lozinski, Rourke, 1986; Ruderman, Hoffmann, Bertram: Modeling and "
                "identification of elastic robot joints with hysteresis and backlash, 2009",
            .needs = {"direction"},
            .ranges = {{.parameter = "gap", .unit = "rad or m", .low = 1e-6, .high = 5e-3}}};
  }
  std::string describe(const EffectVariant& variant, const Arm& arm) const override {
    return "play in " + describe_joint(variant.joint, arm);
  }

  std::vector<EffectVariant> variants(const EffectData& data) const override {
    std::vector<EffectVariant> out;
    if (!data.has("direction")) return out;
    for (int j = 0; j < static_cast<int>(data.q.cols()); ++j) {
      if (!varies(data.covariate("direction").col(j))) continue;
      out.push_back({"backlash",
                     j,
                     {},
                     {{"gap", unit_of(*data.arm, j), kTypicalError}},
                     "backlash of joint " + std::to_string(j)});
    }
    return out;
  }

  Perturbations perturbations(const EffectVariant& variant, const EffectData& data) const override {
    const int j = joint_of(variant, data);
    const Eigen::VectorXd direction = data.covariate("direction").col(j);
    return {{move_joint(j, -0.5 * direction)}};
  }
};

}  // namespace

std::shared_ptr<const Effect> joint_harmonic() { return std::make_shared<JointHarmonic>(); }
std::shared_ptr<const Effect> joint_map() { return std::make_shared<JointMap>(); }
std::shared_ptr<const Effect> joint_scale() { return std::make_shared<JointScale>(); }
std::shared_ptr<const Effect> joint_coupling() { return std::make_shared<JointCoupling>(); }
std::shared_ptr<const Effect> backlash() { return std::make_shared<Backlash>(); }

}  // namespace bathyal::effects
