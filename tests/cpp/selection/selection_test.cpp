// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/selection/selection.hpp"

#include <gtest/gtest.h>

#include <numeric>
#include <string>
#include <vector>

#include "bathyal/base/random.hpp"

namespace bathyal {
namespace {

constexpr Index kRows = 200, kOfBlock = 20;

/// A linear model of one base column, with noise of 1: nothing of an arm.
class LinearSubject final : public Subject {
 public:
  LinearSubject() {
    units_.order.resize(kRows);
    std::iota(units_.order.begin(), units_.order.end(), 0);
    units_.twin = units_.order;
    units_.session.assign(kRows, 0);
    units_.point.assign(kRows, -1);
    RandomStream random(7);
    at_.misfit.resize(kRows);
    for (double& value : at_.misfit) value = random.normal();
    at_.base = Eigen::VectorXd::Ones(kRows);
    at_.unit = units_.order;
    at_.noise_rows = kRows;
  }

  /// A form whose parameters do `columns`.
  void add(const std::string& effect, const Eigen::MatrixXd& columns, bool probe = false) {
    forms_.push_back({effect, -1, effect, effect, 1.0});
    forms_.back().probe = probe;
    columns_.push_back(columns);
  }
  Eigen::VectorXd& data() { return at_.misfit; }
  void set_base(const Eigen::VectorXd& column) { at_.base = column; }

  const Units& units() const override { return units_; }
  const std::vector<Form>& forms() const override { return forms_; }
  const std::vector<std::vector<int>>& scans() const override { return scans_; }
  const std::vector<NoiseForm>& noise_forms() const override { return noise_forms_; }
  std::vector<int> finer(int) override { return {}; }
  std::vector<Eigen::MatrixXd> columns(std::span<const int> forms) const override {
    std::vector<Eigen::MatrixXd> out;
    for (const int form : forms) out.push_back(columns_[static_cast<std::size_t>(form)]);
    return out;
  }
  const Linearization& linearization() const override { return at_; }
  void settle(const std::vector<int>&) override {}
  std::shared_ptr<const Place> place() const override { return std::make_shared<Place>(); }
  void return_to(const Place&) override {}
  void set_trust(const Eigen::VectorXd&) override {}
  void set_noise_forms(const Eigen::VectorXd&) override {}
  double noise() const override { return 1e-3; }

 private:
  Units units_;
  Linearization at_;
  std::vector<Form> forms_;
  std::vector<Eigen::MatrixXd> columns_;
  std::vector<std::vector<int>> scans_;
  std::vector<NoiseForm> noise_forms_;
};

Eigen::VectorXd in_block(Index block, double size) {
  Eigen::VectorXd column = Eigen::VectorXd::Zero(kRows);
  column.segment(block * kOfBlock, kOfBlock).setConstant(size);
  return column;
}

Eigen::VectorXd swing(std::uint64_t seed, double size) {
  Eigen::VectorXd column(kRows);
  RandomStream random(seed);
  for (double& value : column) value = size * random.normal();
  return column;
}

using Words = std::vector<std::string>;

Words words_of(const LinearSubject& subject, const std::vector<Chosen>& chosen) {
  Words words;
  for (const Chosen& one : chosen) words.push_back(subject.forms()[one.form].effect);
  return words;
}

TEST(Examine, WhatARefutedNameStoodForIsLeftOver) {
  LinearSubject subject;
  Eigen::VectorXd base = Eigen::VectorXd::Ones(kRows);
  base.segment(5 * kOfBlock, kOfBlock).setZero();
  subject.set_base(base);
  // No other block knows of it: what is held out there cannot be foretold.
  subject.add("bump", in_block(5, 10.0));
  subject.add("somewhere", in_block(5, 10.0), true);
  subject.data() += in_block(5, 8.0);
  const Examination found = examine(subject, {1, 10}, {});
  EXPECT_TRUE(found.names.empty());
  EXPECT_EQ(words_of(subject, found.probes), Words{"somewhere"});
  EXPECT_GT(found.left_over, 0.9 * 20 * 64.0);
}

TEST(Examine, ANameThatForetellsBadlyGoesByItself) {
  LinearSubject subject;
  const Eigen::VectorXd one = swing(1, 20.0), other = swing(2, 20.0);
  subject.add("one", one);
  subject.add("other", other);
  // What block 0 tells of it is little, and wrong for block 5: it is foretold far off there, as is
  // to be expected, and outweighs in squares what the other two gain.
  const Eigen::VectorXd faint = in_block(0, 0.7), strong = in_block(5, 220.0);
  subject.add("spoiler", faint + strong);
  subject.data() += 0.2 * one + 0.2 * other + 0.1 * strong - 2.0 * faint;
  const Examination found = examine(subject, {1, 10}, {});
  EXPECT_EQ(words_of(subject, found.names), (Words{"one", "other"}));
}

/// What is there, by a probe; and a name that is the nearest thing to it, beside `others` that are
/// there as well.
Examination nearest_thing_beside(LinearSubject& subject, int others) {
  const Eigen::VectorXd truth = swing(1, 20.0);
  subject.add("nearest", truth + swing(2, 8.0));
  subject.add("truth", truth, true);
  subject.data() += 0.1 * truth;
  for (int i = 0; i < others; ++i) {
    const Eigen::VectorXd other = swing(10 + static_cast<std::uint64_t>(i), 20.0);
    subject.add("other " + std::to_string(i), other);
    subject.data() += 0.1 * other;
  }
  return examine(subject, {1, 10}, {});
}

TEST(Examine, ANameGivesWayToStructureThatItWasOnlyNearTo) {
  LinearSubject subject;
  const Examination found = nearest_thing_beside(subject, 2);
  EXPECT_EQ(words_of(subject, found.names), (Words{"other 0", "other 1"}));
  EXPECT_EQ(words_of(subject, found.probes), Words{"truth"});
}

TEST(Examine, AmongManyNamesStructureIsToldBeside) {
  LinearSubject subject;
  const Examination found = nearest_thing_beside(subject, 6);
  EXPECT_EQ(found.names.size(), 7u);
  EXPECT_EQ(words_of(subject, found.names).front(), "nearest");
  ASSERT_EQ(words_of(subject, found.probes), Words{"truth"});
  EXPECT_LT(found.probes[0].p, kBeyondNoise);
  EXPECT_GT(found.left_over, 0.0);
}

TEST(Examine, StructureThatForetellsNothingTakesNoNamesPlace) {
  LinearSubject subject;
  const Eigen::VectorXd name = swing(1, 20.0);
  subject.add("name", name);
  // In each block another strength of the name: what it holds, and what no block tells of another.
  Eigen::MatrixXd by_block = Eigen::MatrixXd::Zero(kRows, kRows / kOfBlock);
  for (Index b = 0; b < by_block.cols(); ++b) {
    const auto rows = Eigen::seqN(b * kOfBlock, kOfBlock);
    by_block(rows, b) = name(rows);
    subject.data()(rows) += (b % 2 == 0 ? 0.17 : 0.11) * name(rows);
  }
  subject.add("by block", by_block, true);
  const Examination found = examine(subject, {1, 10}, {});
  EXPECT_EQ(words_of(subject, found.names), Words{"name"});
  ASSERT_EQ(words_of(subject, found.probes), Words{"by block"});
  EXPECT_EQ(found.probes[0].width, kRows / kOfBlock - 1);
  EXPECT_LT(found.probes[0].p, kBeyondNoise);
}

}  // namespace
}  // namespace bathyal
