// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "support/plain_effects.hpp"

// Effects of weight, against virtual work and a cantilever written down here.

namespace bathyal {
namespace {

struct Body {
  double mass;
  Vec3 place;  ///< in the base
};

/// Link k (0 the foot), and the payload behind all.
std::vector<Body> bodies_of(const Arm& arm, const Eigen::VectorXd& q, double payload) {
  const std::vector<Pose> frames = plain_frames(arm, q);
  std::vector<Body> out;
  for (std::size_t k = 0; k < arm.links().size(); ++k) {
    const Link& link = arm.links()[k];
    out.push_back({link.body.mass, frames[k] * link.row_from_link * link.body.center_of_mass});
  }
  out.push_back({payload, (frames.back() * arm.flange() * arm.tool()).translation()});
  return out;
}

/// What gravity does along a coordinate: less potential energy per unit of it.
double virtual_torque(const Arm& arm, const Eigen::VectorXd& q, int joint, double payload,
                      const Vec3& gravity) {
  const auto work = [&](double at) {
    Eigen::VectorXd moved = q;
    moved[joint] += at;
    double sum = 0.0;
    for (const Body& body : bodies_of(arm, moved, payload))
      sum += body.mass * gravity.dot(body.place);
    return sum;
  };
  constexpr double kStep = 1e-3;
  const auto slope = [&](double step) { return (work(step) - work(-step)) / (2.0 * step); };
  return (4.0 * slope(kStep) - slope(2.0 * kStep)) / 3.0;  // Richardson
}

Vec3 gravity_at(const Scene& scene, Index i) {
  return scene.covariates.at("gravity").row(i).transpose();
}

Arm without_masses(const Arm& arm) {
  Arm out(arm.name(), arm.joints(), {}, arm.root(), arm.flange());
  out.set_base(arm.base());
  out.set_tool(arm.tool());
  return out;
}

TEST(GravityEffects, JointsGiveWayByTheVirtualWorkOfWeight) {
  const Scene scene(irregular_arm(3));
  const auto variants = variants_of("joint_compliance", scene.data());
  ASSERT_EQ(variants.size(), 4U);
  for (const EffectVariant& v : variants) {
    ASSERT_EQ(v.parameters.size(), 1U);
    EXPECT_EQ(v.parameters[0].name, "compliance");
    EXPECT_EQ(v.parameters[0].unit, v.joint == 1 ? "m/N" : "rad/(N m)");
    expect_means(
        scene, v,
        [&](Index i, const Eigen::VectorXd& p) {
          const double torque =
              virtual_torque(scene.arm, scene.q.row(i), v.joint,
                             scene.covariates.at("payload")(i, 0), gravity_at(scene, i));
          return wrong_joint(scene.arm, v.joint, p[0] * torque);
        },
        1e-3);
  }
}

TEST(GravityEffects, WithoutGravityToldItPointsDown) {
  Scene scene(irregular_arm(3));
  scene.covariates.erase("gravity");
  expect_means(
      scene, variants_of("joint_compliance", scene.data()).at(2),
      [&](Index i, const Eigen::VectorXd& p) {
        const double torque =
            virtual_torque(scene.arm, scene.q.row(i), 2, scene.covariates.at("payload")(i, 0),
                           Vec3(0.0, 0.0, -9.80665));
        return wrong_joint(scene.arm, 2, p[0] * torque);
      },
      1e-3);
}

TEST(GravityEffects, PayloadIsAnUnknownMassOnEveryTurningJoint) {
  const Scene scene(irregular_arm(3));
  const auto variants = variants_of("payload", scene.data());
  ASSERT_EQ(variants.size(), 1U);
  ASSERT_EQ(variants[0].parameters.size(), 3U);
  EXPECT_EQ(variants[0].parameters[1].name, "mass_compliance_3");
  const Arm light = without_masses(scene.arm);
  expect_means(
      scene, variants[0],
      [&](Index i, const Eigen::VectorXd& p) {
        Wrong wrong;
        wrong.joints = Eigen::VectorXd::Zero(4);
        for (int c = 0; c < 3; ++c) {
          const int joint = c == 0 ? 0 : c + 1;
          wrong.joints[joint] =
              p[c] * virtual_torque(light, scene.q.row(i), joint, 1.0, gravity_at(scene, i));
        }
        return wrong;
      },
      1e-3);
}

/// Unknown masses: any masses at all are some sizes of the moments, up to an offset of the joint.
TEST(GravityEffects, MomentsMakeUpTheTorqueOfAnyMasses) {
  const Scene scene(irregular_arm(3));
  Scene untold(without_masses(scene.arm));
  untold.covariates["payload"].setZero();
  for (int joint = 0; joint < 4; ++joint) {
    const auto variants = variants_where("joint_compliance", untold.data(),
                                         [&](const EffectVariant& v) { return v.joint == joint; });
    ASSERT_EQ(variants.size(), 1U);
    const auto perturbations =
        perturbations_of(*effect_named("joint_compliance"), variants[0], untold.data());
    Eigen::MatrixXd shapes(40, static_cast<Index>(perturbations.size()) + 1);
    shapes.col(0).setOnes();
    for (std::size_t p = 0; p < perturbations.size(); ++p) {
      EXPECT_EQ(variants[0].parameters[p].name, "moment_" + std::to_string(p + 1));
      EXPECT_EQ(perturbations[p][0].index, joint);
      shapes.col(static_cast<Index>(p) + 1) = perturbations[p][0].values.col(0);
    }
    Eigen::VectorXd torque(40);
    for (Index i = 0; i < 40; ++i) {
      torque[i] = virtual_torque(scene.arm, scene.q.row(i), joint, 0.0, gravity_at(scene, i));
    }
    const Eigen::VectorXd share = shapes.colPivHouseholderQr().solve(torque);
    EXPECT_LT((shapes * share - torque).norm(), 0.02 * torque.norm()) << joint;
    EXPECT_LT(shapes.cols(), 30) << "not fewer than there are masses";
  }
}

/// What a drawing has at nothing is next to nothing on an arm that is a little off it, and no
/// number of its own there.
TEST(GravityEffects, MomentsAreThoseOfTheDrawingOnAnArmALittleOffIt) {
  const Scene drawn(without_masses(ur10e()));
  std::vector<Joint> joints = drawn.arm.joints();
  for (std::size_t k = 0; k < joints.size(); ++k) {
    const double off = 2e-3 * (k % 2 == 0 ? 1.0 : -1.0);
    joints[k].row.a += off;
    joints[k].row.alpha -= off;
    joints[k].row.d -= off;
    joints[k].row.theta += off;
    joints[k].row.beta += off;
  }
  Scene off(Arm(drawn.arm.name(), joints, {}, drawn.arm.root(), drawn.arm.flange()));
  off.q = drawn.q;
  const auto settings = [](const Scene& scene) {
    std::map<int, std::map<std::string, double>> out;
    Scene plain = scene;
    plain.covariates.clear();
    for (const EffectVariant& v : variants_of("joint_compliance", plain.data())) {
      out[v.joint] = v.settings;
    }
    return out;
  };
  EXPECT_EQ(settings(off), settings(drawn));
  EXPECT_FALSE(settings(drawn).contains(0));
}

TEST(GravityEffects, MomentsFoundInSomePosesMeanTheSameInOthers) {
  Scene all(without_masses(irregular_arm(3)));
  const EffectData data = all.data();
  const EffectVariant variant = variants_of("joint_compliance", data).at(2);
  const auto of_all = perturbations_of(*effect_named("joint_compliance"), variant, data);
  Scene one = all;
  one.q = all.q.row(7).eval();
  for (auto& [name, values] : one.covariates) values = RowMatrix(values.row(7));
  const auto of_one = perturbations_of(*effect_named("joint_compliance"), variant, one.data());
  for (std::size_t p = 0; p < of_all.size(); ++p) {
    EXPECT_EQ(of_all[p][0].values(7, 0), of_one[p][0].values(0, 0));
  }
}

/// Those of other poses were dropped where the data did not tell them apart.
TEST(GravityEffects, MomentsOfUnknownMassesAreNotExtrapolated) {
  Scene scene(irregular_arm(3));
  scene.arm = without_masses(scene.arm);
  const auto effect = library_effects()[5];
  ASSERT_EQ(effect->info().name, "joint_compliance");
  const auto variants = effect->variants(scene.data());
  ASSERT_FALSE(variants.empty());
  for (const EffectVariant& v : variants) EXPECT_FALSE(effect->extrapolates(v));
}

/// In the base: of joint k, the point of its axis next to the frame of its link; of a sliding joint
/// that of the guide, which does not slide.
Vec3 origin_of_joint(const Arm& arm, const Eigen::VectorXd& q, std::size_t k) {
  const std::vector<Pose> frames = plain_frames(arm, q);
  const Vec3 place = (frames[k + 1] * arm.links()[k + 1].row_from_link).translation();
  const Vec3 axis = frames[k].linear().col(2), before = frames[k].translation();
  const Joint& joint = arm.joints()[k];
  const double slid = joint.type == JointType::kPrismatic
                          ? joint.multiplier * q[joint.coordinate] + joint.offset
                          : 0.0;
  return before + axis * (axis.dot(place - before) - slid);
}

TEST(GravityEffects, LinksBendAsCantileversBetweenTheOriginsOfTheirJoints) {
  const Scene scene(irregular_arm(3));
  const auto variants = variants_of("link_compliance", scene.data());
  const auto& joints = scene.arm.joints();
  const auto sliding = std::count_if(joints.begin(), joints.end(), [](const Joint& joint) {
    return joint.type == JointType::kPrismatic;
  });
  EXPECT_EQ(variants.size(), joints.size() + static_cast<std::size_t>(sliding));
  for (const EffectVariant& v : variants) {
    const int row = static_cast<int>(v.settings.at("row"));
    EXPECT_EQ(v.joint, joints[row].coordinate);
    // On a slide a link is as long wherever it is, or a column that extends.
    const bool slid = joints[row].type == JointType::kPrismatic && !v.settings.contains("extends");
    expect_means(
        scene, v,
        [&](Index i, const Eigen::VectorXd& p) {
          const Eigen::VectorXd q = scene.q.row(i);
          const std::vector<Pose> frames = plain_frames(scene.arm, q);
          const std::vector<Body> bodies =
              bodies_of(scene.arm, q, scene.covariates.at("payload")(i, 0));
          const bool last = row + 1 == static_cast<int>(scene.arm.joints().size());
          const Vec3 end = last ? Vec3((frames[row + 1] * scene.arm.flange()).translation())
                                : origin_of_joint(scene.arm, q, static_cast<std::size_t>(row) + 1);
          // All in the base, turned at the end.
          Vec3 start = origin_of_joint(scene.arm, q, static_cast<std::size_t>(row));
          if (slid) {
            const double value = joints[row].multiplier * q[joints[row].coordinate];
            start += (value + joints[row].offset) * frames[row].linear().col(2);
          }
          const Vec3 l = end - start;
          Vec3 force = Vec3::Zero(), moment = Vec3::Zero();
          for (std::size_t k = static_cast<std::size_t>(row) + 2; k < bodies.size(); ++k) {
            const Vec3 weight = bodies[k].mass * gravity_at(scene, i);
            force += weight;
            moment += (bodies[k].place - end).cross(weight);
          }
          const Vec3 across = moment - l * (l.dot(moment) / l.squaredNorm());
          const double flexible = p[0] * l.norm();
          const Vec3 turn = flexible * (across + 0.5 * l.cross(force));
          const Vec3 shift = flexible * (0.5 * across.cross(l) + l.cross(force).cross(l) / 3.0);
          const Eigen::Matrix3d into = frames[row + 1].linear().transpose();
          const Vec3 to_end = end - frames[row + 1].translation();
          return wrong_frame(row + 1, into * (shift - turn.cross(to_end)), into * turn);
        },
        1e-4);
  }
}

/// Where there is nothing but a table, a link has the ends of its row.
TEST(GravityEffects, LinksOfATableEndInTheFramesOfItsRows) {
  Scene scene(planar_arm(), 6);
  const auto bend = [&](Vec3 offset) {
    std::vector<Link> links(3);
    if (!offset.isZero()) {
      for (Link& link : links) link.row_from_link.translation() = offset;
    }
    const Scene own{Arm("planar", scene.arm.joints(), links), 6};
    const auto variants = variants_of("link_compliance", own.data());
    return RowMatrix(
        perturbations_of(*effect_named("link_compliance"), variants.at(0), own.data())[0][0]
            .values);
  };
  EXPECT_EQ(bend(Vec3::Zero()), bend(Vec3(0.1, 0.0, 0.0)));  // next to the same points of the axes
  EXPECT_NE(bend(Vec3::Zero()), bend(Vec3(0.0, 0.0, 0.1)));
}

/// F L³ / 3 E I and F L² / 2 E I of a beam with a load at its end.
TEST(GravityEffects, BeamSagsAsTheTextbookSays) {
  Scene scene(planar_arm(), 6);
  scene.covariates["gravity"].rowwise() = Eigen::RowVector3d(0.0, 0.0, -10.0);
  scene.covariates["payload"].col(0) << 1, 2, 3, 4, 5, 6;
  const auto variants = variants_of("link_compliance", scene.data());
  ASSERT_EQ(variants.size(), 2U);
  const auto perturbations =
      perturbations_of(*effect_named("link_compliance"), variants[1], scene.data());
  const RowMatrix& bend = perturbations[0][0].values;  // link of 0.4 m in x of its frame
  EXPECT_NEAR(bend(2, 2), -30.0 * 0.4 * 0.4 * 0.4 / 3.0, 1e-12);
  EXPECT_NEAR(bend(2, 4), 30.0 * 0.4 * 0.4 / 2.0, 1e-12);
  EXPECT_NEAR(bend.row(2).squaredNorm(), std::pow(bend(2, 2), 2) + std::pow(bend(2, 4), 2), 1e-12);
}

TEST(GravityEffects, StandTiltsUnderTheMomentOfAllWeight) {
  const Scene scene(irregular_arm(3));
  const auto variants = variants_of("base_compliance", scene.data());
  ASSERT_EQ(variants.size(), 1U);
  expect_means(
      scene, variants[0],
      [&](Index i, const Eigen::VectorXd& p) {
        Vec3 moment = Vec3::Zero();
        const std::vector<Body> bodies =
            bodies_of(scene.arm, scene.q.row(i), scene.covariates.at("payload")(i, 0));
        for (std::size_t k = 1; k < bodies.size(); ++k) {  // the first link rests on the ground
          moment += bodies[k].place.cross(bodies[k].mass * gravity_at(scene, i));
        }
        return wrong_frame(0, Vec3::Zero(), Vec3(p[0] * moment.x(), p[1] * moment.y(), 0.0));
      },
      1e-3);
}

TEST(GravityEffects, WithoutMassesOrPayloadNothingBends) {
  Scene scene(without_masses(irregular_arm(3)));
  scene.covariates.erase("payload");
  EXPECT_TRUE(variants_of("link_compliance", scene.data()).empty());
  EXPECT_TRUE(variants_of("base_compliance", scene.data()).empty());
}

TEST(GravityEffects, JointAboutTheVerticalFeelsNoWeight) {
  Scene scene(ur10e());
  scene.covariates.erase("gravity");
  for (const EffectVariant& v : variants_of("joint_compliance", scene.data())) {
    EXPECT_NE(v.joint, 0);
  }
}

}  // namespace
}  // namespace bathyal
