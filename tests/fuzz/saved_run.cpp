// SPDX-License-Identifier: BSD-3-Clause
#include <cstdlib>
#include <cstring>
#include <stdexcept>

#include "bathyal/base/error.hpp"
#include "bathyal/log/crc32.hpp"
#include "bathyal/mission/internal/saved_run.hpp"

namespace {

constexpr std::uint64_t kSeed = 1;

/// What a saved run of this mission and seed begins with.
std::string head_of(const bathyal::MissionState& like) {
  const std::string whole = bathyal::saved_run(like, "mission", kSeed);
  return whole.substr(0, 8 + 8 + 7 + 8);
}

std::string with_checksum(std::string bytes) {
  const std::uint32_t sum = bathyal::crc32(bytes);
  bytes.resize(bytes.size() + sizeof sum);
  std::memcpy(bytes.data() + bytes.size() - sizeof sum, &sum, sizeof sum);
  return bytes;
}

bathyal::MissionState two_sensors() {
  bathyal::MissionState like;
  like.lines.resize(2);
  like.watchers.sensors.resize(2);
  like.leaves.resize(2);
  like.faults.resize(1);
  like.guard_since.resize(1);
  like.signals.resize(3);
  like.vehicle.thrusters.resize(1);
  like.held_commands.resize(1);
  return like;
}

}  // namespace

// Any bytes behind the right head, with the right checksum, are a state or refused; a state that
// was read is read again as it is.
extern "C" int LLVMFuzzerTestOneInput(const unsigned char* data, std::size_t size) {
  static const bathyal::MissionState kLike = two_sensors();
  static const std::string kHead = head_of(kLike);
  const std::string bytes =
      with_checksum(std::string(kHead).append(reinterpret_cast<const char*>(data), size));
  try {
    const std::string saved =
        bathyal::saved_run(bathyal::loaded_run(bytes, kLike, "mission", kSeed), "mission", kSeed);
    const bathyal::MissionState again = bathyal::loaded_run(saved, kLike, "mission", kSeed);
    if (bathyal::saved_run(again, "mission", kSeed) != saved) std::abort();
  } catch (const bathyal::Error&) {
  } catch (const std::invalid_argument&) {
  }
  return 0;
}
