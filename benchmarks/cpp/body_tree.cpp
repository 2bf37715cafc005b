// SPDX-License-Identifier: BSD-3-Clause
// Accelerations of a hull with five joints, added mass on each body, against Pinocchio's
// articulated-body algorithm of the same bodies without water.
#include "bathyal/vehicle/tree/body_tree.hpp"

#include <cstdio>
#include <cstdlib>
#include <random>
#include <vector>

#include "pinocchio_tree.hpp"
#include "timing.hpp"

namespace {

using namespace bathyal;

constexpr int kLinks = 5;
constexpr int kCalls = 20000;
constexpr double kSame = 1e-10;  // of the largest acceleration
constexpr double kNoWater = 1e-12;

struct Case {
  BodyTreeState state;
  TreeLoads loads;
  Eigen::VectorXd q, velocity, efforts;
};

BodyTreeOptions tree_of(bool water) {
  BodyTreeOptions options;
  const Eigen::Matrix3d inertia = Vec3(0.3, 0.4, 0.5).asDiagonal();
  options.vehicle.body = {13.5, Vec3(0.0, 0.0, -0.01), inertia, 0.0135, Vec3::Zero()};
  options.vehicle.water_density = water ? 1025.0 : kNoWater;
  if (water) options.vehicle.added_mass = Vec6(6.4, 7.1, 18.7, 0.2, 0.1, 0.2).asDiagonal();
  for (int k = 0; k < kLinks; ++k) {
    TreeLink link;
    link.name = "link_" + std::to_string(k);
    link.parent = k - 1;
    link.parent_from_link = Eigen::Translation3d(0.2, 0.02 * k, -0.05) *
                            Eigen::AngleAxisd(0.6 + 0.3 * k, Vec3(0.3, 1.0, 0.2).normalized());
    link.body = {0.5, Vec3(0.05, 0.01, 0.0), 2e-3 * Eigen::Matrix3d::Identity(), 3e-4,
                 Vec3(0.05, 0.0, 0.0)};
    if (water) link.added_mass = Vec6(0.1, 0.3, 0.3, 1e-4, 1e-3, 1e-3).asDiagonal();
    options.links.push_back(link);
  }
  return options;
}

std::vector<Case> cases() {
  std::mt19937 source(1);
  std::uniform_real_distribution<double> number(-1.0, 1.0);
  std::vector<Case> all(256);
  for (Case& one : all) {
    const Vec3 axis = Vec3(number(source), number(source), number(source)).normalized();
    const Eigen::Quaterniond turn(Eigen::AngleAxisd(3.0 * number(source), axis));
    one.state.base.world_from_vehicle.linear() = turn.toRotationMatrix();
    one.q = Eigen::VectorXd::Zero(7 + kLinks);
    one.q.segment<4>(3) = turn.coeffs();
    one.velocity = Eigen::VectorXd::NullaryExpr(6 + kLinks, [&] { return number(source); });
    one.efforts = Eigen::VectorXd::NullaryExpr(6 + kLinks, [&] { return number(source); });
    one.state.base.velocity = one.velocity.head<6>();
    one.loads.wrench = one.efforts.head<6>();
    for (int k = 0; k < kLinks; ++k) {
      one.q[7 + k] = 3.0 * number(source);
      one.state.q.push_back(one.q[7 + k]);
      one.state.rate.push_back(one.velocity[6 + k]);
      one.loads.joints.push_back(one.efforts[6 + k]);
    }
  }
  return all;
}

void need_same(const BodyTree& tree, PinocchioTree& peer, const std::vector<Case>& all) {
  TreeAcceleration found;
  for (const Case& one : all) {
    tree.accelerations(one.state, one.loads, found);
    Eigen::VectorXd own(6 + kLinks);
    own << found.base, Eigen::Map<const Eigen::VectorXd>(found.joints.data(), kLinks);
    const Eigen::VectorXd& other = peer.accelerations(one.q, one.velocity, one.efforts);
    if ((own - other).cwiseAbs().maxCoeff() <= kSame * other.cwiseAbs().maxCoeff()) continue;
    std::fprintf(stderr, "accelerations differ by %g\n", (own - other).cwiseAbs().maxCoeff());
    std::exit(1);
  }
}

}  // namespace

int main(int argc, char** argv) {
  const int rounds = argc > 1 ? std::atoi(argv[1]) : 15;
  const std::vector<Case> all = cases();
  const BodyTree dry(tree_of(false)), wet(tree_of(true));
  PinocchioTree peer(tree_of(false));
  need_same(dry, peer, all);
  TreeAcceleration found;
  double sum = 0.0;
  std::vector<double> own, peers, ratios;
  for (int round = 0; round < rounds; ++round) {
    own.push_back(thread_seconds([&] {
      for (int i = 0; i < kCalls; ++i) {
        const Case& one = all[static_cast<std::size_t>(i) % all.size()];
        wet.accelerations(one.state, one.loads, found);
        sum += found.base[0];
      }
    }));
    peers.push_back(thread_seconds([&] {
      for (int i = 0; i < kCalls; ++i) {
        const Case& one = all[static_cast<std::size_t>(i) % all.size()];
        sum += peer.accelerations(one.q, one.velocity, one.efforts)[0];
      }
    }));
    ratios.push_back(own.back() / peers.back());
  }
  std::printf("## Hull and five joints against Pinocchio %s\n\n", PinocchioTree::version());
  std::printf("| | ns | over Pinocchio's |\n|---|---|---|\n");
  std::printf("| bathyal, added mass on each body, in water | %.0f | **%.2f ×** |\n",
              1e9 * median(own) / kCalls, median(ratios));
  std::printf("| Pinocchio `aba`, without water | %.0f | 1.0 |\n", 1e9 * median(peers) / kCalls);
  return sum == 0.5 ? 1 : 0;  // the work is not optimised away
}
