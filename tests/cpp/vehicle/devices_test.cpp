// SPDX-License-Identifier: BSD-3-Clause
// Battery, fin, ballast and tether against closed forms.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <stdexcept>

#include "bathyal/vehicle/device_presets.hpp"

namespace bathyal {
namespace {

TEST(BatteryTest, VoltageAndCurrentAgree) {
  const Battery battery(lithium_ion_4s());
  const auto drawn = [](double voltage) { return 30.0 + 0.9 * std::pow(voltage, 2.4); };
  const BatteryLoad load = battery.solve({0.7}, drawn);
  EXPECT_FALSE(load.collapsed);
  EXPECT_NEAR(load.voltage * load.current, drawn(load.voltage), 1e-8);
  EXPECT_NEAR(load.voltage, battery.open_circuit(0.7) - 0.05 * load.current, 1e-10);
  EXPECT_DOUBLE_EQ(battery.solve({1.0}, [](double) { return 0.0; }).voltage, 16.8);
}

TEST(BatteryTest, ConstantPowerHasAClosedForm) {
  const Battery battery(lithium_ion_4s());
  const double power = 800.0, source = 16.8;
  const BatteryLoad load = battery.solve({1.0}, [&](double) { return power; });
  EXPECT_NEAR(load.voltage, 0.5 * (source + std::sqrt(source * source - 0.2 * power)), 1e-10);
}

TEST(BatteryTest, CollapsesBeyondItsMostPower) {
  const Battery battery(lithium_ion_4s());
  const double most = 16.8 * 16.8 / 0.2;
  const auto load = [&](double power) {
    return battery.solve({1.0}, [&](double) { return power; });
  };
  EXPECT_FALSE(load(0.999 * most).collapsed);
  const BatteryLoad over = load(1.01 * most);
  EXPECT_TRUE(over.collapsed);
  EXPECT_DOUBLE_EQ(over.voltage * over.current, most);
}

TEST(BatteryTest, DrainsByItsCurrent) {
  const Battery battery(lithium_ion_4s());
  EXPECT_NEAR(battery.drained({1.0}, 9.0, 3600.0).charge, 0.5, 1e-12);
  EXPECT_EQ(battery.drained({0.1}, 18.0, 3600.0).charge, 0.0);
  EXPECT_EQ(battery.solve({0.0}, [](double) { return 1.0; }).voltage, 0.0);
}

TEST(BatteryTest, BadInput) {
  const auto refused = [](auto change) {
    BatteryOptions bad = lithium_ion_4s();
    change(bad);
    EXPECT_THROW(Battery{bad}, std::invalid_argument);
  };
  refused([](BatteryOptions& o) { o.capacity = 0.0; });
  refused([](BatteryOptions& o) { o.resistance = -1.0; });
  refused([](BatteryOptions& o) { o.charge.back() = 0.9; });
  refused([](BatteryOptions& o) { o.voltage.pop_back(); });
  refused([](BatteryOptions& o) { o.voltage[3] = 0.0; });
  refused([](BatteryOptions& o) { o.charge[1] = o.charge[2]; });
  refused([](BatteryOptions& o) { o.charge = {0.0}, o.voltage = {1.0}; });
}

FinOptions wing() {
  FinOptions fin;
  fin.position = Vec3(-0.638, 0.0, 0.0);
  fin.area = 2.0 * 9.64 / (1025.0 * 3.12);
  fin.lift_slope = 3.12;
  fin.shaft = -Vec3::UnitZ();
  return fin;
}

TEST(FinTest, AWingAsThePublishedRudder) {
  const VehicleSystem remus(remus100_system());
  const Fin fin(wing());
  Vec6 ahead = Vec6::Zero();
  ahead[0] = 1.5;
  const Vec6 found = fin.wrench(0.05, ahead), expected = remus.fins()[0].wrench(0.05, ahead);
  EXPECT_NEAR(found[1], expected[1], 1e-3 * std::abs(expected[1]));
  EXPECT_NEAR(found[5], expected[5], 1e-3 * std::abs(expected[5]));
}

TEST(FinTest, MeetsTheWaterAtItsPlace) {
  const Fin fin(wing());
  Vec6 turning = Vec6::Zero();
  turning[0] = 1.5;
  turning[5] = 0.2;  // to port: the stern goes to starboard, and meets water from there
  const Vec6 damped = fin.wrench(0.0, turning);
  EXPECT_LT(damped[5], 0.0);
  EXPECT_NEAR(fin.wrench(std::atan2(0.638 * 0.2, 1.5), turning)[5], 0.0, 1e-9);
}

TEST(FinTest, Stalls) {
  const Fin fin(wing());
  EXPECT_NEAR(fin.coefficients(0.1).first, 0.312, 1e-5);
  const double peak = fin.coefficients(0.32).first;
  EXPECT_LT(fin.coefficients(0.5).first, peak);
  EXPECT_NEAR(fin.coefficients(0.25 * std::numbers::pi).first, std::sqrt(0.5), 1e-12);
  EXPECT_NEAR(fin.coefficients(0.5 * std::numbers::pi).second, 2.0, 1e-12);
  EXPECT_NEAR(fin.coefficients(-0.5).first, -fin.coefficients(0.5).first, 1e-12);
  for (const double attack : {-3.1, -1.0, 0.0, 0.4, 2.5}) {
    EXPECT_GE(fin.coefficients(attack).second, 0.0) << attack;
  }
}

TEST(FinTest, LagsWithinItsRateAndLimit) {
  FinOptions options = wing();
  options.limit = 0.3;
  options.rate = 0.5;
  options.lag = 0.1;
  const Fin fin(options);
  EXPECT_NEAR(fin.advanced({0.0}, 1.0, 0.01).angle, 0.005, 1e-12);
  EXPECT_NEAR(fin.advanced({0.29}, 1.0, 0.1).angle, 0.3 - 0.01 * std::exp(-1.0), 1e-12);
  FinState state;
  for (int k = 0; k < 1000; ++k) state = fin.advanced(state, -1.0, 0.01);
  EXPECT_NEAR(state.angle, -0.3, 1e-9);
}

TEST(FinTest, BadInput) {
  const auto refused = [](auto change) {
    FinOptions bad = wing();
    change(bad);
    EXPECT_THROW(Fin{bad}, std::invalid_argument);
  };
  refused([](FinOptions& o) { o.shaft = o.forward; });
  refused([](FinOptions& o) { o.area = -1.0; });
  refused([](FinOptions& o) { o.stall = 0.0; });
  refused([](FinOptions& o) { o.limit = std::nan(""); });
  refused([](FinOptions& o) { o.published[2] = HUGE_VAL; });
}

TEST(DropWeightTest, IsGoneOnceReleased) {
  DropWeightOptions weight;
  weight.mass = 2.0;
  weight.volume = 1e-4;
  weight.position = Vec3(0.5, 0.0, -0.1);
  const VehicleOptions rov = bluerov2_heavy_system().vehicle;
  const double size = (2.0 - 1025.0 * 1e-4) * 9.82;
  const Vec6 held = drop_weight_wrench(weight, {0}, rov, Pose::Identity());
  EXPECT_NEAR(held[2], -size, 1e-12);
  EXPECT_NEAR(held[4], 0.5 * size, 1e-12);  // bow down
  EXPECT_EQ(drop_weight_wrench(weight, {1}, rov, Pose::Identity()).norm(), 0.0);
}

TEST(Tether, HangsAsTheInextensibleCatenary) {
  // ends level, 60 m apart, 80 m long: H from sinh(w x / 2H) = w L / 2H
  const double weight = 0.8, length = 80.0, span = 60.0;
  double low = 1.0, high = 200.0;
  for (int k = 0; k < 200; ++k) {
    const double h = 0.5 * (low + high);
    (2.0 * h * std::sinh(0.5 * weight * span / h) > weight * length ? low : high) = h;
  }
  const Vec3 force = catenary_force({span, 0, 0}, {0, 0, -weight}, length, 1e9);
  EXPECT_NEAR(force.x(), -low, 1e-4);
  EXPECT_NEAR(force.z(), -0.5 * weight * length, 1e-4);
}

TEST(Tether, PullsTautAsASpringAndHangsStraightDown) {
  const Vec3 taut = catenary_force({10.1, 0, 0}, {0, 0, -1e-3}, 10.0, 1e5);
  EXPECT_NEAR(taut.x(), -1000.0, 1.0);
  // below its anchor by less than its length: it carries what hangs on its own half
  const Vec3 loose = catenary_force({0, 0, -6.0}, {0, 0, -2.0}, 10.0, 1e9);
  EXPECT_NEAR(loose.z(), -2.0 * 2.0, 0.01);
  EXPECT_EQ(catenary_force({3, 0, 0}, Vec3::Zero(), 10.0, 1e5).norm(), 0.0);
  EXPECT_NEAR(catenary_force({0, 11, 0}, Vec3::Zero(), 10.0, 1e5).y(), -1e4, 1e-6);
}

TEST(Tether, IsDraggedByTheCurrent) {
  TetherOptions tether;
  tether.length = 50.0;
  tether.weight = 0.0;
  tether.diameter = 0.01;
  Pose pose = Pose::Identity();
  pose.translation() = Vec3(0, 0, -48.0);
  const Vec6 wrench = tether_wrench(tether, pose, Vec3(0.5, 0, 0));
  const double drag = 0.5 * 1025.0 * 1.2 * 0.01 * 0.25 * 48.0;
  EXPECT_NEAR(wrench[0], 0.5 * drag, 1e-3 * drag);  // half of it at each end
  EXPECT_GT(wrench[2], 0.0);
  EXPECT_THROW(([&] {
                 TetherOptions bad = tether;
                 bad.length = 0.0;
                 bad.check();
               }()),
               std::invalid_argument);
}

}  // namespace
}  // namespace bathyal
