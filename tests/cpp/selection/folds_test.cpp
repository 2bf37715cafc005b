// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/selection/folds.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <set>

namespace bathyal::selection {
namespace {

Observations observations_of(int count) {
  Observations observations;
  observations.order.resize(static_cast<std::size_t>(count));
  std::iota(observations.order.begin(), observations.order.end(), 0);
  observations.replicate = observations.order;
  observations.session.assign(observations.order.size(), 0);
  observations.group.assign(observations.order.size(), -1);
  return observations;
}

TEST(Folds, GroupsInEverySessionAreHeldOutOneByOne) {
  Observations observations = observations_of(180);
  for (int u = 0; u < 180; ++u) {
    observations.group[static_cast<std::size_t>(u)] = u % 6;
    observations.session[static_cast<std::size_t>(u)] = u / 60;
  }
  const Folds folds = make_folds(observations, 10);
  ASSERT_EQ(folds.count, 6);
  for (int u = 0; u < 180; ++u) EXPECT_EQ(folds.fold_of[u], folds.fold_of[u % 6]);
}

TEST(Folds, PosesRepeatedInEverySessionGiveEvenFolds) {
  Observations observations = observations_of(180);
  for (int u = 0; u < 180; ++u) {
    observations.replicate[static_cast<std::size_t>(u)] = u % 60;
    observations.session[static_cast<std::size_t>(u)] = u / 60;
  }
  const Folds folds = make_folds(observations, 10);
  ASSERT_EQ(folds.count, 10);
  for (int b = 0; b < 10; ++b)
    EXPECT_EQ(std::count(folds.fold_of.begin(), folds.fold_of.end(), b), 18);
}

TEST(Folds, ShortSessionsShareFolds) {
  Observations observations = observations_of(90);
  for (const int rows : {1, 2, 3}) {
    for (int u = 0; u < 90; ++u) observations.session[static_cast<std::size_t>(u)] = u / rows;
    const Folds folds = make_folds(observations, 10);
    ASSERT_EQ(folds.count, 10) << rows;
    for (int b = 0; b < 10; ++b)
      EXPECT_EQ(std::count(folds.fold_of.begin(), folds.fold_of.end(), b), 9);
  }
}

TEST(Folds, AreBlocksOfEqualLengthInTime) {
  const Folds folds = make_folds(observations_of(95));
  EXPECT_EQ(folds.count, 10);
  std::vector<int> size(10, 0);
  for (const int b : folds.fold_of) ++size[b];
  for (const int s : size) EXPECT_NEAR(s, 9.5, 0.6);
  for (std::size_t i = 1; i < folds.fold_of.size(); ++i)
    EXPECT_GE(folds.fold_of[i], folds.fold_of[i - 1]);
}

TEST(Folds, AreShortRunsOfAListWithoutTimes) {
  Observations observations = observations_of(240);
  observations.timed = false;
  const Folds folds = make_folds(observations);
  EXPECT_EQ(folds.count, 10);
  for (int b = 0; b < folds.count; ++b) {
    int runs = 0;
    for (std::size_t i = 0; i < folds.fold_of.size(); ++i) {
      if (folds.fold_of[i] == b && (i == 0 || folds.fold_of[i - 1] != b)) ++runs;
    }
    EXPECT_EQ(runs, 8);
  }
}

TEST(Folds, KeepReplicatesTogetherAndHavePartOfEverySession) {
  Observations observations = observations_of(200);
  for (int i = 0; i < 200; ++i) {
    observations.session[i] = i / 100;
    observations.replicate[i] = i % 50;
  }
  const Folds folds = make_folds(observations);
  for (int i = 0; i < 200; ++i) EXPECT_EQ(folds.fold_of[i], folds.fold_of[i % 50]);
  for (int b = 0; b < folds.count; ++b) {
    std::set<int> sessions;
    for (int i = 0; i < 200; ++i) {
      if (folds.fold_of[i] == b) sessions.insert(observations.session[i]);
    }
    EXPECT_EQ(sessions.size(), 2u);
  }
}

TEST(Folds, AreWholeGroupsThoughTheirObservationsAlternate) {
  Observations observations = observations_of(120);
  for (int i = 0; i < 120; ++i) observations.group[i] = i % 12;
  const Folds folds = make_folds(observations);
  EXPECT_GE(folds.count, 6);
  for (int i = 0; i < 120; ++i) EXPECT_EQ(folds.fold_of[i], folds.fold_of[i % 12]);
}

TEST(Folds, OneChainOfReplicatesCannotBeHeldOut) {
  Observations observations = observations_of(30);
  observations.replicate.assign(30, 0);
  EXPECT_EQ(make_folds(observations).count, 1);
}

TEST(Replicates, AreFoundAlongChains) {
  Eigen::MatrixXd q(5, 2);
  q << 0.0, 0.0, 0.0009, 0.0, 0.0018, 0.0, 0.0018, 1.0, 3.0, 0.0;
  EXPECT_EQ(find_replicates(q, 1e-3), (std::vector<int>{0, 0, 0, 1, 2}));
}

TEST(Folds, OfGivenGroupsAreTheGroups) {
  const Folds folds = folds_of_groups({0, 1, 0, 2, 1});
  EXPECT_EQ(folds.count, 3);
  EXPECT_EQ(folds.fold_of, (std::vector<int>{0, 1, 0, 2, 1}));
  EXPECT_EQ(folds.description, "3 given groups were held out in turn");
}

TEST(Folds, OfManyGivenGroupsAreSeveralGroups) {
  std::vector<int> groups;
  for (int i = 0; i < 240; ++i) groups.push_back(i / 2);
  const Folds folds = folds_of_groups(groups);
  EXPECT_EQ(folds.count, kMostGroupFolds);
  for (int i = 0; i < 240; i += 2) EXPECT_EQ(folds.fold_of[i], folds.fold_of[i + 1]);
}

}  // namespace
}  // namespace bathyal::selection
