// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <optional>
#include <string>

#include "bathyal/log/mcap.hpp"
#include "bathyal/mission/run.hpp"

namespace bathyal {

/// A run's log as MCAP with JSON messages: /truth and /estimate (foxglove.PoseInFrame), /state,
/// /thrusters, /sensors/NAME, /events (foxglove.Log), and /inputs from outside, tick by
/// tick. Times count from 0 at the start.
class MissionLog final : public MissionSink {
 public:
  MissionLog(const std::string& path, const MissionPlan& plan);

  /// Goes on where `saved` was taken.
  MissionLog(const std::string& path, const MissionPlan& plan, const std::string& saved);

  void tick(const MissionTick& tick) override;
  void reading(const SensorOptions& sensor, const SensorReading& reading) override;
  void event(const MissionEvent& event) override;
  void inputs(double time, std::int64_t number, const LiveInputs& inputs) override;

  /// What a new one goes on from; the file is flushed.
  std::string save();
  void close() { writer_->close(); }

  const std::vector<MissionEvent>& events() const { return events_; }

 private:
  void name_channels(const MissionPlan& plan);

  std::optional<McapWriter> writer_;
  std::map<std::string, std::uint16_t> sensors_;
  std::vector<MissionEvent> events_;
  std::string text_;
};

}  // namespace bathyal
