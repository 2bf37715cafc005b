// SPDX-License-Identifier: BSD-3-Clause
// The T200 against its bollard tests, and laws of thrust against their closed forms.
#include "bathyal/vehicle/devices/thruster.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "bathyal/vehicle/device_presets.hpp"
#include "bathyal/vehicle/devices/thruster_fit.hpp"
#include "t200_file.hpp"

namespace bathyal {
namespace {

double of_microseconds(double pulse) { return (pulse - 1500.0) / 400.0; }

class T200 : public testing::Test {
 protected:
  void SetUp() override {
    const auto found = t200_table();
    if (!found) GTEST_SKIP() << "no ../shared/data/thruster/t200_data.csv";
    table_ = *found;
  }
  ThrusterTable table_;
};

TEST_F(T200, HasTheQuadraticLaws) {
  const ThrusterFit fit = fit_thruster(table_);
  EXPECT_NEAR(fit.options.ahead.thrust, 0.01471, 5e-6);
  EXPECT_NEAR(fit.options.astern.thrust, 0.01169, 5e-6);
  EXPECT_NEAR(fit.rms_ahead, 0.60, 0.005);
  EXPECT_NEAR(fit.rms_astern, 0.67, 0.005);
  EXPECT_LT(fit.rms_command, 1.25);
  EXPECT_LT(fit.rms_power, 15.0);
}

TEST_F(T200, ShipsTheFittedLaw) {
  const ThrusterOptions fitted = fit_thruster(table_).options, shipped = t200();
  for (const auto& [a, b] :
       {std::pair(fitted.ahead, shipped.ahead), {fitted.astern, shipped.astern}}) {
    EXPECT_NEAR(a.thrust, b.thrust, 1e-8);
    EXPECT_NEAR(a.speed, b.speed, 1e-5);
    EXPECT_NEAR(a.shape, b.shape, 1e-7);
    EXPECT_NEAR(a.voltage_exponent, b.voltage_exponent, 1e-7);
    EXPECT_NEAR(a.power_cubic, b.power_cubic, 1e-9);
    EXPECT_NEAR(a.power_quartic, b.power_quartic, 1e-11);
  }
  EXPECT_NEAR(fitted.dead_zone, shipped.dead_zone, 1e-9);
}

TEST_F(T200, IsDeadAboutTheMiddle) {
  ThrusterOptions options = t200();
  options.table = std::make_shared<const ThrusterTable>(table_);
  const Thruster thruster(options);
  for (const double pulse : {1472.0, 1500.0, 1528.0}) {
    EXPECT_EQ(thruster.steady(of_microseconds(pulse), 16.0).thrust, 0.0) << pulse;
  }
  EXPECT_LT(thruster.steady(of_microseconds(1468.0), 16.0).thrust, 0.0);
  EXPECT_GT(thruster.steady(of_microseconds(1532.0), 16.0).thrust, 0.0);
}

TEST_F(T200, GivesFullThrustByVoltage) {
  ThrusterOptions options = t200();
  options.table = std::make_shared<const ThrusterTable>(table_);
  const Thruster thruster(options);
  const ThrusterPoint full = thruster.steady(1.0, 16.0);
  EXPECT_NEAR(full.thrust, 51.5, 0.05);
  EXPECT_NEAR(full.power, 381.0, 1.0);
  EXPECT_NEAR(thruster.steady(1.0, 10.0).thrust, 28.7, 0.05);
}

TEST_F(T200, AVoltageLeftOutLiesBetweenItsNeighbours) {
  for (std::size_t out = 1; out + 1 < table_.voltage.size(); ++out) {
    ThrusterTable rest;
    rest.command = table_.command;
    for (std::size_t row = 0; row < table_.voltage.size(); ++row) {
      if (row == out) continue;
      rest.voltage.push_back(table_.voltage[row]);
      for (std::size_t c = 0; c < table_.command.size(); ++c) {
        const ThrusterPoint point = table_.measured(row, c);
        rest.thrust.push_back(point.thrust);
        rest.power.push_back(point.power);
        rest.speed.push_back(point.speed);
      }
    }
    double sum = 0.0;
    for (std::size_t c = 0; c < table_.command.size(); ++c) {
      const double found = rest.at(table_.command[c], table_.voltage[out]).thrust;
      sum += std::pow(found - table_.measured(out, c).thrust, 2);
    }
    EXPECT_LT(std::sqrt(sum / static_cast<double>(table_.command.size())), 0.6)
        << table_.voltage[out];
  }
}

TEST_F(T200, CommandsInvertTheTable) {
  ThrusterOptions options = t200();
  options.table = std::make_shared<const ThrusterTable>(table_);
  const Thruster thruster(options);
  for (const double voltage : {11.0, 16.0}) {
    for (const double thrust : {-20.0, -3.0, 0.0, 2.0, 25.0}) {
      const double command = thruster.command_for(thrust, voltage);
      EXPECT_NEAR(thruster.steady(command, voltage).thrust, thrust, 1e-9) << thrust;
    }
    EXPECT_NEAR(thruster.steady(thruster.command_for(500.0, voltage), voltage).thrust,
                thruster.steady(1.0, voltage).thrust, 0.2);
  }
  EXPECT_EQ(thruster.command_for(0.0, 16.0), 0.0);
}

TEST(Benchmark, PeaksAsPublished) {
  const Thruster thruster(t200_benchmark());
  double most = 0.0;
  for (int k = 0; k <= 1000; ++k) {
    most = std::max(most, thruster.steady(1e-3 * k, 16.0).thrust);
  }
  EXPECT_NEAR(most, 30.6, 0.05);
  EXPECT_NEAR(thruster.steady(1.0, 12.0).thrust, 30.4, 1e-9);
  EXPECT_NEAR(thruster.steady(-0.5, 16.0).thrust, -thruster.steady(0.5, 16.0).thrust, 1e-12);
}

TEST(ThrusterLaw, LagsAsAFirstOrderSystem) {
  ThrusterOptions options = t200();
  options.lag = 0.2;
  const Thruster thruster(options);
  const ThrusterDrive drive = thruster.drive(1.0, 16.0);
  EXPECT_NEAR(thruster.advanced({0.0}, drive, 0.2).speed, drive.speed * (1.0 - std::exp(-1.0)),
              1e-12);
  ThrusterState halves{0.0};
  for (int k = 0; k < 2; ++k) halves = thruster.advanced(halves, drive, 0.1);
  EXPECT_NEAR(halves.speed, thruster.advanced({0.0}, drive, 0.2).speed, 1e-12);
}

TEST(ThrusterLaw, CommandsInvertTheLaw) {
  const Thruster thruster(t200());
  for (const double voltage : {10.0, 14.0, 20.0}) {
    for (const double thrust : {-21.0, -0.01, 0.3, 28.0}) {
      const double command = thruster.command_for(thrust, voltage);
      EXPECT_NEAR(thruster.steady(command, voltage).thrust, thrust, 1e-10) << thrust;
    }
    EXPECT_EQ(thruster.command_for(1e3, voltage), 1.0);
    EXPECT_EQ(thruster.command_for(-1e3, voltage), -1.0);
  }
}

TEST(ThrusterLaw, FollowsTheAdvanceRatio) {
  ThrusterOptions options;
  options.ahead.speed = options.astern.speed = 20.0;
  set_propeller(options, 0.14, {0.4, -0.45}, {0.05, -0.06}, 1000.0);
  const Thruster thruster(options);
  const double n = 18.0, met = 1.2, advance = met / (n * 0.14);
  EXPECT_NEAR(thruster.thrust(n, {}, met),
              1000 * n * n * std::pow(0.14, 4) * (0.4 - 0.45 * advance), 1e-9);
  EXPECT_NEAR(thruster.torque(n, met), 1000 * n * n * std::pow(0.14, 5) * (0.05 - 0.06 * advance),
              1e-9);
  EXPECT_NEAR(thruster.thrust(-n, {}, -met), -thruster.thrust(n, {}, met), 1e-12);
  Vec6 moving = Vec6::Zero();
  moving[0] = met;
  EXPECT_NEAR(thruster.wrench(n, {}, moving)[0], thruster.thrust(n, {}, met), 1e-12);
  EXPECT_NEAR(thruster.wrench(n, {}, moving)[3], -thruster.torque(n, met), 1e-12);
  EXPECT_THROW(set_propeller(options, 0.0, {0.4, 0}, {0, 0}, 1000.0), std::invalid_argument);
  EXPECT_THROW(set_propeller(options, 0.1, {0.4, 0.1}, {0, 0}, 1000.0), std::invalid_argument);
}

TEST(ThrusterLaw, ActsAtItsPlace) {
  ThrusterOptions options = t200();
  options.position = Vec3(0.1, -0.2, 0.3);
  options.direction = Vec3(0.0, 0.0, 2.0);
  const Thruster thruster(options);
  const ThrusterPoint full = thruster.steady(1.0, 16.0);
  const Vec6 wrench = thruster.wrench(full.speed, {}, Vec6::Zero());
  EXPECT_NEAR(wrench[2], full.thrust, 1e-9);
  EXPECT_NEAR(wrench[3], -0.2 * full.thrust, 1e-9);
  EXPECT_NEAR(wrench[4], -0.1 * full.thrust, 1e-9);
  EXPECT_LT((thruster.column() * full.thrust - wrench).norm(), 1e-9);
}

TEST(ThrusterLaw, BadInput) {
  const auto refused = [](auto change) {
    ThrusterOptions bad = t200();
    change(bad);
    EXPECT_THROW(Thruster{bad}, std::invalid_argument);
  };
  refused([](ThrusterOptions& o) { o.direction.setZero(); });
  refused([](ThrusterOptions& o) { o.position.x() = std::nan(""); });
  refused([](ThrusterOptions& o) { o.ahead.thrust = -1.0; });
  refused([](ThrusterOptions& o) { o.astern.shape = 0.0; });
  refused([](ThrusterOptions& o) { o.spin = 0; });
  refused([](ThrusterOptions& o) { o.dead_zone = 1.0; });
  refused([](ThrusterOptions& o) { o.lag = -0.1; });
  const auto table = [](auto change) {
    ThrusterTable bad{{-1, 0, 1}, {16}, {-1, 0, 1}, {2, 0, 2}, {-3, 0, 3}};
    EXPECT_NO_THROW(bad.check());
    change(bad);
    EXPECT_THROW(bad.check(), std::invalid_argument);
    EXPECT_THROW(fit_thruster(bad), std::invalid_argument);
  };
  table([](ThrusterTable& t) { t.command[1] = -1.0; });
  table([](ThrusterTable& t) { t.command[2] = 1.5; });
  table([](ThrusterTable& t) { t.voltage.clear(); });
  table([](ThrusterTable& t) { t.thrust.pop_back(); });
  table([](ThrusterTable& t) { t.power[0] = -1.0; });
  table([](ThrusterTable& t) { t.speed[0] = std::nan(""); });
}

}  // namespace
}  // namespace bathyal
