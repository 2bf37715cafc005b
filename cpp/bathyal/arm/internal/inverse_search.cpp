// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/arm/internal/inverse_search.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <mutex>
#include <vector>

#include "bathyal/arm/internal/start_library.hpp"
#include "bathyal/arm/internal/tip_solver.hpp"
#include "bathyal/arm/inverse_problem.hpp"

namespace bathyal::arm {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr int kCenteringSteps = 10;
constexpr double kCentered = 1e-3;  ///< a shorter step towards the middle ends it [rad], [m]
constexpr int kFreeStarts = 16;     ///< that ignore the limits when none within them reaches

/// Starts of one target, best first.
class Starts {
 public:
  Starts(const StartLibrary& library, const PlainPose& target, std::vector<double>& scores)
      : library_(library), scores_(scores) {
    library.score(target, scores_);
  }

  /// Null when all have been given out.
  const double* next() {
    const auto best = std::min_element(scores_.begin(), scores_.end());
    if (*best == kInfinity) return nullptr;
    *best = kInfinity;
    return library_.start(static_cast<std::size_t>(best - scores_.begin()));
  }

 private:
  const StartLibrary& library_;
  std::vector<double>& scores_;
};

template <int N>
class Search final : public InverseRows {
 public:
  Search(const Arm& arm, const InverseOptions& options)
      : arm_(arm), options_(options), problem_(arm, options) {}

  void solve(std::span<const PlainPose> targets, std::size_t begin, std::size_t end,
             const double* starts, std::size_t start_step, InverseResult& result) const override {
    Worker worker(problem_);
    for (std::size_t row = begin; row < end; ++row) {
      solve_row(worker, problem_.relative(targets[row]),
                starts == nullptr ? nullptr : starts + row * start_step, row, result);
    }
  }

 private:
  using Coordinates = std::vector<double>;

  /// What one thread works with.
  struct Worker {
    explicit Worker(const InverseProblem& problem)
        : solver(problem), q(problem.size()), kept(problem.size()), best(problem.size()) {}

    TipSolver<N> solver;
    Coordinates q, kept, best;
    std::vector<double> scores;
    double best_distance, best_cost;  ///< of reached candidates, and of the nearest miss
    int found, iterations, starts;
  };

  void solve_row(Worker& w, const PlainPose& target, const double* start, std::size_t row,
                 InverseResult& result) const {
    w.best_distance = w.best_cost = kInfinity;
    w.found = w.iterations = w.starts = 0;
    const std::span<const double> reference(start == nullptr ? problem_.middle.data() : start,
                                            problem_.size());
    const double distance = std::sqrt(target.translation[0] * target.translation[0] +
                                      target.translation[1] * target.translation[1] +
                                      target.translation[2] * target.translation[2]);
    const bool in_reach = distance <= problem_.reach + problem_.position_tolerance;
    const int centering = options_.centering_steps.value_or(start == nullptr ? kCenteringSteps : 0);
    const int most = in_reach ? options_.max_starts : 1;

    if (start != nullptr) try_start(w, target, start, reference, centering);
    if (w.found < options_.candidates && w.starts < most) {
      Starts others(library(), target, w.scores);
      while (w.found < options_.candidates && w.starts < most) {
        const double* other = others.next();
        if (other == nullptr) break;
        try_start(w, target, other, reference, centering);
      }
    }

    InverseStatus status = InverseStatus::kReached;
    if (w.found == 0) {
      status = in_reach ? diagnose(w, target) : InverseStatus::kOutOfReach;
    }
    problem_.unwind(reference, w.best.data());
    w.solver.evaluate(target, w.best.data());
    const TipState& state = w.solver.state();
    std::copy(w.best.begin(), w.best.end(), result.q.row(static_cast<Index>(row)).begin());
    result.status[row] = status;
    result.error[row] = state.error();
    result.position_error[row] = state.position_error();
    result.angle_error[row] = state.angle_error();
    result.iterations[row] = w.iterations;
    result.starts[row] = w.starts;
  }

  void try_start(Worker& w, const PlainPose& target, const double* start,
                 std::span<const double> reference, int centering) const {
    std::copy_n(start, problem_.size(), w.q.begin());
    ++w.starts;
    w.iterations += w.solver.descend(target, true, w.q.data());
    if (!w.solver.reached()) {
      const double cost = w.solver.state().cost();
      if (w.found == 0 && cost < w.best_cost) {
        w.best_cost = cost;
        w.best = w.q;
      }
      return;
    }
    ++w.found;
    center(w, target, centering);
    problem_.unwind(reference, w.q.data());
    double distance = 0.0;
    for (std::size_t j = 0; j < problem_.size(); ++j) {
      distance += std::pow(w.q[j] - reference[j], 2);
    }
    if (distance < w.best_distance) {
      w.best_distance = distance;
      w.best = w.q;
    }
  }

  /// Through the null space towards the middle of the limits, keeping the last place that reaches.
  void center(Worker& w, const PlainPose& target, int steps) const {
    for (int step = 0; step < steps; ++step) {
      w.kept = w.q;
      const double length = w.solver.center(w.q.data());
      w.iterations += 1 + w.solver.descend(target, true, w.q.data());
      if (!w.solver.reached()) w.q = w.kept;
      if (!w.solver.reached() || length < kCentered) return;
    }
  }

  /// Why no start has reached: whether one would without limits.
  InverseStatus diagnose(Worker& w, const PlainPose& target) const {
    InverseStatus status = InverseStatus::kOutOfReach;
    Starts others(library(), target, w.scores);
    const double* start = w.best.data();
    for (int i = 0; i < kFreeStarts && start != nullptr; ++i, start = others.next()) {
      std::copy_n(start, problem_.size(), w.q.begin());
      w.iterations += w.solver.descend(target, false, w.q.data());
      if (!w.solver.reached()) continue;
      problem_.unwind(problem_.middle, w.q.data());
      if (problem_.within_limits(w.q.data())) return InverseStatus::kSingular;
      status = InverseStatus::kLimit;
    }
    return status;
  }

  /// Made when a target first needs it: a call that only follows a path does without.
  const StartLibrary& library() const {
    std::call_once(library_once_, [this] {
      library_ = std::make_unique<StartLibrary>(arm_, problem_, options_.seed);
    });
    return *library_;
  }

  const Arm& arm_;
  const InverseOptions options_;
  const InverseProblem problem_;
  mutable std::once_flag library_once_;
  mutable std::unique_ptr<StartLibrary> library_;
};

}  // namespace

std::unique_ptr<InverseRows> make_search(const Arm& arm, const InverseOptions& options) {
  switch (arm.size()) {
    case 3:
      return std::make_unique<Search<3>>(arm, options);
    case 4:
      return std::make_unique<Search<4>>(arm, options);
    case 5:
      return std::make_unique<Search<5>>(arm, options);
    case 6:
      return std::make_unique<Search<6>>(arm, options);
    case 7:
      return std::make_unique<Search<7>>(arm, options);
    case 8:
      return std::make_unique<Search<8>>(arm, options);
    default:
      return std::make_unique<Search<-1>>(arm, options);
  }
}

}  // namespace bathyal::arm
