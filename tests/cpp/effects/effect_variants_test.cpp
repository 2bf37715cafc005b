// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <set>
#include <stdexcept>

#include "support/plain_effects.hpp"

// What the library offers, where it offers nothing, and what it refuses.

namespace bathyal {
namespace {

TEST(Library, HoldsEveryEffectOnceInAFixedOrder) {
  std::vector<std::string> names;
  for (const auto& effect : library_effects()) names.push_back(effect->info().name);
  const std::vector<std::string> expected{
      "joint_harmonic",   "joint_map",       "joint_scale", "joint_coupling", "backlash",
      "joint_compliance", "link_compliance", "payload",     "base_shift",     "base_compliance",
      "tool_slip",        "tool_change",     "thermal",     "drift",          "clock_shift",
      "outliers",         "range_noise",     "quantisation"};
  EXPECT_EQ(names, expected);
}

TEST(Library, SaysOfEachWhatItIs) {
  const std::set<std::string> known{"temperature", "time", "payload", "direction", "session"};
  for (const auto& effect : library_effects()) {
    const EffectInfo info = effect->info();
    EXPECT_FALSE(info.description.empty()) << info.name;
    EXPECT_FALSE(info.formula.empty()) << info.name;
    EXPECT_NE(info.source.find_first_of("12"), std::string::npos) << info.name << ": a year";
    for (const std::string& need : info.needs) EXPECT_TRUE(known.contains(need)) << need;
    for (const EffectInfo::Range& range : info.ranges) {
      EXPECT_LT(range.low, range.high) << info.name;
      EXPECT_FALSE(range.unit.empty()) << info.name;
    }
  }
}

TEST(Library, NamesRangesAfterParametersThatThereAre) {
  const Scene scene(irregular_arm(3));
  for (const auto& effect : library_effects()) {
    const auto variants = effect->variants(scene.data());
    for (const EffectInfo::Range& range : effect->info().ranges) {
      bool found = variants.empty();
      for (const EffectVariant& v : variants) {
        for (const EffectParameter& p : v.parameters) found = found || p.name == range.parameter;
      }
      EXPECT_TRUE(found) << effect->info().name << "." << range.parameter;
    }
  }
}

TEST(Library, ExtrapolatesWhatFollowsFromKnownArguments) {
  const std::set<std::string> expected{"joint_scale",     "joint_coupling", "joint_compliance",
                                       "link_compliance", "payload",        "base_compliance",
                                       "thermal"};
  const Scene scene(irregular_arm(3));
  std::set<std::string> found;
  for (const auto& effect : library_effects()) {
    if (effect->info().extrapolates) found.insert(effect->info().name);
    for (const EffectVariant& v : effect->variants(scene.data()))
      EXPECT_EQ(effect->extrapolates(v), effect->info().extrapolates) << v.effect;
  }
  EXPECT_EQ(found, expected);
}

TEST(Library, DescribesVariantsForPeople) {
  const Scene scene(irregular_arm(3));
  const EffectVariant wave{"joint_harmonic", 1, {{"order", 2.0}}, {}, ""};
  EXPECT_EQ(
      library_effects()[0]->describe(wave, scene.arm).rfind("a wave of order 2 along joint 2", 0),
      0U);
  std::set<std::string> texts;
  for (const auto& effect : library_effects()) {
    for (const EffectVariant& v : effect->variants(scene.data())) {
      const std::string text = effect->describe(v, scene.arm);
      EXPECT_EQ(text.find('_'), std::string::npos) << text;
      texts.insert(text);
    }
  }
  EXPECT_GT(texts.size(), 30U);
}

TEST(Variants, NeedTheirCovariates) {
  Scene bare(irregular_arm(3));
  bare.covariates.clear();
  for (const auto& effect : library_effects()) {
    const EffectInfo info = effect->info();
    if (!info.needs.empty()) {
      EXPECT_TRUE(effect->variants(bare.data()).empty()) << info.name;
    }
    for (const std::string& need : info.needs) {
      Scene missing(irregular_arm(3));
      missing.covariates[need](3, 0) = std::numeric_limits<double>::quiet_NaN();
      EXPECT_TRUE(effect->variants(missing.data()).empty()) << info.name << " without " << need;
      Scene constant(irregular_arm(3));
      constant.covariates[need].setOnes();
      EXPECT_TRUE(effect->variants(constant.data()).empty()) << info.name << " of one " << need;
    }
  }
}

TEST(Variants, LeaveOutJointsThatStandStill) {
  Scene scene(irregular_arm(3));
  scene.q.col(2).setConstant(0.3);
  for (const char* name : {"joint_harmonic", "joint_map", "joint_scale"}) {
    std::set<int> joints;
    for (const EffectVariant& v : variants_of(name, scene.data())) joints.insert(v.joint);
    EXPECT_EQ(joints, (std::set<int>{0, 1, 3})) << name;
  }
  std::set<int> by;
  for (const EffectVariant& v : variants_of("joint_coupling", scene.data())) {
    by.insert(static_cast<int>(v.settings.at("by")));
  }
  EXPECT_EQ(by, (std::set<int>{0, 1, 3})) << "it cannot move another, but be moved";
}

/// No wave up to the last order lies farther than an eighth (beyond 20: a quarter) of one wave over
/// the span from the grid.
TEST(Variants, OrdersLeaveNoWaveBetweenThem) {
  Scene scene(ur10e(), 60);
  scene.q.col(3) *= 0.1;
  for (const int joint : {2, 3}) {
    std::vector<double> orders;
    for (const EffectVariant& v : variants_of("joint_harmonic", scene.data())) {
      if (v.joint == joint) orders.push_back(v.settings.at("order"));
    }
    const double span = scene.q.col(joint).maxCoeff() - scene.q.col(joint).minCoeff();
    const double wave = 2.0 * kPi / span;
    EXPECT_TRUE(std::is_sorted(orders.begin(), orders.end()));
    EXPECT_LT(orders.size(), 1000U);
    for (int k = 1; k <= 12; ++k) {
      EXPECT_TRUE(std::find(orders.begin(), orders.end(), k) != orders.end()) << k;
    }
    EXPECT_GT(orders.back(), 200.0 - wave);
    for (std::size_t i = 1; i < orders.size(); ++i) {
      if (orders[i - 1] < 0.5 * wave) continue;
      const double step = orders[i - 1] < 20.0 ? 0.25 : 0.5;
      EXPECT_LE(orders[i] - orders[i - 1], std::max(0.25, step * wave) + 1e-9);
    }
  }
}

TEST(Variants, SessionsOfFewRowsAreNone) {
  Scene scene(irregular_arm(3));
  scene.covariates["session"].setConstant(1.0);
  scene.covariates["session"](0, 0) = scene.covariates["session"](1, 0) = 5.0;
  EXPECT_TRUE(variants_of("base_shift", scene.data()).empty());
  scene.covariates["session"](2, 0) = 5.0;
  EXPECT_EQ(variants_of("base_shift", scene.data()).size(), 2U);
}

TEST(Variants, SlipsAreThinnedAndNeverPartRowsOfOneTime) {
  Scene scene(irregular_arm(3), 1500);
  EXPECT_LE(variants_of("tool_slip", scene.data()).size(), 400U);
  EXPECT_GE(variants_of("tool_slip", scene.data()).size(), 200U);
  Scene pairs(irregular_arm(3));
  for (Index i = 0; i < 40; ++i) pairs.covariates["time"](i, 0) = static_cast<double>(i / 2);
  for (const EffectVariant& v : variants_of("tool_slip", pairs.data())) {
    EXPECT_EQ(static_cast<int>(v.settings.at("moment")) % 2, 0);
  }
}

TEST(Variants, SlipsBetweenSessionsAreNeverThinned) {
  Scene scene(irregular_arm(3), 1500);
  scene.covariates.erase("time");
  const auto has = [&](double moment) {
    return !variants_where("tool_slip", scene.data(), [&](const EffectVariant& v) {
              return v.settings.at("moment") == moment;
            }).empty();
  };
  EXPECT_TRUE(has(12.0));
  EXPECT_TRUE(has(25.0));
  scene.covariates["session"](1499, 0) = 7.0;  // no moment parts it from the last one
  EXPECT_TRUE(has(12.0));
  EXPECT_FALSE(has(25.0));
  EXPECT_LE(variants_of("tool_slip", scene.data()).size(), 402U);
}

TEST(Variants, TurnsOfTheToolNeedOrientations) {
  const Scene scene(irregular_arm(3));
  for (const char* name : {"tool_slip", "tool_change"}) {
    EXPECT_EQ(effect_named(name)->variants(scene.data(true))[0].parameters.size(), 6U) << name;
    EXPECT_EQ(effect_named(name)->variants(scene.data(false))[0].parameters.size(), 3U) << name;
  }
}

TEST(Variants, WithoutTimesRowsCountAsTheyStand) {
  Scene scene(irregular_arm(3));
  scene.covariates.erase("time");
  const EffectVariant v = variants_of("tool_slip", scene.data()).at(7);
  EXPECT_EQ(v.settings.at("moment"), 10.0);
  const auto perturbations = perturbations_of(*effect_named("tool_slip"), v, scene.data());
  EXPECT_EQ(perturbations[0][0].values.col(0).head(10).sum(), 0.0);
  EXPECT_EQ(perturbations[0][0].values.col(0).tail(30).sum(), 30.0);
}

void expect_refused(const Scene& scene, const std::string& name) {
  try {
    (void)scene.data();
    ADD_FAILURE() << name << " was taken";
  } catch (const std::invalid_argument& refusal) {
    EXPECT_NE(std::string(refusal.what()).find("covariates " + name), std::string::npos)
        << refusal.what();
  }
}

TEST(EffectData, RefusesCovariatesOfAnotherShapeOrSense) {
  const double inf = std::numeric_limits<double>::infinity();
  for (const char* name : {"temperature", "time", "payload", "direction", "gravity", "session"}) {
    Scene scene(irregular_arm(3));
    scene.covariates[name] = RowMatrix::Zero(40, 5);
    expect_refused(scene, name);
    scene.covariates[name] = RowMatrix::Zero(39, scene.covariates[name].cols());
    expect_refused(scene, name);
    Scene endless(irregular_arm(3));
    endless.covariates[name](2, 0) = inf;
    expect_refused(endless, name);
  }
  for (const auto& [name, value] :
       {std::pair{"payload", -1.0}, std::pair{"direction", 0.5}, std::pair{"session", 1.5}}) {
    Scene scene(irregular_arm(3));
    scene.covariates[name](5, 0) = value;
    expect_refused(scene, name);
  }
  Scene other(irregular_arm(3));
  other.covariates["humidity"] = RowMatrix::Zero(40, 2);
  EXPECT_NO_THROW(other.data()) << "names of the user's own are free";
}

TEST(EffectData, OrdersRowsByTime) {
  Scene scene(planar_arm(), 4);
  scene.covariates["time"].col(0) << 5, 2, 9, 2;
  EXPECT_EQ(scene.data().order, (std::vector<int>{1, 3, 0, 2}));
  EXPECT_FALSE(scene.data().has("humidity"));
  scene.covariates.erase("time");
  EXPECT_EQ(scene.data().order, (std::vector<int>{0, 1, 2, 3}));
}

/// A user's effect that returns what it must not.
class Careless final : public Effect {
 public:
  explicit Careless(std::vector<std::vector<Perturbation>> perturbations)
      : perturbations_(std::move(perturbations)) {}
  EffectInfo info() const override { return {"careless", "", "", "", {}, {}}; }
  std::vector<EffectVariant> variants(const EffectData&) const override { return {variant()}; }
  std::vector<std::vector<Perturbation>> perturbations(const EffectVariant&,
                                                       const EffectData&) const override {
    return perturbations_;
  }
  static EffectVariant variant() { return {"careless", -1, {}, {{"size", "1", 1.0}}, "careless"}; }

 private:
  std::vector<std::vector<Perturbation>> perturbations_;
};

TEST(ActionsOf, RefusesWhatTheContractDoesNotAllow) {
  const Scene scene(planar_arm(), 5);
  const EffectData data = scene.data();
  const auto evaluate = [&](std::vector<std::vector<Perturbation>> perturbations) {
    return perturbations_of(Careless(std::move(perturbations)), Careless::variant(), data);
  };
  const RowMatrix one = RowMatrix::Ones(5, 1), six = RowMatrix::Ones(5, 6);
  RowMatrix nan = one;
  nan(3, 0) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_NO_THROW(evaluate({{{PerturbationSite::kJoint, 1, one},
                             {PerturbationSite::kFrame, 3, six},
                             {PerturbationSite::kLength, 0, one}}}));
  EXPECT_THROW(evaluate({}), std::invalid_argument) << "no list";
  EXPECT_THROW(evaluate({{}, {}}), std::invalid_argument) << "two lists of one parameter";
  EXPECT_THROW(evaluate({{{PerturbationSite::kJoint, 1, six}}}), std::invalid_argument)
      << "six for a joint";
  EXPECT_THROW(evaluate({{{PerturbationSite::kFrame, 1, one}}}), std::invalid_argument)
      << "one for a frame";
  EXPECT_THROW(evaluate({{{PerturbationSite::kJoint, 1, one.topRows(4)}}}), std::invalid_argument)
      << "rows";
  EXPECT_THROW(evaluate({{{PerturbationSite::kJoint, 1, nan}}}), std::invalid_argument) << "NaN";
  EXPECT_THROW(evaluate({{{PerturbationSite::kJoint, 2, one}}}), std::invalid_argument)
      << "no such joint";
  EXPECT_THROW(evaluate({{{PerturbationSite::kFrame, 4, six}}}), std::invalid_argument)
      << "no such frame";
  EXPECT_THROW(evaluate({{{PerturbationSite::kJoint, -1, one}}}), std::invalid_argument)
      << "below 0";
}

}  // namespace
}  // namespace bathyal
