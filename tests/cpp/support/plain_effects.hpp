// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <map>

#include "bathyal/identify/model/chain_derivatives.hpp"
#include "bathyal/identify/model/effect_parameters.hpp"
#include "support/simulated_touches.hpp"

// An arm that something is wrong with, written down once more and straight, and data to see it in.

namespace bathyal {

/// A shift, then a turn by a rotation vector.
struct Put {
  Vec3 shift = Vec3::Zero();
  Vec3 turn = Vec3::Zero();

  Pose pose() const {
    Pose out = Pose::Identity();
    out.translation() = shift;
    if (turn.norm() > 0.0) {
      out.linear() = Eigen::AngleAxisd(turn.norm(), turn.normalized()).toRotationMatrix();
    }
    return out;
  }
};

/// What is wrong at one pose.
struct Wrong {
  Eigen::VectorXd joints;     ///< added to the recorded joint values
  std::map<int, Put> behind;  ///< a frame: 0 the base, k behind row k - 1, rows + 1 the flange
  double growth = 0.0;        ///< of a and d
};

inline Pose about_z(double angle) { return Pose(Eigen::AngleAxisd(angle, Vec3::UnitZ())); }
inline Pose about_x(double angle) { return Pose(Eigen::AngleAxisd(angle, Vec3::UnitX())); }
inline Pose about_y(double angle) { return Pose(Eigen::AngleAxisd(angle, Vec3::UnitY())); }
inline Pose along(double x, double z) { return Pose(Eigen::Translation3d(x, 0.0, z)); }

/// Rz(theta) Tz(d) Tx(a) Rx(alpha) Ry(beta)
inline Pose plain_row(const Joint& joint, const Eigen::VectorXd& q, double growth) {
  DhRow row = joint.row;
  row.a *= 1.0 + growth;
  row.d *= 1.0 + growth;
  if (joint.type == JointType::kRevolute) {
    row.theta += joint.multiplier * q[joint.coordinate] + joint.offset;
  } else if (joint.type == JointType::kPrismatic) {
    row.d += joint.multiplier * q[joint.coordinate] + joint.offset;
  }
  return about_z(row.theta) * along(row.a, row.d) * about_x(row.alpha) * about_y(row.beta);
}

/// world_from_tool, with the base and the tool of `arm`.
inline Pose plain_forward(const Arm& arm, const Eigen::VectorXd& recorded, const Wrong& wrong) {
  const auto put = [&wrong](int frame) {
    const auto found = wrong.behind.find(frame);
    return found == wrong.behind.end() ? Pose::Identity() : found->second.pose();
  };
  const auto rows = static_cast<int>(arm.joints().size());
  const Eigen::VectorXd q =
      wrong.joints.size() > 0 ? Eigen::VectorXd(recorded + wrong.joints) : recorded;
  Pose pose = arm.base() * put(0) * arm.root();
  for (int k = 0; k < rows; ++k) {
    pose = pose * plain_row(arm.joints()[k], q, wrong.growth) * put(k + 1);
  }
  return pose * arm.flange() * put(rows + 1) * arm.tool();
}

/// Frames in the base: [0] the root, [k] behind row k - 1.
inline std::vector<Pose> plain_frames(const Arm& arm, const Eigen::VectorXd& q) {
  std::vector<Pose> frames{arm.root()};
  for (const Joint& joint : arm.joints()) {
    frames.push_back(frames.back() * plain_row(joint, q, 0.0));
  }
  return frames;
}

/// Poses with every covariate there is; gravity leans, sessions are 0, 1, 2 of unequal length, and
/// rows are not in the order of time.
struct Scene {
  Arm arm;
  RowMatrix q;
  Covariates covariates;

  explicit Scene(const Arm& of, Index rows = 40) : arm(of), q(random_poses(of, rows, 11)) {
    RandomStream random(12);
    for (const char* name : {"temperature", "time", "payload", "session"}) {
      covariates[name].resize(rows, 1);
    }
    covariates["direction"].resize(rows, arm.size());
    covariates["gravity"].resize(rows, 3);
    for (Index i = 0; i < rows; ++i) {
      covariates["temperature"](i, 0) = random.uniform(8.0, 24.0);
      covariates["time"](i, 0) = 100.0 + 7.0 * static_cast<double>(i * 17 % rows);
      covariates["payload"](i, 0) = random.uniform(0.0, 3.0);
      covariates["session"](i, 0) = i < 12 ? 4.0 : i < 25 ? 7.0 : 9.0;
      for (Index j = 0; j < arm.size(); ++j) {
        covariates["direction"](i, j) = random.uniform() < 0.5 ? -1.0 : 1.0;
      }
      covariates["gravity"].row(i) << random.uniform(-3, 3), random.uniform(-3, 3), -9.0;
    }
  }

  EffectData data(bool rotation = true) const {
    return make_effect_data(arm, q, covariates, rotation);
  }
};

inline std::shared_ptr<const Effect> effect_named(const std::string& name) {
  for (const auto& effect : library_effects()) {
    if (effect->info().name == name) return effect;
  }
  return nullptr;
}

/// The variants of an effect for which `good` is true.
template <class Good>
std::vector<EffectVariant> variants_where(const std::string& name, const EffectData& data,
                                          const Good& good) {
  std::vector<EffectVariant> out;
  for (const EffectVariant& variant : effect_named(name)->variants(data)) {
    if (good(variant)) out.push_back(variant);
  }
  return out;
}

inline std::vector<EffectVariant> variants_of(const std::string& name, const EffectData& data) {
  return effect_named(name)->variants(data);
}

/// One pose a row, tool and base those of the arm.
inline Measurement measurement_of(const Arm& arm, const RowMatrix& q, bool rotation) {
  Tracked tracked;
  tracked.q = q;
  tracked.position = RowMatrix::Zero(q.rows(), 3);
  if (rotation) tracked.pose.assign(static_cast<std::size_t>(q.rows()), Pose::Identity());
  return to_measurement(arm, tracked);
}

/// Columns of the arm at its own values, without its base.
inline ArmParameters columns_of(const Arm& arm, const Measurement& m) {
  return make_parameters(arm, m, {arm.base()}, {arm.tool()}, {}, {.free_base = true});
}

using Formula = std::function<Wrong(Index row, const Eigen::VectorXd& values)>;

/// The engine's poses with the effect at sizes drawn at random against plain_forward.
inline void expect_means(const Scene& scene, const EffectVariant& variant, const Formula& formula,
                         double size = 0.02) {
  const EffectData data = scene.data();
  const std::string name = variant_name(variant);
  const Measurement m = measurement_of(scene.arm, scene.q, true);
  ArmParameters parameters = columns_of(scene.arm, m);
  const int first = add_effect(parameters, variant,
                               perturbations_of(*effect_named(variant.effect), variant, data));
  const auto count = static_cast<Index>(variant.parameters.size());
  RandomStream random(3);
  Eigen::VectorXd values(count);
  for (double& value : values) value = size * random.uniform(0.5, 1.0);
  Eigen::VectorXd x = parameters.nominal();
  x.segment(first, count) = values;
  const ChainDerivatives chain(parameters, x, {});
  const ChainDerivatives without(parameters, parameters.nominal(), {});
  ChainFrames frames;
  double moved = 0.0;
  for (Index i = 0; i < scene.q.rows(); ++i) {
    const double* q = scene.q.row(i).data();
    const Pose found = chain.tip(q, i, 0, 0, frames, nullptr, nullptr, 0);
    const Pose truth = plain_forward(scene.arm, scene.q.row(i), formula(i, values));
    EXPECT_LT((found.matrix() - truth.matrix()).norm(), 1e-10) << name << " in row " << i;
    const Pose plain = without.tip(q, i, 0, 0, frames, nullptr, nullptr, 0);
    moved = std::max(moved, (found.matrix() - plain.matrix()).norm());
  }
  EXPECT_GT(moved, 1e-4) << name << " moved nothing";
}

inline Wrong wrong_joint(const Arm& arm, int joint, double by) {
  Wrong wrong;
  wrong.joints = Eigen::VectorXd::Zero(arm.size());
  wrong.joints[joint] = by;
  return wrong;
}

inline Wrong wrong_frame(int frame, const Vec3& shift, const Vec3& turn) {
  Wrong wrong;
  wrong.behind[frame] = {shift, turn};
  return wrong;
}

}  // namespace bathyal
