// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/mission/mission_log.hpp"

#include <array>
#include <charconv>
#include <cmath>
#include <span>
#include <utility>

#include "bathyal/mission/archive.hpp"

namespace bathyal {

template <class A>
void archive(A& a, McapSchema& s) {
  a(s.name, s.encoding, s.data);
}
template <class A>
void archive(A& a, McapChannel& s) {
  a(s.schema, s.topic, s.encoding);
}
template <class A, class First, class Second>
void archive(A& a, std::pair<First, Second>& s) {
  a(s.first, s.second);
}
template <class A>
void archive(A& a, McapChunk& s) {
  a(s.start, s.length, s.first, s.last, s.size, s.index_length, s.index_offsets);
}
template <class A>
void archive(A& a, McapWriterState& s) {
  a(s.written, s.pending, s.first, s.last, s.index, s.schemas, s.channels, s.counts, s.sequence,
    s.chunks, s.earliest, s.latest);
}
template <class A>
void archive(A& a, MissionEvent& s) {
  a(s.time, s.kind, s.text);
}

namespace {

constexpr std::uint16_t kTruth = 1, kEstimate = 2, kState = 3, kThrusters = 4, kEvents = 5,
                        kInputs = 6;

constexpr const char* kTime =
    R"("timestamp":{"type":"object","properties":{"sec":{"type":"integer"},"nsec":{"type":"integer"}}})";
constexpr const char* kNumber = R"({"type":"number"})";
constexpr const char* kNumbers = R"({"type":"array","items":{"type":"number"}})";

std::string vector_schema(std::string_view axes) {
  std::string text = R"({"type":"object","properties":{)";
  for (std::size_t i = 0; i < axes.size(); ++i) {
    if (i > 0) text += ',';
    text.append("\"").append(1, axes[i]).append("\":").append(kNumber);
  }
  return text.append("}}");
}

std::string schema(const std::string& properties) {
  std::string text = R"({"type":"object","properties":{)";
  return text.append(kTime).append(",").append(properties).append("}}");
}

std::uint64_t nanoseconds(double time) {
  return static_cast<std::uint64_t>(std::llround(std::max(0.0, time) * 1e9));
}

/// JSON, piece by piece; numbers as short as they come back the same, those that are none as null.
class Json {
 public:
  explicit Json(std::string& text) : text_(text) { text_.clear(); }

  Json& raw(std::string_view piece) {
    text_.append(piece);
    return *this;
  }
  Json& number(double value) {
    if (!std::isfinite(value)) return raw("null");
    std::array<char, 32> digits{};
    const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), value).ptr;
    return raw({digits.data(), static_cast<std::size_t>(end - digits.data())});
  }
  Json& whole(std::uint64_t value) {
    std::array<char, 24> digits{};
    const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), value).ptr;
    return raw({digits.data(), static_cast<std::size_t>(end - digits.data())});
  }
  Json& numbers(std::span<const double> values) {
    raw("[");
    for (std::size_t i = 0; i < values.size(); ++i) {
      if (i > 0) raw(",");
      number(values[i]);
    }
    return raw("]");
  }
  Json& text(std::string_view value) {
    constexpr std::string_view kHex = "0123456789abcdef";
    raw("\"");
    for (const char c : value) {
      const auto code = static_cast<unsigned char>(c);
      if (c == '"' || c == '\\') {
        raw("\\").raw({&c, 1});
      } else if (code < 0x20) {
        raw("\\u00").raw(kHex.substr(code >> 4U, 1)).raw(kHex.substr(code & 15U, 1));
      } else {
        raw({&c, 1});
      }
    }
    return raw("\"");
  }
  Json& time(std::uint64_t nanos) {
    raw(R"({"timestamp":{"sec":)").whole(nanos / 1'000'000'000U);
    return raw(R"(,"nsec":)").whole(nanos % 1'000'000'000U).raw("}");
  }
  Json& field(std::string_view name) { return raw(",\"").raw(name).raw("\":"); }
  Json& vector(std::string_view axes, std::span<const double> values) {
    for (std::size_t i = 0; i < axes.size(); ++i) {
      raw(i == 0 ? "{\"" : ",\"").raw(axes.substr(i, 1)).raw("\":").number(values[i]);
    }
    return raw("}");
  }

 private:
  std::string& text_;
};

void put_pose(Json& json, const Pose& pose) {
  const Vec3 place = pose.translation();
  const Eigen::Vector4d turn = Eigen::Quaterniond(pose.linear()).coeffs();
  json.field("frame_id").text("world").field("pose").raw(R"({"position":)");
  json.vector("xyz", {place.data(), 3}).field("orientation").vector("xyzw", {turn.data(), 4});
  json.raw("}}");
}

}  // namespace

MissionLog::MissionLog(const std::string& path, const MissionPlan& plan) {
  writer_.emplace(path);
  std::string pose = R"("frame_id":{"type":"string"},"pose":{"type":"object","properties":{)";
  pose.append("\"position\":").append(vector_schema("xyz"));
  pose.append(",\"orientation\":").append(vector_schema("xyzw")).append("}}");
  std::string state(R"("number":{"type":"integer"},)");
  for (const char* name : {"elapsed", "depth", "altitude", "voltage", "current", "charge",
                           "position_std", "target_x", "target_y", "target_z"}) {
    state.append("\"").append(name).append("\":").append(kNumber).append(",");
  }
  state.append("\"velocity\":").append(kNumbers);
  std::string thrusters("\"command\":");
  thrusters.append(kNumbers).append(",\"speed\":").append(kNumbers);
  std::string reading(R"("kind":{"type":"string"},"index":{"type":"integer"},"sampled":)");
  reading.append(kNumber)
      .append(",\"arrival\":")
      .append(kNumber)
      .append(R"(,"valid":{"type":"boolean"},"values":)")
      .append(kNumbers);
  const std::string log =
      R"("level":{"type":"integer"},"message":{"type":"string"},"name":{"type":"string"})";
  std::string inputs(R"("number":{"type":"integer"},"stop":{"type":"boolean"})");
  for (const char* name : {"wrench", "thrusters", "fins"}) {
    inputs.append(",\"").append(name).append("\":").append(kNumbers);
  }
  const auto add = [this](const char* name, const std::string& properties) {
    return writer_->add_schema({name, "jsonschema", schema(properties)});
  };
  const auto of_pose = add("foxglove.PoseInFrame", pose), of_state = add("bathyal.State", state);
  const auto of_thrusters = add("bathyal.Thrusters", thrusters);
  const auto of_log = add("foxglove.Log", log), of_reading = add("bathyal.Reading", reading);
  const auto of_inputs = add("bathyal.Inputs", inputs);
  writer_->add_channel({of_pose, "/truth", "json"});
  writer_->add_channel({of_pose, "/estimate", "json"});
  writer_->add_channel({of_state, "/state", "json"});
  writer_->add_channel({of_thrusters, "/thrusters", "json"});
  writer_->add_channel({of_log, "/events", "json"});
  writer_->add_channel({of_inputs, "/inputs", "json"});
  for (const SensorOptions& sensor : plan.sensors) {
    std::string topic("/sensors/");
    writer_->add_channel({of_reading, topic.append(sensor.name), "json"});
  }
  name_channels(plan);
}

MissionLog::MissionLog(const std::string& path, const MissionPlan& plan, const std::string& saved) {
  ByteReader reader(saved);
  McapWriterState state;
  reader(state, events_);
  writer_.emplace(path, std::move(state));
  name_channels(plan);
}

void MissionLog::name_channels(const MissionPlan& plan) {
  auto next = static_cast<std::uint16_t>(kInputs + 1);
  for (const SensorOptions& sensor : plan.sensors) sensors_[sensor.name] = next++;
}

std::string MissionLog::save() {
  writer_->sync();
  McapWriterState state = writer_->state();
  ByteWriter bytes;
  bytes(state, events_);
  return bytes.take();
}

void MissionLog::tick(const MissionTick& tick) {
  const std::uint64_t time = nanoseconds(tick.time);
  const VehicleState& motion = tick.truth->motion;
  Json truth(text_);
  truth.time(time);
  put_pose(truth, motion.world_from_vehicle);
  writer_->write(kTruth, time, text_);
  Json estimate(text_);
  estimate.time(time);
  put_pose(estimate, tick.estimated.world_from_vehicle);
  writer_->write(kEstimate, time, text_);
  Json state(text_);
  state.time(time).field("number").whole(static_cast<std::uint64_t>(tick.number));
  state.field("elapsed").number(tick.time);
  state.field("depth").number(tick.depth).field("altitude").number(tick.altitude);
  state.field("voltage").number(tick.load.voltage).field("current").number(tick.load.current);
  state.field("charge").number(tick.truth->battery.charge);
  state.field("position_std").number(tick.position_std);
  state.field("target_x").number(tick.target.to.x()).field("target_y").number(tick.target.to.y());
  state.field("target_z").number(tick.target.z).field("velocity");
  state.numbers({motion.velocity.data(), 6}).raw("}");
  writer_->write(kState, time, text_);
  Json thrusters(text_);
  thrusters.time(time).field("command").numbers(tick.commands->thrusters).field("speed").raw("[");
  for (std::size_t i = 0; i < tick.truth->thrusters.size(); ++i) {
    if (i > 0) thrusters.raw(",");
    thrusters.number(tick.truth->thrusters[i].speed);
  }
  thrusters.raw("]}");
  writer_->write(kThrusters, time, text_);
}

void MissionLog::reading(const SensorOptions& sensor, const SensorReading& reading) {
  const std::uint64_t time = nanoseconds(reading.time);
  Json json(text_);
  json.time(time).field("kind").text(sensor_kind_name(reading.kind));
  json.field("index").whole(static_cast<std::uint64_t>(reading.index));
  json.field("sampled").number(reading.time).field("arrival").number(reading.arrival);
  json.field("valid").raw(reading.valid ? "true" : "false").field("values");
  json.numbers({reading.values.data(), static_cast<std::size_t>(reading.count)}).raw("}");
  writer_->write(sensors_.at(sensor.name), time, text_);
}

void MissionLog::inputs(double time, std::int64_t number, const LiveInputs& inputs) {
  const std::uint64_t at = nanoseconds(time);
  Json json(text_);
  json.time(at).field("number").whole(static_cast<std::uint64_t>(number));
  json.field("stop").raw(inputs.stop ? "true" : "false");
  json.field("wrench").numbers(inputs.wrench).field("thrusters").numbers(inputs.thrusters);
  json.field("fins").numbers(inputs.fins).raw("}");
  writer_->write(kInputs, at, text_);
}

void MissionLog::event(const MissionEvent& event) {
  constexpr std::uint64_t kInfo = 2, kWarning = 3, kFailure = 4;
  const std::uint64_t time = nanoseconds(event.time);
  const bool grave = event.kind == "guard", warns = event.kind == "fault" || event.kind == "report";
  Json json(text_);
  json.time(time).field("level").whole(grave ? kFailure : warns ? kWarning : kInfo);
  json.field("message").text(event.text).field("name").text(event.kind).raw("}");
  writer_->write(kEvents, time, text_);
  events_.push_back(event);
}

}  // namespace bathyal
