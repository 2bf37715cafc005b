// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>

#include "bathyal/effects/internal/library.hpp"

// Effects of temperature and time.

namespace bathyal::effects {
namespace {

class Thermal final : public Effect {
 public:
  EffectInfo info() const override {
    return {
        .name = "thermal",
        .description = "links that grow with temperature, all at one rate",
        .formula = "a' = a (1 + expansion · (T - mean T)), d' = d (1 + expansion · (T - mean T))",
        .source =
            "Gong, Yuan, Ni: Nongeometric error identification and compensation for robotic system "
            "by inverse calibration, 2000",
        .needs = {"temperature"},
        .ranges = {{.parameter = "expansion", .unit = "1/K", .low = 1e-6, .high = 1e-4}},
        .extrapolates = true};
  }
  std::string describe(const EffectVariant&, const Arm&) const override {
    return "links growing with temperature";
  }

  std::vector<EffectVariant> variants(const EffectData& data) const override {
    if (!data.has("temperature") || !varies(data.covariate("temperature").col(0))) return {};
    constexpr double kAluminium = 2.3e-5;
    return {{"thermal",
             -1,
             {{"mean_temperature", data.covariate("temperature").mean()}},
             {{"expansion", "1/K", kAluminium}},
             "thermal"}};
  }

  Perturbations perturbations(const EffectVariant& variant, const EffectData& data) const override {
    const Eigen::ArrayXd warmer =
        data.covariate("temperature").col(0).array() - setting_of(variant, "mean_temperature");
    return {{{PerturbationSite::kLength, 0, warmer.matrix()}}};
  }
};

class Drift final : public Effect {
 public:
  EffectInfo info() const override {
    return {
        .name = "drift",
        .description =
            "the base, or the tracker's frame, creeps: it moves and turns evenly in time",
        .formula = "base' = base · shift rate · (t - t0), turn rate · (t - t0)",
        .source =
            "Gong, Yuan, Ni: Nongeometric error identification and compensation for robotic system "
            "by inverse calibration, 2000 (errors that grow as a machine warms)",
        .needs = {"time"},
        .ranges = {{.parameter = "rate_x", .unit = "m/s", .low = 1e-9, .high = 1e-4},
                   {.parameter = "turn_rate_x", .unit = "rad/s", .low = 1e-9, .high = 1e-4}}};
  }
  std::string describe(const EffectVariant&, const Arm&) const override {
    return "the base, or the tracker, drifting with time";
  }

  std::vector<EffectVariant> variants(const EffectData& data) const override {
    if (!data.has("time") || !varies(since_first(data))) return {};
    const double span = since_first(data).maxCoeff();
    EffectVariant variant{
        "drift", -1, {{"first_time", data.covariate("time").minCoeff()}}, {}, "drift"};
    const std::vector<std::string> axes = frame_axes("rate", "turn_rate", true);
    for (std::size_t axis = 0; axis < axes.size(); ++axis) {
      variant.parameters.push_back({axes[axis], axis < 3 ? "m/s" : "rad/s", kTypicalError / span});
    }
    return {variant};
  }

  Perturbations perturbations(const EffectVariant& variant, const EffectData& data) const override {
    const Eigen::ArrayXd since =
        data.covariate("time").col(0).array() - setting_of(variant, "first_time");
    Perturbations out;
    for (int axis = 0; axis < 6; ++axis) out.push_back({move_frame(0, axis, since)});
    return out;
  }

 private:
  static Eigen::VectorXd since_first(const EffectData& data) {
    const Eigen::ArrayXd time = data.covariate("time").col(0).array();
    return time - time.minCoeff();
  }
};

class ClockShift final : public Effect {
 public:
  EffectInfo info() const override {
    return {
        .name = "clock_shift",
        .description =
            "joints and tracker out of step: positions belong to joint values of another moment",
        .formula = "q' = q(t + delay) ≈ q + delay · dq/dt",
        .source =
            "Furgale, Rehder, Siegwart: Unified temporal and spatial calibration for multi-sensor "
            "systems, 2013",
        .needs = {"time"},
        .ranges = {{.parameter = "delay", .unit = "s", .low = 1e-5, .high = 1.0}},
        .by_difference = true};
  }
  std::string describe(const EffectVariant&, const Arm&) const override {
    return "clocks of joints and tracker out of step";
  }

  std::vector<EffectVariant> variants(const EffectData& data) const override {
    if (!data.has("time") || speeds(data).isZero(0.0)) return {};
    return {{"clock_shift", -1, {}, {{"delay", "s", kTypicalError}}, "clock_shift"}};
  }

  Perturbations perturbations(const EffectVariant&, const EffectData& data) const override {
    const RowMatrix speed = speeds(data);
    Perturbations out(1);
    for (int j = 0; j < static_cast<int>(speed.cols()); ++j) {
      out[0].push_back(move_joint(j, speed.col(j)));
    }
    return out;
  }

 private:
  /// (N, n) of the polynomial through each row and its nearest neighbours in time, of one session
  /// and of other times: two on either side, at an end four on one.
  static RowMatrix speeds(const EffectData& data) {
    constexpr int kNeighbours = 4;
    const RowMatrix& time = data.covariate("time");
    const bool sessions = data.has("session");
    RowMatrix out = RowMatrix::Zero(data.rows(), data.q.cols());
    const auto count = static_cast<int>(data.order.size());
    std::vector<int> order = data.order;
    if (sessions) {
      const RowMatrix& session = data.covariate("session");
      std::stable_sort(order.begin(), order.end(),
                       [&session](int a, int b) { return session(a, 0) < session(b, 0); });
    }
    for (int i = 0; i < count; ++i) {
      const int row = order[i];
      // Up to four on each side, the nearest first; one a time.
      const auto neighbours = [&](int step) {
        std::vector<int> found;
        double last = time(row, 0);
        for (int at = i + step; at >= 0 && at < count; at += step) {
          const int other = order[at];
          if (static_cast<int>(found.size()) == kNeighbours ||
              (sessions &&
               data.covariate("session")(other, 0) != data.covariate("session")(row, 0)))
            break;
          if (time(other, 0) == last) continue;
          last = time(other, 0);
          found.push_back(other);
        }
        return found;
      };
      std::vector<int> before = neighbours(-1), after = neighbours(1);
      while (before.size() + after.size() > kNeighbours) {
        (before.size() > after.size() ? before : after).pop_back();
      }
      before.insert(before.end(), after.begin(), after.end());
      out.row(row) = slope(time, data.q, row, before);
    }
    return out;
  }

  /// Derivative at `row` of the polynomial through it and `others`, by Lagrange's formula.
  static Eigen::RowVectorXd slope(const RowMatrix& time, const RowMatrix& q, int row,
                                  const std::vector<int>& others) {
    Eigen::RowVectorXd out = Eigen::RowVectorXd::Zero(q.cols());
    for (const int a : others) {
      double weight = 1.0 / (time(a, 0) - time(row, 0));
      for (const int b : others) {
        if (b != a) weight *= (time(row, 0) - time(b, 0)) / (time(a, 0) - time(b, 0));
      }
      out += weight * (q.row(a) - q.row(row));
    }
    return out;
  }
};

}  // namespace

std::shared_ptr<const Effect> thermal() { return std::make_shared<Thermal>(); }
std::shared_ptr<const Effect> drift() { return std::make_shared<Drift>(); }
std::shared_ptr<const Effect> clock_shift() { return std::make_shared<ClockShift>(); }

}  // namespace bathyal::effects
