// SPDX-License-Identifier: BSD-3-Clause
// Joint angles of random reachable poses against KDL's Levenberg-Marquardt and the published way of
// TRAC-IK: how many are found, within the limits, and how long it takes. All begin in the middle of
// the limits and draw their other starts themselves.
#include <kdl/config.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <string>
#include <vector>

#include "bathyal/arm/inverse.hpp"
#include "kdl_inverse.hpp"
#include "support/arms.hpp"

namespace {

using namespace bathyal;
using Pose4 = Eigen::Matrix<double, 4, 4, Eigen::RowMajor>;

constexpr Index kCount = 10000;
constexpr int kChunks = 10;
/// What counts as found, for all: KDL's accuracies are of each component.
constexpr double kFound = 2e-5;  // [m], [rad]

/// Processor time of all threads [s].
double process_seconds() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// Whether q brings the tool to the target, by the arm's own forward kinematics.
bool is_found(const Arm& arm, const double* q, const double* target) {
  const JointView one(q, 1, arm.size());
  if (!within_limits(arm, one)[0]) return false;
  const std::vector<double> pose = forward(arm, one, 1);
  const Eigen::Map<const Pose4> got(pose.data()), wanted(target);
  const double angle = 0.5 * (got - wanted).topLeftCorner<3, 3>().norm() * std::sqrt(2.0);
  return (got - wanted).topRightCorner<3, 1>().norm() <= kFound && angle <= kFound;
}

/// A way to solve many targets: rows of q, and whether it says that it has found them.
struct Way {
  std::string name;
  std::function<void(const double* targets, Index count, JointMatrix& q, std::vector<bool>& says)>
      solve;
  std::vector<double> seconds = {};  ///< a target, of each chunk
  Index found = 0;

  void run(const Arm& arm, const double* targets, Index count) {
    JointMatrix q = JointMatrix::Zero(count, arm.size());
    std::vector<bool> says(static_cast<std::size_t>(count));
    const double start = process_seconds();
    solve(targets, count, q, says);
    seconds.push_back((process_seconds() - start) / static_cast<double>(count));
    for (Index i = 0; i < count; ++i) {
      const bool right = is_found(arm, q.row(i).data(), targets + 16 * i);
      const bool said = says[static_cast<std::size_t>(i)];
      if (said && !right) {
        std::fprintf(stderr, "%s: an answer that is none\n", name.c_str());
        std::exit(1);
      }
      found += right ? 1 : 0;
    }
  }
};

Way our_way(const Arm& arm) {
  const JointMatrix middle = (0.5 * (arm.lower() + arm.upper())).transpose();
  return {"ours", [&arm, middle](const double* targets, Index count, JointMatrix& q, auto& says) {
            const std::span<const double> all(targets, static_cast<std::size_t>(16 * count));
            const InverseResult result = inverse(arm, all, view_of(middle), {.num_threads = 1});
            q = result.q;
            for (std::size_t i = 0; i < says.size(); ++i) {
              says[i] = result.status[i] == InverseStatus::kReached;
            }
          }};
}

/// A solver of one target at a time.
template <class Solver>
Way kdl_way(const char* name, Solver& solver) {
  return {name, [&solver](const double* targets, Index count, JointMatrix& q, auto& says) {
            KDL::JntArray row(static_cast<unsigned>(q.cols()));
            for (Index i = 0; i < count; ++i) {
              Pose pose;
              pose.matrix() = Eigen::Map<const Pose4>(targets + 16 * i);
              says[static_cast<std::size_t>(i)] = solver.solve(to_kdl(pose), row);
              q.row(i) = row.data.transpose();
            }
          }};
}

/// One that looks whether it is to stop.
template <class Solver>
struct Alone {
  explicit Alone(const KdlProblem& problem) : solver(problem) {}
  bool solve(const KDL::Frame& target, KDL::JntArray& q) { return solver.solve(target, q, never); }
  Solver solver;
  const std::atomic<bool> never{false};
};

void compare(const char* name, const Arm& arm) {
  const std::vector<double> targets = forward(arm, view_of(random_poses(arm, kCount, 1)), 1);
  const KdlProblem problem(arm);
  KdlLma once(problem, false), restarted(problem, true);
  Alone<NewtonRestarted> newton(problem);
  Alone<SqpRestarted> sqp(problem);
  TracWay trac(problem);
  std::vector<Way> ways{our_way(arm),
                        kdl_way("KDL LMA", once),
                        kdl_way("KDL LMA, restarted", restarted),
                        kdl_way("KDL Newton, restarted", newton),
                        kdl_way("SQP, restarted", sqp),
                        kdl_way("TRAC-IK's way: the last two", trac)};
  const Index chunk = kCount / kChunks;
  for (int k = 0; k < kChunks; ++k) {
    for (Way& way : ways) way.run(arm, targets.data() + 16 * chunk * k, chunk);
  }
  for (const Way& way : ways) {
    std::vector<double> ratios;
    for (std::size_t k = 0; k < way.seconds.size(); ++k) {
      ratios.push_back(way.seconds[k] / ways[0].seconds[k]);
    }
    std::printf("| %s | %s | %.2f %% | **%.0f ×** | %.0f |\n", name, way.name.c_str(),
                100.0 * static_cast<double>(way.found) / static_cast<double>(kCount),
                median(ratios), 1e6 * median(way.seconds));
  }
}

}  // namespace

int main() {
  std::printf("## Inverse kinematics against KDL %s and the way of TRAC-IK\n\n",
              KDL_VERSION_STRING);
  std::printf(
      "`build/bench/benchmarks/cpp/bench_arm_inverse`: %td random reachable poses, every search "
      "begins in the middle of the limits. Found is what forward kinematics puts within %g m and "
      "rad of the target, within the limits; ours has a tolerance of 1e-6, the others %g of each "
      "component. TRAC-IK's way is that of Beeson and Ames (2015), our own writing of it on KDL "
      "and NLopt's SLSQP (with an analytic gradient): two threads, each with %g ms of its own "
      "processor time, the first to reach stops the other; its parts and the restarted LMA have "
      "as much. Times are processor time of all threads, medians of %d interleaved chunks of %td "
      "poses; ours on one thread.\n\n",
      kCount, kFound, kTwist, 1e3 * kBudget, kChunks, kCount / kChunks);
  std::printf("| arm | way | found | time / ours | µs a pose |\n|---|---|---|---|---|\n");
  compare("UR10e", ur10e());
  compare("Panda", panda());
}
