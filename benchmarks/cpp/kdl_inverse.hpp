// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <kdl/chainfksolverpos_recursive.hpp>
#include <kdl/chainiksolverpos_lma.hpp>
#include <kdl/chainiksolvervel_pinv.hpp>
#include <kdl/chainjnttojacsolver.hpp>

#include <atomic>
#include <nlopt.hpp>
#include <thread>
#include <vector>

#include "bathyal/base/random.hpp"
#include "kdl_arm.hpp"
#include "timing.hpp"

// Inverse kinematics on KDL: its own Levenberg-Marquardt, and the way of Beeson, Ames, "TRAC-IK: an
// open-source library for improved solving of generic inverse kinematics" (2015), our own
// writing of it: Newton's steps by the pseudo-inverse with joint limits and random restarts, next
// to sequential quadratic programming on the sum of squared errors (NLopt's SLSQP) with the same,
// whichever is first.

namespace bathyal {

inline constexpr double kBudget = 5e-3;  ///< [s] a target, as published
inline constexpr double kTwist = 1e-5;   ///< [m], [rad] of each component, as published

/// What every solver of a target works with.
struct KdlProblem {
  explicit KdlProblem(const Arm& solved)
      : arm(solved), chain(to_kdl(solved)), middle(chain.getNrOfJoints()) {
    middle.data = 0.5 * (arm.lower() + arm.upper());
  }

  unsigned size() const { return chain.getNrOfJoints(); }

  void draw(RandomStream& random, KDL::JntArray& q) const {
    for (unsigned j = 0; j < size(); ++j) q(j) = random.uniform(arm.lower()[j], arm.upper()[j]);
  }

  /// Whole turns taken off that lead beyond the limits; false where a joint stays beyond them.
  bool wrap(KDL::JntArray& q) const {
    bool within = true;
    for (unsigned j = 0; j < size(); ++j) {
      const double lower = arm.lower()[j], upper = arm.upper()[j], turn = 2.0 * M_PI;
      if (q(j) > upper) q(j) -= turn * std::ceil((q(j) - upper) / turn);
      if (q(j) < lower) q(j) += turn * std::ceil((lower - q(j)) / turn);
      within = within && q(j) <= upper;
    }
    return within;
  }

  void clamp(KDL::JntArray& q) const {
    q.data = q.data.cwiseMax(arm.lower()).cwiseMin(arm.upper());
  }

  const Arm& arm;
  KDL::Chain chain;
  KDL::JntArray middle;  ///< of the limits: where every search begins
};

/// KDL's ChainIkSolverPos_LMA from the middle of the limits and, if `restarts`, from poses drawn
/// within them until one reaches or the time is over.
class KdlLma {
 public:
  KdlLma(const KdlProblem& problem, bool restarts)
      : problem_(problem), restarts_(restarts), solver_(problem.chain, kAccuracy), random_(1) {}

  bool solve(const KDL::Frame& target, KDL::JntArray& q) {
    const double end = thread_seconds() + kBudget;
    KDL::JntArray start = problem_.middle;
    do {
      if (solver_.CartToJnt(start, target, q) == KDL::SolverI::E_NOERROR && problem_.wrap(q)) {
        return true;
      }
      problem_.draw(random_, start);
    } while (restarts_ && thread_seconds() < end);
    return false;
  }

 private:
  /// A radian weighs a hundredth of a metre there.
  static constexpr double kAccuracy = 0.01 * kTwist;

  const KdlProblem& problem_;
  bool restarts_;
  KDL::ChainIkSolverPos_LMA solver_;
  RandomStream random_;
};

/// KDL-RR of the paper: joints are held at their limits, and where they no longer move the search
/// begins anew at random.
class NewtonRestarted {
 public:
  explicit NewtonRestarted(const KdlProblem& problem)
      : problem_(problem),
        forward_(problem.chain),
        velocity_(problem.chain),
        before_(problem.size()),
        step_(problem.size()),
        random_(2) {}

  bool solve(const KDL::Frame& target, KDL::JntArray& q, const std::atomic<bool>& stop) {
    const double end = thread_seconds() + kBudget;
    q = problem_.middle;
    while (!stop.load(std::memory_order_relaxed) && thread_seconds() < end) {
      forward_.JntToCart(q, pose_);
      const KDL::Twist missing = KDL::diff(pose_, target);
      if (KDL::Equal(missing, KDL::Twist::Zero(), kTwist)) return true;
      before_ = q;
      velocity_.CartToJnt(q, missing, step_);
      KDL::Add(q, step_, q);
      if (!problem_.wrap(q)) problem_.clamp(q);
      if ((q.data - before_.data).cwiseAbs().maxCoeff() < kStill) problem_.draw(random_, q);
    }
    return false;
  }

 private:
  static constexpr double kStill = 1e-6;  // [rad]

  const KdlProblem& problem_;
  KDL::ChainFkSolverPos_recursive forward_;
  KDL::ChainIkSolverVel_pinv velocity_;
  KDL::JntArray before_, step_;
  KDL::Frame pose_;
  RandomStream random_;
};

/// SQP-SS of the paper, with the analytic gradient.
class SqpRestarted {
 public:
  explicit SqpRestarted(const KdlProblem& problem)
      : problem_(problem),
        forward_(problem.chain),
        jacobian_(problem.chain),
        columns_(problem.size()),
        at_(problem.size()),
        optimizer_(nlopt::LD_SLSQP, problem.size()),
        random_(3) {
    const Arm& arm = problem.arm;
    optimizer_.set_lower_bounds({arm.lower().begin(), arm.lower().end()});
    optimizer_.set_upper_bounds({arm.upper().begin(), arm.upper().end()});
    optimizer_.set_xtol_abs(1e-8);
    optimizer_.set_min_objective(
        [](const std::vector<double>& x, std::vector<double>& gradient, void* self) {
          return static_cast<SqpRestarted*>(self)->cost(x, gradient);
        },
        this);
  }

  bool solve(const KDL::Frame& target, KDL::JntArray& q, const std::atomic<bool>& stop) {
    target_ = target;
    stop_ = &stop;
    end_ = thread_seconds() + kBudget;
    reached_ = false;
    q = problem_.middle;
    for (;;) {
      std::vector<double> x(q.data.begin(), q.data.end());
      double least = 0.0;
      try {
        optimizer_.optimize(x, least);
      } catch (const std::exception&) {  // forced to stop, or rounding leaves it no way on
      }
      if (reached_) {
        q = at_;
        return true;
      }
      if (over()) return false;
      problem_.draw(random_, q);
    }
  }

 private:
  bool over() const { return stop_->load(std::memory_order_relaxed) || thread_seconds() >= end_; }

  double cost(const std::vector<double>& x, std::vector<double>& gradient) {
    std::copy(x.begin(), x.end(), at_.data.data());
    forward_.JntToCart(at_, pose_);
    const KDL::Twist missing = KDL::diff(pose_, target_);
    reached_ = KDL::Equal(missing, KDL::Twist::Zero(), kTwist);
    if (reached_ || over()) throw nlopt::forced_stop();
    Eigen::Matrix<double, 6, 1> error;
    for (int i = 0; i < 6; ++i) error[i] = missing[i];
    if (!gradient.empty()) {
      jacobian_.JntToJac(at_, columns_);
      Eigen::Map<Eigen::VectorXd>(gradient.data(), static_cast<Index>(gradient.size())) =
          -2.0 * columns_.data.transpose() * error;
    }
    return error.squaredNorm();
  }

  const KdlProblem& problem_;
  KDL::ChainFkSolverPos_recursive forward_;
  KDL::ChainJntToJacSolver jacobian_;
  KDL::Jacobian columns_;
  KDL::JntArray at_;
  nlopt::opt optimizer_;
  RandomStream random_;
  KDL::Frame target_, pose_;
  const std::atomic<bool>* stop_ = nullptr;
  double end_ = 0.0;
  bool reached_ = false;
};

/// Both on threads of their own, each with the whole budget; the first to reach stops the other.
class TracWay {
 public:
  explicit TracWay(const KdlProblem& problem)
      : newton_(problem), sqp_(problem), by_newton_(problem.size()), by_sqp_(problem.size()) {}

  bool solve(const KDL::Frame& target, KDL::JntArray& q) {
    std::atomic<bool> done{false};
    bool newton = false, sqp = false;
    std::thread newton_thread([&] {
      newton = newton_.solve(target, by_newton_, done);
      if (newton) done = true;
    });
    sqp = sqp_.solve(target, by_sqp_, done);
    if (sqp) done = true;
    newton_thread.join();
    q = newton ? by_newton_ : by_sqp_;
    return newton || sqp;
  }

 private:
  NewtonRestarted newton_;
  SqpRestarted sqp_;
  KDL::JntArray by_newton_, by_sqp_;
};

}  // namespace bathyal
