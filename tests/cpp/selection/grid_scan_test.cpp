// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/selection/internal/grid_scan.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "bathyal/selection/working_point.hpp"
#include "selection/linear_model.hpp"

namespace bathyal::selection {
namespace {

/// Waves of 1 to 40 periods, more than are scanned at once; one of them is in the data.
constexpr int kTerms = 40, kTrue = 34;

LinearModel waves() {
  LinearModel model;
  const Eigen::ArrayXd t = Eigen::ArrayXd::LinSpaced(kRows, 0.0, 6.25);
  for (int k = 1; k <= kTerms; ++k) model.add("wave", 100.0 * (k * t).cos().matrix());
  model.data() += 3.0 * ((kTrue + 1) * t).cos().matrix();
  return model;
}

std::vector<ScannedTerm> scanned(const LinearModel& model, const NuisanceBasis& nuisance,
                                 int num_threads) {
  std::vector<int> terms(kTerms);
  std::iota(terms.begin(), terms.end(), 0);
  return scan(model, terms, nuisance.basis, model.linearization().residual, nuisance.dof,
              num_threads);
}

TEST(GridScan, GainIsThatOfTheSetWithThisTermAlone) {
  LinearModel model = waves();
  const WorkingPoint point(model, 1);
  const std::vector<ScannedTerm> found = scanned(model, point.nuisance(), 1);
  ASSERT_EQ(found.size(), static_cast<std::size_t>(kTerms));
  for (const ScannedTerm& one : found) {
    const CandidateSet candidates = point.candidate_set({one.term});
    const std::vector<int> alone{0};
    const double gain = candidates.evaluate(alone)->score - candidates.evaluate({})->score;
    EXPECT_NEAR(one.gain, gain, 1e-6) << one.term;
    EXPECT_EQ(one.width, 1.0);
  }
  EXPECT_EQ(peaks(found, 1), std::vector<int>{kTrue});
}

TEST(GridScan, IsTheSameForAnyNumberOfThreads) {
  LinearModel model = waves();
  const WorkingPoint point(model, 1);
  const std::vector<ScannedTerm> one = scanned(model, point.nuisance(), 1);
  const std::vector<ScannedTerm> two = scanned(model, point.nuisance(), 2);
  for (std::size_t i = 0; i < one.size(); ++i) EXPECT_EQ(one[i].gain, two[i].gain);
}

TEST(Peaks, AreTheHighestLocalMaxima) {
  constexpr double kNever = -std::numeric_limits<double>::infinity();
  const std::vector<ScannedTerm> family{{10, 3.0, 0.0, 1.0},    {11, 2.0, 0.0, 1.0},
                                        {12, 5.0, 0.0, 1.0},    {13, 4.9, 0.0, 1.0},
                                        {14, kNever, 0.0, 0.0}, {15, 4.0, 0.0, 1.0}};
  EXPECT_EQ(peaks(family, 9), (std::vector<int>{12, 15, 10}));
  EXPECT_EQ(peaks(family, 2), (std::vector<int>{12, 15}));
}

}  // namespace
}  // namespace bathyal::selection
