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
    return {"thermal",
            "links that grow with temperature, all at one rate",
            "a' = a (1 + expansion · (T - mean T)), d' = d (1 + expansion · (T - mean T))",
            "Gong, Yuan, Ni: Nongeometric error identification and compensation for robotic system "
            "by inverse calibration, 2000",
            {"temperature"},
            {{"expansion", "1/K", 1e-6, 1e-4}},
            false,
            false,
            true};
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
    return {"drift",
            "the base, or the tracker's frame, creeps: it moves and turns evenly in time",
            "base' = base · shift rate · (t - t0), turn rate · (t - t0)",
            "Gong, Yuan, Ni: Nongeometric error identification and compensation for robotic system "
            "by inverse calibration, 2000 (errors that grow as a machine warms)",
            {"time"},
            {{"rate_x", "m/s", 1e-9, 1e-4}, {"turn_rate_x", "rad/s", 1e-9, 1e-4}}};
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
    return {"clock_shift",
            "joints and tracker out of step: positions belong to joint values of another moment",
            "q' = q(t + delay) ≈ q + delay · dq/dt",
            "Furgale, Rehder, Siegwart: Unified temporal and spatial calibration for multi-sensor "
            "systems, 2013",
            {"time"},
            {{"delay", "s", 1e-5, 1.0}},
            true};
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
  /// (N, n) by differences of the previous and next rows in time, of one session; at its ends, and
  /// next to rows of the same time, of the only neighbour.
  static RowMatrix speeds(const EffectData& data) {
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
      const auto neighbour = [&](int step) {
        int at = i;
        while (at + step >= 0 && at + step < count) {
          at += step;
          const bool other = sessions && data.covariate("session")(order[at], 0) !=
                                             data.covariate("session")(order[i], 0);
          if (other) break;
          if (time(order[at], 0) != time(order[i], 0)) return order[at];
        }
        return order[i];
      };
      const int before = neighbour(-1), after = neighbour(1);
      const double apart = time(after, 0) - time(before, 0);
      if (apart > 0.0) out.row(order[i]) = (data.q.row(after) - data.q.row(before)) / apart;
    }
    return out;
  }
};

}  // namespace

std::shared_ptr<const Effect> thermal() { return std::make_shared<Thermal>(); }
std::shared_ptr<const Effect> drift() { return std::make_shared<Drift>(); }
std::shared_ptr<const Effect> clock_shift() { return std::make_shared<ClockShift>(); }

}  // namespace bathyal::effects
