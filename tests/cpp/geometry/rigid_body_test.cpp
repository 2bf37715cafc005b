// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/geometry/rigid_body.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

namespace bathyal {
namespace {

constexpr double kInf = std::numeric_limits<double>::infinity();
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

Eigen::Matrix3d moments(double x, double y, double z) { return Vec3(x, y, z).asDiagonal(); }

Pose any_pose() {
  return Eigen::Translation3d(0.3, -0.2, 0.5) * Eigen::AngleAxisd(0.7, Vec3(1, 2, -1).normalized());
}

/// The text of the error that `check` throws; empty where it throws none.
std::string refusal(const RigidBody& body) {
  try {
    body.check("link hand");
    return "";
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
}

TEST(RigidBody, IsAcceptedWithoutNumbersAndWithThoseOfABody) {
  RigidBody body;
  EXPECT_EQ(refusal(body), "");
  body.mass = 2.0;
  for (const Eigen::Matrix3d& inertia :
       {moments(1, 1, 1), moments(0, 1, 1), moments(1, 2, 3), moments(1e-300, 1e-300, 1e-300),
        moments(1e300, 1e300, 1e300), moments(0.0012, 0.0034, 0.0046)}) {
    body.inertia = inertia;
    EXPECT_EQ(refusal(body), "");
    EXPECT_EQ(refusal(in_frame(body, any_pose())), "");
  }
}

TEST(RigidBody, RefusesMassesAndVolumesThatNothingHas) {
  for (const double bad : {-1.0, -1e-300, kNan, kInf, -kInf}) {
    RigidBody heavy, large;
    heavy.mass = bad;
    large.volume = bad;
    EXPECT_NE(refusal(heavy).find("`link hand mass`: expected a finite"), std::string::npos);
    EXPECT_NE(refusal(large).find("`link hand volume`: expected a finite"), std::string::npos);
  }
}

TEST(RigidBody, RefusesCentresThatAreNotFinite) {
  for (const double bad : {kNan, kInf}) {
    RigidBody body, floating;
    body.center_of_mass.y() = bad;
    floating.center_of_buoyancy.z() = bad;
    EXPECT_NE(refusal(body).find("`link hand center_of_mass`"), std::string::npos);
    EXPECT_NE(refusal(floating).find("`link hand center_of_buoyancy`"), std::string::npos);
  }
}

TEST(RigidBody, RefusesAnInertiaThatNoBodyHas) {
  Eigen::Matrix3d skewed = moments(1, 1, 1);
  skewed(0, 1) = 0.1;
  Eigen::Matrix3d only_beside = Eigen::Matrix3d::Zero();
  only_beside(0, 1) = only_beside(1, 0) = 1.0;
  const std::vector<Eigen::Matrix3d> bad{
      skewed,           only_beside,         moments(-1, 1, 1),       moments(-1, -1, -1),
      moments(1, 1, 3), moments(0, 0, 1e-9), moments(0.1, 0.2, kNan), moments(kInf, kInf, kInf)};
  for (const Eigen::Matrix3d& inertia : bad) {
    RigidBody body;
    body.inertia = inertia;
    EXPECT_NE(refusal(body).find("`link hand inertia`: expected"), std::string::npos) << inertia;
  }
}

TEST(RigidBody, KeepsItsMomentsInAnotherFrame) {
  RigidBody body;
  body.mass = 3.0;
  body.center_of_mass = Vec3(0.1, 0.2, 0.3);
  body.inertia = moments(1.0, 1.5, 2.0);
  body.volume = 0.01;
  body.center_of_buoyancy = Vec3(0.0, 0.1, 0.2);
  const Pose pose = any_pose();
  const RigidBody moved = in_frame(body, pose);
  EXPECT_EQ(moved.mass, 3.0);
  EXPECT_EQ(moved.volume, 0.01);
  EXPECT_EQ(moved.center_of_mass, pose * body.center_of_mass);
  EXPECT_EQ(moved.center_of_buoyancy, pose * body.center_of_buoyancy);
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(moved.inertia);
  EXPECT_LE((solver.eigenvalues() - Vec3(1.0, 1.5, 2.0)).norm(), 1e-14);
}

TEST(RigidBody, OfTwoHalvesIsTheWhole) {
  const auto box = [](double x, double y, double z) {  // of density 1
    RigidBody body;
    body.mass = body.volume = x * y * z;
    body.inertia = body.mass / 12.0 * moments(y * y + z * z, x * x + z * z, x * x + y * y);
    return body;
  };
  RigidBody low = box(1, 2, 1.5), high = low;
  low.center_of_mass.z() = low.center_of_buoyancy.z() = -0.75;
  high.center_of_mass.z() = high.center_of_buoyancy.z() = 0.75;
  const RigidBody whole = combined(low, high), expected = box(1, 2, 3);
  EXPECT_DOUBLE_EQ(whole.mass, expected.mass);
  EXPECT_DOUBLE_EQ(whole.volume, expected.volume);
  EXPECT_LE(whole.center_of_mass.norm() + whole.center_of_buoyancy.norm(), 1e-15);
  EXPECT_LE((whole.inertia - expected.inertia).norm(), 1e-14);
}

TEST(RigidBody, WithoutMassKeepsItsCentre) {
  RigidBody one, other;
  one.center_of_mass = Vec3(1, 2, 3);
  EXPECT_EQ(combined(one, other).center_of_mass, Vec3(1, 2, 3));
  other.mass = 1.0;
  EXPECT_EQ(combined(one, other).center_of_mass, Vec3(0, 0, 0));
}

}  // namespace
}  // namespace bathyal
