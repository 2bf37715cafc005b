// SPDX-License-Identifier: BSD-3-Clause
// Poses and Jacobians of many joint values at once, on one thread, against Pinocchio and Orocos KDL
// called pose by pose, the only way they have: same values in, same row-major arrays out.
#include <kdl/config.h>
#include <kdl/chainfksolverpos_recursive.hpp>
#include <kdl/chainjnttojacsolver.hpp>

#include <cstdio>
#include <cstdlib>
#include <vector>

#include "bathyal/base/simd.hpp"
#include "kdl_arm.hpp"
#include "pinocchio_peer.hpp"
#include "support/arms.hpp"
#include "timing.hpp"

namespace {

using namespace bathyal;

constexpr Index kCount = 100000;
constexpr double kSame = 1e-12;  // [m, 1]

/// As a user of KDL would: both solvers kept, results copied out.
class KdlPeer {
 public:
  explicit KdlPeer(const Arm& arm)
      : chain_(to_kdl(arm)),
        position_(chain_),
        jacobian_(chain_),
        columns_(chain_.getNrOfJoints()) {}

  void forward_and_jacobian(JointView q, double* poses, double* jacobians) {
    KDL::JntArray row(chain_.getNrOfJoints());
    KDL::Frame pose;
    for (Index i = 0; i < q.rows(); ++i) {
      row.data = q.row(i).transpose();
      position_.JntToCart(row, pose);
      jacobian_.JntToJac(row, columns_);
      pose.Make4x4(poses + 16 * i);
      Eigen::Map<JointMatrix>(jacobians + 6 * q.cols() * i, 6, q.cols()) = columns_.data;
    }
  }

 private:
  KDL::Chain chain_;
  KDL::ChainFkSolverPos_recursive position_;
  KDL::ChainJntToJacSolver jacobian_;
  KDL::Jacobian columns_;
};

double largest_difference(const PosesAndJacobians& a, const PosesAndJacobians& b) {
  double largest = 0.0;
  for (std::size_t i = 0; i < a.poses.size(); ++i) {
    largest = std::max(largest, std::abs(a.poses[i] - b.poses[i]));
  }
  for (std::size_t i = 0; i < a.jacobians.size(); ++i) {
    largest = std::max(largest, std::abs(a.jacobians[i] - b.jacobians[i]));
  }
  return largest;
}

void need_same(const char* name, const char* peer, double difference) {
  if (difference <= kSame) return;
  std::fprintf(stderr, "%s: poses or Jacobians differ from %s's by %g\n", name, peer, difference);
  std::exit(1);
}

void compare(const char* name, const Arm& arm, int rounds) {
  const JointMatrix q = random_poses(arm, kCount, 1);
  PinocchioPeer pinocchio(arm);
  KdlPeer kdl(arm);
  PosesAndJacobians ours = forward_and_jacobian(arm, view_of(q), TipFrame::kWorld, 1);
  PosesAndJacobians theirs = ours;
  std::vector<double> mine, anew, pinocchios, kdls, over_pinocchio, over_kdl;
  for (int round = 0; round < rounds; ++round) {
    mine.push_back(thread_seconds([&] {
      compute_kinematics(arm, view_of(q), {.poses = ours.poses, .jacobians = ours.jacobians}, 1);
    }));
    anew.push_back(
        thread_seconds([&] { forward_and_jacobian(arm, view_of(q), TipFrame::kWorld, 1); }));
    pinocchios.push_back(thread_seconds([&] {
      pinocchio.forward_and_jacobian(view_of(q), theirs.poses.data(), theirs.jacobians.data());
    }));
    need_same(name, "Pinocchio", largest_difference(ours, theirs));
    kdls.push_back(thread_seconds([&] {
      kdl.forward_and_jacobian(view_of(q), theirs.poses.data(), theirs.jacobians.data());
    }));
    need_same(name, "KDL", largest_difference(ours, theirs));
    over_pinocchio.push_back(pinocchios.back() / mine.back());
    over_kdl.push_back(kdls.back() / mine.back());
  }
  const double each = 1e9 / static_cast<double>(kCount);
  std::printf("| %s | %td | %s | **%.1f ×** | **%.0f ×** | %.0f | %.0f | %.0f | %.0f |\n", name,
              arm.size(), std::string(to_text(simd_level())).c_str(), median(over_pinocchio),
              median(over_kdl), each * median(mine), each * median(anew), each * median(pinocchios),
              each * median(kdls));
}

}  // namespace

int main(int argc, char** argv) {
  const int rounds = argc > 1 ? std::atoi(argv[1]) : 15;
  std::printf("## Forward kinematics and Jacobians against Pinocchio %s and KDL %s\n\n",
              PinocchioPeer::version(), KDL_VERSION_STRING);
  std::printf(
      "`build/bench/benchmarks/cpp/bench_arm_forward %d`: %td joint values a call, the tool's pose "
      "and its geometric Jacobian of each, all on one thread, processor time, medians of %d "
      "interleaved rounds; every pose and Jacobian equal to both peers' within %g. All three write "
      "into arrays that are there already; the next column gives ours with newly made arrays, "
      "which costs the system's pages.\n\n",
      rounds, kCount, rounds, kSame);
  std::printf(
      "| arm | joints | SIMD | Pinocchio / ours | KDL / ours | ours [ns] | with new arrays | "
      "Pinocchio [ns] | KDL [ns] |\n|---|---|---|---|---|---|---|---|---|\n");
  const SimdLevel best = simd_level();
  for (const SimdLevel level : available_simd_levels()) {
    if (level > best) break;
    set_simd_level(level);
    compare("Panda", panda(), rounds);
    compare("UR10e", ur10e(), rounds);
  }
}
