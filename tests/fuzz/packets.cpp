// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <cstdlib>

#include "bathyal/base/error.hpp"
#include "bathyal/protocol/ardusub.hpp"
#include "bathyal/protocol/pd6.hpp"

// A datagram is a servo packet that comes back as the same bytes, or an Error; a line is a part of
// an ensemble of finite numbers, or an Error.
extern "C" int LLVMFuzzerTestOneInput(const unsigned char* data, std::size_t size) {
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  try {
    const bathyal::ServoPacket packet = bathyal::read_servo_packet(bytes);
    if (bathyal::servo_packet(packet) != bytes) std::abort();
    for (const std::uint16_t pulse : packet.pulses) {
      if (!(std::abs(bathyal::command_of_pulse(pulse)) <= 1.0)) std::abort();
    }
  } catch (const bathyal::Error&) {
  }
  bathyal::Pd6Ensemble ensemble;
  try {
    bathyal::read_pd6_line(bytes, ensemble);
  } catch (const bathyal::Error&) {
  }
  if (!ensemble.velocity.allFinite() || !std::isfinite(ensemble.heading)) std::abort();
  return 0;
}
