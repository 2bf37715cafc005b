// SPDX-License-Identifier: BSD-3-Clause
// Whole runs: what a mission does, that it is a pure function, and that it can be resumed anywhere.
#include "bathyal/mission/run.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "bathyal/base/error.hpp"
#include "bathyal/vehicle/device_presets.hpp"

namespace bathyal {
namespace {

SensorOptions sensor(const std::string& name, SensorKind kind, double rate, double noise) {
  SensorOptions options;
  options.name = name;
  options.kind = kind;
  options.rate = rate;
  for (SensorChannel& channel : options.channels) channel.noise = noise;
  return options;
}

TriangleMesh flat_bottom(double z) {
  Points::Matrix corners(4, 3);
  corners << -500, -500, z, 500, -500, z, 500, 500, z, -500, 500, z;
  Triangles::Matrix faces(2, 3);
  faces << 0, 1, 2, 0, 2, 3;
  return {corners, faces};
}

MissionCommand command(CommandKind kind, const std::string& name) {
  MissionCommand made;
  made.kind = kind;
  made.name = name;
  return made;
}

TreeNode leaf(int number) {
  TreeNode node;
  node.leaf = number;
  return node;
}

TreeNode sequence(std::vector<TreeNode> children) {
  TreeNode node;
  node.kind = NodeKind::kSequence;
  node.children = std::move(children);
  return node;
}

/// Dives to 5 m, runs a square, comes up.
MissionPlan square_mission() {
  MissionPlan plan;
  plan.vehicle = bluerov2_heavy_system();
  plan.sensors = {sensor("depth", SensorKind::depth, 10.0, 0.01),
                  sensor("compass", SensorKind::compass, 10.0, 0.005),
                  sensor("imu", SensorKind::imu, 50.0, 0.002),
                  sensor("dvl", SensorKind::dvl, 5.0, 0.005),
                  sensor("altimeter", SensorKind::altimeter, 5.0, 0.02),
                  sensor("gps", SensorKind::gps, 1.0, 0.5)};
  plan.navigation.initial_position = Vec3(0.1, 0.1, 0.1);
  plan.navigation.log_noise = 0.01;
  plan.navigation.log_walk = 0.02;
  plan.navigation.gyro_noise = 0.002;
  plan.navigation.lag = 2.0;
  WaterOptions water;
  water.surface = 0.0;
  plan.water = Water(water);
  plan.scene = Scene({flat_bottom(-12.0)});
  plan.start.world_from_vehicle = Eigen::Translation3d(0.0, 0.0, -0.5) * Pose::Identity();
  MissionCommand dive = command(CommandKind::kDive, "dive");
  dive.depth = 5.0;
  MissionCommand square = command(CommandKind::kFollow, "square");
  square.points = {Vec3(10, 0, 0), Vec3(10, 10, 0), Vec3(0, 10, 0), Vec3(0, 0, 0)};
  square.depth = 5.0;
  MissionCommand surface = command(CommandKind::kSurface, "surface");
  plan.commands = {dive, square, surface};
  plan.root = sequence({leaf(0), leaf(1), leaf(2)});
  return plan;
}

/// All that a run tells, as text.
class TextSink final : public MissionSink {
 public:
  void tick(const MissionTick& tick) override {
    const VehicleState& truth = tick.truth->motion;
    const Vec3 place = truth.world_from_vehicle.translation();
    track.push_back(place);
    bytes.append(reinterpret_cast<const char*>(place.data()), sizeof(double) * 3);
    bytes.append(reinterpret_cast<const char*>(truth.velocity.data()), sizeof(double) * 6);
  }
  void inputs(double /*time*/, std::int64_t number, const LiveInputs& /*inputs*/) override {
    numbers.push_back(number);
  }
  void reading(const SensorOptions& sensor, const SensorReading& reading) override {
    bytes += sensor.name;
    readings.push_back(sensor.name);
    bytes.append(reinterpret_cast<const char*>(reading.values.data()), sizeof(reading.values));
  }
  void event(const MissionEvent& event) override {
    bytes += event.kind + event.text;
    events.push_back(event);
  }
  bool has(const std::string& kind, const std::string& text) const {
    for (const MissionEvent& event : events) {
      if (event.kind == kind && event.text == text) return true;
    }
    return false;
  }

  std::string bytes;
  std::vector<std::int64_t> numbers;  ///< of ticks with inputs
  std::vector<std::string> readings;  ///< devices', in their order
  std::vector<Vec3> track;
  std::vector<MissionEvent> events;
};

RunStatus finish(MissionRun& run) {
  while (run.step()) {
  }
  return run.state().status;
}

TEST(MissionRun, DivesRunsASquareAndComesUp) {
  TextSink sink;
  MissionRun run(std::make_shared<MissionPlan>(square_mission()), 1, &sink);
  EXPECT_EQ(finish(run), RunStatus::kDone);
  EXPECT_LT(run.time(), 300.0);
  const auto metrics = run.metrics();
  EXPECT_NEAR(metrics.at("deepest"), 5.0, 0.3);
  EXPECT_NEAR(metrics.at("distance"), 50.0, 5.0);
  EXPECT_LT(metrics.at("position_rms"), 0.5);
  EXPECT_GT(metrics.at("least_altitude"), 6.5);
  EXPECT_TRUE(sink.has("command", "square succeeds"));
  double aside = 0.0;  // off the square while it is run
  for (const Vec3& place : sink.track) {
    const double out = std::max({place.x() - 10.0, -place.x(), place.y() - 10.0, -place.y()});
    aside = std::max(aside, out);
  }
  EXPECT_LT(aside, 1.0);
}

TEST(MissionRun, IsAPureFunctionOfItsSeed) {
  const auto plan = std::make_shared<MissionPlan>(square_mission());
  TextSink one, two, other;
  MissionRun first(plan, 7, &one), second(plan, 7, &two), third(plan, 8, &other);
  for (int i = 0; i < 300; ++i) {
    first.step();
    second.step();
    third.step();
  }
  EXPECT_TRUE(one.bytes == two.bytes);
  EXPECT_FALSE(one.bytes == other.bytes);
  EXPECT_TRUE(first.save() == second.save());
}

TEST(MissionRun, ResumesWithTheSameBytes) {
  const auto plan = std::make_shared<MissionPlan>(square_mission());
  TextSink whole;
  MissionRun run(plan, 3, &whole);
  std::vector<std::pair<std::string, std::size_t>> moments;
  do {
    moments.emplace_back(run.save(), whole.bytes.size());
  } while (run.step());
  for (std::size_t k = 0; k < moments.size(); k += moments.size() / 20) {
    TextSink rest;
    MissionRun resumed(plan, 3, &rest);
    resumed.load(moments[k].first);
    finish(resumed);
    EXPECT_TRUE(rest.bytes == whole.bytes.substr(moments[k].second)) << k;
    EXPECT_EQ(resumed.metrics(), run.metrics());
  }
}

TEST(MissionRun, SavedRunsOfAnotherSeedOrCutOnesAreRefused) {
  const auto plan = std::make_shared<MissionPlan>(square_mission());
  MissionRun run(plan, 3, nullptr), other(plan, 4, nullptr);
  run.step();
  const std::string bytes = run.save();
  EXPECT_THROW(other.load(bytes), Error);
  for (std::size_t size = 0; size < bytes.size(); size += 97) {
    EXPECT_ANY_THROW(run.load(bytes.substr(0, size))) << size;
  }
  EXPECT_ANY_THROW(run.load(bytes + "x"));
  for (std::size_t i = 0; i < bytes.size(); i += 131) {
    std::string bent = bytes;
    bent[i] = static_cast<char>(static_cast<unsigned char>(bent[i]) ^ 0x10U);
    EXPECT_THROW(run.load(bent), Error) << i;
  }
}

TEST(MissionRun, TellsWhatTheNextTickTakesIn) {
  TextSink sink;
  MissionRun run(std::make_shared<MissionPlan>(square_mission()), 1, &sink);
  std::vector<std::string> told;
  for (int i = 0; i < 50; ++i) {
    for (const ArrivedReading& found : run.arrived()) told.push_back(found.device);
    run.step();
    EXPECT_EQ(told, sink.readings) << i;
  }
  EXPECT_GT(told.size(), 300U);
}

TEST(MissionRun, InputsAreRecordedByTickAndReplayed) {
  const auto plan = std::make_shared<MissionPlan>(square_mission());
  const auto inputs_at = [](int tick) {
    LiveInputs inputs;
    if (tick >= 20 && tick < 60) inputs.wrench = {0.0, 10.0 + 0.1 * tick, 0.0, 0.0, 0.0, 0.0};
    if (tick == 80) inputs.thrusters.assign(8, 0.3);
    return inputs;
  };
  TextSink pushed, again, alone;
  MissionRun first(plan, 1, &pushed), second(plan, 1, &again), third(plan, 1, &alone);
  for (int i = 0; i < 100; ++i) {
    first.step(inputs_at(i));
    second.step(inputs_at(i));
    third.step();
  }
  EXPECT_EQ(pushed.numbers.size(), 41U);
  EXPECT_EQ(pushed.numbers.back(), 80);
  EXPECT_TRUE(alone.numbers.empty());
  EXPECT_TRUE(pushed.bytes == again.bytes);
  EXPECT_GT((pushed.track.back() - alone.track.back()).norm(), 0.01);
}

TEST(MissionRun, ANewSensorChangesNobodysNoise) {
  MissionPlan more = square_mission();
  more.sensors.push_back(sensor("current", SensorKind::current, 2.0, 0.1));
  TextSink one, two;
  MissionRun first(std::make_shared<MissionPlan>(square_mission()), 5, &one);
  MissionRun second(std::make_shared<MissionPlan>(more), 5, &two);
  for (int i = 0; i < 300; ++i) {
    first.step();
    second.step();
  }
  ASSERT_EQ(one.track.size(), two.track.size());
  for (std::size_t i = 0; i < one.track.size(); ++i) EXPECT_EQ(one.track[i], two.track[i]);
}

TEST(MissionRun, AThrusterThatDiesIsReportedAndTheMissionGoesOn) {
  MissionPlan plan = square_mission();
  MissionFault fault;
  fault.device = plan.vehicle.thrusters[1].name;
  fault.kind = FaultKind::kDead;
  fault.at = 40.0;
  plan.faults = {fault};
  TextSink sink;
  MissionRun run(std::make_shared<MissionPlan>(plan), 1, &sink);
  EXPECT_EQ(finish(run), RunStatus::kDone);
  EXPECT_TRUE(sink.has("fault", fault.device + " dead begins"));
  EXPECT_TRUE(sink.has("report", fault.device + " dead"));
}

TEST(MissionRun, ADirectionThatNoThrusterGivesIsNamed) {
  MissionPlan plan = square_mission();
  for (const std::size_t row : {4U, 5U}) {  // both vertical ones of the bow
    MissionFault fault;
    fault.device = plan.vehicle.thrusters[row].name;
    fault.kind = FaultKind::kDead;
    fault.at = 3.0;
    plan.faults.push_back(fault);
  }
  TextSink sink;
  MissionRun run(std::make_shared<MissionPlan>(plan), 1, &sink);
  for (int i = 0; i < 150; ++i) run.step();
  const std::vector<int> lost = Pilot(VehicleSystem(plan.vehicle), plan.pilot).lost_axes({4, 5});
  ASSERT_EQ(lost.size(), 1U);
  std::string text("no more ");
  EXPECT_TRUE(sink.has("report", text.append(kAxisNames[static_cast<std::size_t>(lost[0])])));
}

/// 5 N on the bottom at 0.6 m ahead of the origin: lifted, and pitched bow up.
MissionPlan pressing_mission() {
  MissionPlan plan = square_mission();
  MissionCommand sample = command(CommandKind::kSample, "sample");
  sample.depth = 5.0;
  Vec6 press = Vec6::Zero();
  press[2] = 5.0;
  press[4] = -3.0;
  sample.wrench_time = {0.0, 1.0, 11.0, 12.0, 20.0};
  sample.wrench = {Vec6::Zero(), press, press, Vec6::Zero(), Vec6::Zero()};
  plan.commands[1] = sample;
  MissionCommand hold = command(CommandKind::kHold, "hold");
  hold.depth = 5.0;
  hold.time = 20.0;
  plan.commands.push_back(hold);
  plan.root = sequence({leaf(0), leaf(3), leaf(1), leaf(2)});
  return plan;
}

TEST(MissionRun, TrimIsHeldWhileASampleIsTaken) {
  TextSink sink;
  MissionRun run(std::make_shared<MissionPlan>(pressing_mission()), 1, &sink);
  double pitch = 0.0, off = 0.0;
  while (run.step()) {
    if (!sink.has("command", "sample starts") || sink.has("command", "sample succeeds")) continue;
    const Pose& pose = run.state().vehicle.motion.world_from_vehicle;
    pitch = std::max(pitch, std::abs(std::asin(pose.linear()(2, 0))));
    off = std::max(off, std::abs(pose.translation().z() + 5.0));
  }
  EXPECT_TRUE(sink.has("command", "sample succeeds"));
  EXPECT_LT(pitch, 5.0 * M_PI / 180.0);
  EXPECT_LT(off, 0.06);
}

TEST(MissionRun, ASampleThatPushesTheVehicleAwayFails) {
  MissionPlan plan = pressing_mission();
  for (Vec6& wrench : plan.commands[1].wrench) wrench[0] = 500.0;
  TextSink sink;
  MissionRun run(std::make_shared<MissionPlan>(plan), 1, &sink);
  EXPECT_EQ(finish(run), RunStatus::kFailed);
  EXPECT_TRUE(sink.has("command", "sample fails"));
}

TEST(MissionRun, AGuardEndsTheMissionAndSurfaces) {
  MissionPlan plan = square_mission();
  const auto signals = mission_signals(plan.vehicle, plan.sensors);
  plan.guards.push_back({"deep", Condition("depth > 3 m", signals), 0.5, leaf(2)});
  TextSink sink;
  MissionRun run(std::make_shared<MissionPlan>(plan), 1, &sink);
  EXPECT_EQ(finish(run), RunStatus::kAborted);
  EXPECT_TRUE(sink.has("command", "dive is interrupted"));
  EXPECT_TRUE(sink.has("guard", "deep: depth > 3 m"));
  EXPECT_LT(run.metrics().at("deepest"), 4.5);
}

TEST(MissionRun, ALeakIsReportedInTheTimeItTakes) {
  MissionPlan plan = square_mission();
  plan.sensors.push_back(sensor("leak", SensorKind::leak, 5.0, 0.001));
  MissionFault fault;
  fault.device = "hull";
  fault.kind = FaultKind::kLeak;
  fault.size = 0.05;
  fault.at = 20.0;
  plan.faults = {fault};
  TextSink sink;
  MissionRun run(std::make_shared<MissionPlan>(plan), 1, &sink);
  for (int i = 0; i < 300; ++i) run.step();
  for (const MissionEvent& event : sink.events) {
    if (event.kind == "report") {
      EXPECT_EQ(event.text, "hull leak");
      EXPECT_NEAR(event.time, 21.1, 0.5);
    }
  }
  EXPECT_TRUE(sink.has("report", "hull leak"));
}

TEST(MissionRun, RunsWithoutFaultsReportNone) {
  for (std::uint64_t seed = 0; seed < 5; ++seed) {
    TextSink sink;
    MissionRun run(std::make_shared<MissionPlan>(square_mission()), seed, &sink);
    finish(run);
    for (const MissionEvent& event : sink.events) EXPECT_NE(event.kind, "report") << event.text;
  }
}

TEST(MissionRun, PlansThatCannotBeRunAreRefused) {
  const auto refused = [](const auto& change) {
    MissionPlan plan = square_mission();
    change(plan);
    EXPECT_THROW(MissionRun(std::make_shared<MissionPlan>(plan), 1, nullptr),
                 std::invalid_argument);
  };
  refused([](MissionPlan& p) { p.sensors.push_back(p.sensors.front()); });
  refused([](MissionPlan& p) { p.root = leaf(9); });
  refused([](MissionPlan& p) { p.step = 0.0; });
  refused([](MissionPlan& p) { p.steps_per_tick = 0; });
  refused([](MissionPlan& p) { p.commands[0].depth = std::nan(""); });
  refused([](MissionPlan& p) { p.commands[1].points.clear(); });
  refused([](MissionPlan& p) { p.faults.push_back({.device = "engine"}); });
  refused(
      [](MissionPlan& p) { p.faults.push_back({.device = "dvl", .kind = FaultKind::kReversed}); });
}

}  // namespace
}  // namespace bathyal
