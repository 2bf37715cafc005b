// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/protocol/ardusub.hpp"

#include <algorithm>
#include <cmath>

#include "bathyal/base/error.hpp"
#include "bathyal/protocol/nmea.hpp"

namespace bathyal {
namespace {

constexpr std::uint16_t kSixteen = 18458, kThirtyTwo = 29569;  // magic numbers
constexpr std::size_t kHead = 8;
constexpr double kMiddle = 1500.0, kSpan = 400.0;  // of a pulse [µs]

std::uint32_t little_endian(std::string_view bytes, std::size_t at, std::size_t size) {
  std::uint32_t value = 0;
  for (std::size_t i = 0; i < size; ++i) {
    value |= static_cast<std::uint32_t>(static_cast<unsigned char>(bytes[at + i])) << (8 * i);
  }
  return value;
}

void append_little_endian(std::string& bytes, std::uint32_t value, std::size_t size) {
  for (std::size_t i = 0; i < size; ++i) {
    bytes += static_cast<char>((value >> (8 * i)) & 0xffU);
  }
}

void append_vector(std::string& text, const char* name, const Vec3& value) {
  if (!value.allFinite()) throw_argument(name, "finite numbers", "others");
  text.append("\"").append(name).append("\":[");
  for (Eigen::Index i = 0; i < 3; ++i) {
    if (i > 0) text += ',';
    append_number(text, value[i]);
  }
  text += ']';
}

}  // namespace

ServoPacket read_servo_packet(std::string_view bytes) {
  ServoPacket packet;
  const std::uint32_t magic = bytes.size() >= kHead ? little_endian(bytes, 0, 2) : 0;
  const std::size_t count = magic == kSixteen ? 16 : magic == kThirtyTwo ? 32 : 0;
  if (count == 0 || bytes.size() != kHead + 2 * count) {
    std::string text("expected a servo packet of 16 or 32 channels, got ");
    text.append(std::to_string(bytes.size())).append(" bytes that begin with ");
    throw Error(text.append(std::to_string(magic)));
  }
  packet.rate = static_cast<std::uint16_t>(little_endian(bytes, 2, 2));
  packet.frame = little_endian(bytes, 4, 4);
  for (std::size_t i = 0; i < count; ++i) {
    packet.pulses.push_back(static_cast<std::uint16_t>(little_endian(bytes, kHead + 2 * i, 2)));
  }
  return packet;
}

std::string servo_packet(const ServoPacket& packet) {
  const std::size_t count = packet.pulses.size();
  if (count != 16 && count != 32) {
    throw_argument("pulses", "16 or 32", std::to_string(count));
  }
  std::string bytes;
  append_little_endian(bytes, count == 16 ? kSixteen : kThirtyTwo, 2);
  append_little_endian(bytes, packet.rate, 2);
  append_little_endian(bytes, packet.frame, 4);
  for (const std::uint16_t pulse : packet.pulses) append_little_endian(bytes, pulse, 2);
  return bytes;
}

double command_of_pulse(std::uint16_t pulse) {
  if (pulse == 0) return 0.0;
  return std::clamp((static_cast<double>(pulse) - kMiddle) / kSpan, -1.0, 1.0);
}

std::string ardupilot_json(const ArduPilotState& state) {
  if (!std::isfinite(state.time)) throw_argument("time", "a finite number", to_text(state.time));
  std::string text("\n{\"timestamp\":");
  append_number(text, state.time);
  text.append(",\"imu\":{");
  append_vector(text, "gyro", state.gyro);
  text += ',';
  append_vector(text, "accel_body", state.force);
  text.append("},");
  append_vector(text, "position", state.position);
  text += ',';
  append_vector(text, "attitude", state.attitude);
  text += ',';
  append_vector(text, "velocity", state.velocity);
  if (state.altitude && std::isfinite(*state.altitude)) {
    text.append(",\"rng_1\":");
    append_number(text, *state.altitude);
  }
  return text.append("}\n");
}

}  // namespace bathyal
