// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>

#include "bathyal/effects/gravity_load.hpp"
#include "bathyal/effects/internal/library.hpp"
#include "bathyal/estimation/rank.hpp"

// Joints that yield under weight.

namespace bathyal::effects {
namespace {

constexpr double kOrdinaryCompliance = 1e-5;  ///< [rad/(N m)] or [m/N]

std::string compliance_unit(const Arm& arm, int j) { return slides(arm, j) ? "m/N" : "rad/(N m)"; }

/// Unknown masses of the links beyond a joint: for each link its mass, and its mass
/// moment along each axis of the frame that it hangs on. A joint's torque is linear in them.
class LumpedMoments {
 public:
  static constexpr int kKinds = 4;  ///< mass, moment along x, y, z

  LumpedMoments(const EffectData& data, int coordinate)
      : data_(data),
        coordinate_(coordinate),
        loads_(data, GravityLoads::Bodies::kNone, Eigen::VectorXd::Zero(data.rows())) {}

  /// Torques of a unit of one of them. (N,)
  Eigen::VectorXd torque(int moment) const {
    const std::size_t link = static_cast<std::size_t>(moment / kKinds) + 1;
    const int kind = moment % kKinds;
    Eigen::VectorXd out(data_.rows());
    for (Index i = 0; i < data_.rows(); ++i) {
      const Pose& frame = loads_.frames(i).world_from_row[link];
      const Burden body =
          kind == 0 ? Burden{1.0, frame.translation()} : Burden{0.0, frame.linear().col(kind - 1)};
      out[i] = loads_.torque_of(coordinate_, i, link, body);
    }
    return out;
  }

  /// Those that are independent of an offset of the joint and of those before them. A torque with
  /// an independent component of less than a hundredth of what such a weight can exert on this arm
  /// is dropped. The tolerance is not relative to the torque itself: a torque that is zero at the
  /// nominal arm is not at a slightly different one, and would be selected there.
  std::vector<int> independent() const {
    constexpr double kIndependentShare = 1e-2;
    const int count = kKinds * static_cast<int>(data_.arm->joints().size());
    const double pull = data_.gravity.rowwise().norm().maxCoeff(), lever = reach();
    Eigen::MatrixXd torques(data_.rows(), count + 1);
    std::vector<int> order{count};
    torques.col(count).setOnes();
    for (int moment = 0; moment < count; ++moment) {
      const bool mass = moment % kKinds == 0;
      const double largest = pull * (mass && !slides(*data_.arm, coordinate_) ? lever : 1.0);
      torques.col(moment) = torque(moment);
      if (!varies(torques.col(moment)) || !(largest > 0.0)) continue;
      torques.col(moment) /= largest;
      order.push_back(moment);
    }
    const double rows = std::sqrt(static_cast<double>(data_.rows()));
    std::vector<int> kept = select_longer(torques, order, kIndependentShare * rows).kept;
    std::erase(kept, count);
    return kept;
  }

 private:
  /// How far the arm's frames lie from the first one, at most [m].
  double reach() const {
    double out = 0.0;
    for (Index i = 0; i < data_.rows(); ++i) {
      const std::vector<Pose>& frames = loads_.frames(i).world_from_row;
      for (const Pose& frame : frames) {
        out = std::max(out, (frame.translation() - frames[0].translation()).norm());
      }
    }
    return out;
  }

  const EffectData& data_;
  int coordinate_;
  GravityLoads loads_;
};

/// Where masses are unknown, "moment_1" … are compliance times a mass moment of the links beyond
/// (settings say which), and "compliance" is that under the recorded payload.
class JointCompliance final : public Effect {
 public:
  bool needs_weight(const EffectVariant& variant) const override {
    return std::any_of(
        variant.parameters.begin(), variant.parameters.end(),
        [&](const EffectParameter& p) { return !variant.settings.contains(p.name); });
  }

  EffectInfo info() const override {
    return {.name = "joint_compliance",
            .description = "a joint that yields under the weight that it carries",
            .formula =
                "q' = q + compliance · τ(q), τ the torque of gravity along the joint; of unknown "
                "masses "
                "q' = q + Σ moment_i · τ_i(q), τ_i the torque of a unit of mass or mass moment",
            .source =
                "Whitney, Lozinski, Rourke, 1986; Khalil, Besnard: Geometric calibration of robots "
                "with "
                "flexible joints and links, 2002",
            .ranges = {{.parameter = "compliance",
                        .unit = "rad/(N m) or m/N",
                        .low = 1e-8,
                        .high = 1e-2}},
            .extrapolates = true};
  }
  std::string describe(const EffectVariant& variant, const Arm& arm) const override {
    return describe_joint(variant.joint, arm) + " giving way under gravity";
  }

  std::vector<EffectVariant> variants(const EffectData& data) const override {
    std::vector<EffectVariant> out;
    const bool known = masses_known(*data.arm);
    const GravityLoads loads(data, GravityLoads::Bodies::kArm, payload_of(data));
    for (int j = 0; j < static_cast<int>(data.q.cols()); ++j) {
      EffectVariant variant{
          "joint_compliance", j, {}, {}, "compliance of joint " + std::to_string(j)};
      if (!known) add_moments(data, variant);
      if (is_felt(loads.torque(j))) {
        variant.parameters.push_back(
            {"compliance", compliance_unit(*data.arm, j), kOrdinaryCompliance});
      }
      if (!variant.parameters.empty()) out.push_back(std::move(variant));
    }
    return out;
  }

  Perturbations perturbations(const EffectVariant& variant, const EffectData& data) const override {
    const int j = joint_of(variant, data);
    const auto moment_count = LumpedMoments::kKinds * static_cast<Index>(data.arm->joints().size());
    const LumpedMoments moments(data, j);
    const GravityLoads loads(data, GravityLoads::Bodies::kArm, payload_of(data));
    Perturbations out;
    for (const EffectParameter& parameter : variant.parameters) {
      out.push_back(
          {move_joint(j, is_lumped(variant, parameter)
                             ? moments.torque(index_of(variant, parameter.name, moment_count))
                             : loads.torque(j))});
    }
    return out;
  }

  /// Of unknown masses only those moments are fitted that the poses of the data tell apart: another
  /// pose may need others.
  bool extrapolates(const EffectVariant& variant) const override {
    return std::none_of(
        variant.parameters.begin(), variant.parameters.end(),
        [&](const EffectParameter& parameter) { return is_lumped(variant, parameter); });
  }

 private:
  static bool is_lumped(const EffectVariant& variant, const EffectParameter& parameter) {
    return variant.settings.contains(parameter.name);
  }
  static bool is_felt(const Eigen::VectorXd& torque) {
    constexpr double kNothing = 1e-9;  // [N m] or [N], above rounding errors
    return varies(torque) && torque.maxCoeff() - torque.minCoeff() > kNothing;
  }

  static void add_moments(const EffectData& data, EffectVariant& variant) {
    const std::string unit = slides(*data.arm, variant.joint) ? "m" : "rad";
    for (const int moment : LumpedMoments(data, variant.joint).independent()) {
      const std::string name = "moment_" + std::to_string(variant.parameters.size() + 1);
      const bool mass = moment % LumpedMoments::kKinds == 0;
      variant.settings[name] = moment;
      variant.parameters.push_back(
          {name, unit + (mass && unit == "rad" ? " kg/(N m)" : " kg/N"), kOrdinaryCompliance});
    }
  }
};

class UnknownPayload final : public Effect {
 public:
  EffectInfo info() const override {
    return {
        .name = "payload",
        .description =
            "joints that give way under load, as by a mass at the tool that was not recorded",
        .formula =
            "q'_j = q_j + mass_compliance_j · τ_j(1 kg at the tool centre point), all turning "
            "joints",
        .source =
            "Khalil, Besnard: Geometric calibration of robots with flexible joints and links, 2002",
        .ranges =
            {{.parameter = "mass_compliance_1", .unit = "kg rad/(N m)", .low = 1e-8, .high = 1e-2}},
        .extrapolates = true};
  }
  std::string describe(const EffectVariant&, const Arm&) const override {
    return "joints giving way under load, as by a mass at the tool";
  }

  std::vector<EffectVariant> variants(const EffectData& data) const override {
    const GravityLoads loads = of_one_kilogram(data);
    EffectVariant variant{"payload", -1, {}, {}, "payload"};
    for (int j = 0; j < static_cast<int>(data.q.cols()); ++j) {
      const Eigen::VectorXd torque = loads.torque(j);
      if (slides(*data.arm, j) || torque.maxCoeff() - torque.minCoeff() < kNothing) continue;
      const std::string name = "mass_compliance_" + std::to_string(j + 1);
      variant.settings[name] = j;
      variant.parameters.push_back({name, "kg rad/(N m)", kOrdinaryCompliance});
    }
    if (variant.parameters.empty()) return {};
    return {variant};
  }

  Perturbations perturbations(const EffectVariant& variant, const EffectData& data) const override {
    const GravityLoads loads = of_one_kilogram(data);
    Perturbations out;
    for (const EffectParameter& parameter : variant.parameters) {
      const int j = index_of(variant, parameter.name, data.q.cols());
      out.push_back({move_joint(j, loads.torque(j))});
    }
    return out;
  }

 private:
  static constexpr double kNothing = 1e-9;  ///< [N m], above rounding errors

  static GravityLoads of_one_kilogram(const EffectData& data) {
    return {data, GravityLoads::Bodies::kNone, Eigen::VectorXd::Ones(data.rows())};
  }
};

}  // namespace

std::shared_ptr<const Effect> joint_compliance() { return std::make_shared<JointCompliance>(); }
std::shared_ptr<const Effect> payload() { return std::make_shared<UnknownPayload>(); }

}  // namespace bathyal::effects
