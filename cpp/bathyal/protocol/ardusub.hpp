// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "bathyal/geometry/pose.hpp"

namespace bathyal {

// ArduPilot's JSON interface to a simulator: its servo outputs come as a packet of UDP, the state
// goes back as a line of JSON.

struct ServoPacket {
  std::uint16_t rate = 0;             ///< of frames, asked for [Hz]
  std::uint32_t frame = 0;            ///< its number
  std::vector<std::uint16_t> pulses;  ///< 16 or 32 [µs]
};

/// \throw Error for bytes of another length or magic number (18458: 16 channels, 29569: 32)
ServoPacket read_servo_packet(std::string_view bytes);

/// The packet's bytes, as the autopilot sends them. \throw std::invalid_argument unless 16 or 32
std::string servo_packet(const ServoPacket& packet);

/// −1 to 1 of a pulse of 1 100 to 1 900 µs; 0 where there is none (0 µs).
double command_of_pulse(std::uint16_t pulse);

/// What the autopilot receives. Axes ahead, starboard, down; north, east, down.
struct ArduPilotState {
  double time = 0.0;               ///< [s]
  Vec3 gyro = Vec3::Zero();        ///< [rad/s]
  Vec3 force = Vec3::Zero();       ///< specific, "accel_body" [m/s²]
  Vec3 position = Vec3::Zero();    ///< [m]
  Vec3 attitude = Vec3::Zero();    ///< roll, pitch, yaw [rad]
  Vec3 velocity = Vec3::Zero();    ///< [m/s]
  std::optional<double> altitude;  ///< "rng_1" [m]
};

/// A line of JSON, between line ends. \throw std::invalid_argument unless all numbers are finite
std::string ardupilot_json(const ArduPilotState& state);

}  // namespace bathyal
