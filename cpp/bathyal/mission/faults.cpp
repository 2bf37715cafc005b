// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/mission/faults.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>

#include "bathyal/base/error.hpp"

namespace bathyal {
namespace {

constexpr std::array<std::pair<std::string_view, FaultKind>, 16> kNames{
    {{"off", FaultKind::kOff},
     {"stuck", FaultKind::kStuck},
     {"garbage", FaultKind::kGarbage},
     {"wrong", FaultKind::kWrong},
     {"slow", FaultKind::kSlow},
     {"delayed", FaultKind::kDelayed},
     {"intermittent", FaultKind::kIntermittent},
     {"bias", FaultKind::kBias},
     {"drift", FaultKind::kDrift},
     {"noise", FaultKind::kNoise},
     {"dead", FaultKind::kDead},
     {"weak", FaultKind::kWeak},
     {"reversed", FaultKind::kReversed},
     {"sag", FaultKind::kSag},
     {"leak", FaultKind::kLeak},
     {"lost", FaultKind::kLost}}};

constexpr std::uint64_t kFaultChannel = 1'000'000;  // apart from every sensor's own
constexpr std::uint64_t kRateChannel = 2'000'000;

}  // namespace

std::string_view fault_name(FaultKind kind) { return kNames[static_cast<std::size_t>(kind)].first; }

FaultKind fault_kind(std::string_view name) {
  std::string all;
  for (const auto& [known, kind] : kNames) {
    if (known == name) return kind;
    all += all.empty() ? "" : ", ";
    all += known;
  }
  std::string got("'");
  got.append(name.substr(0, 60)).append("'");
  throw_argument("fault", all.insert(0, "one of "), got);
}

void update_faults(const std::vector<MissionFault>& faults, std::vector<FaultState>& states,
                   double time, double tick, std::int64_t number, std::span<const double> signals,
                   std::uint64_t seed, std::vector<int>& changed) {
  changed.clear();
  for (std::size_t i = 0; i < faults.size(); ++i) {
    const MissionFault& fault = faults[i];
    FaultState& state = states[i];
    if (state.active && time >= state.since + fault.lasts) {
      state.active = false;
      state.over = fault.rate == 0.0;
      changed.push_back(static_cast<int>(i));
    }
    if (state.active || state.over) continue;
    bool begins = time >= fault.at || (fault.when && fault.when->holds(signals));
    if (fault.rate > 0.0) {
      const auto nth = static_cast<std::uint64_t>(std::count_if(
          faults.begin(), faults.begin() + static_cast<std::ptrdiff_t>(i), [&](const auto& other) {
            return other.device == fault.device && other.kind == fault.kind;
          }));  // so that faults of others change nothing
      const std::uint64_t channel =
          kRateChannel + 64 * nth + static_cast<std::uint64_t>(fault.kind);
      RandomStream draw =
          keyed_stream(seed, fault.device, channel, static_cast<std::uint64_t>(number));
      begins = begins || draw.uniform() < 1.0 - std::exp(-fault.rate * tick / 3600.0);
    }
    if (!begins) continue;
    state.active = true;
    state.since = time;
    changed.push_back(static_cast<int>(i));
  }
}

bool apply_sensor_fault(const MissionFault& fault, const FaultState& state, std::uint64_t seed,
                        const SensorReading& held, SensorReading& reading) {
  RandomStream draw =
      keyed_stream(seed, fault.device, kFaultChannel + static_cast<std::uint64_t>(fault.kind),
                   static_cast<std::uint64_t>(reading.index));
  const auto each = [&reading](const auto& change) {
    for (int i = 0; i < reading.count; ++i) {
      double& value = reading.values[static_cast<std::size_t>(i)];
      value = change(value);
    }
  };
  switch (fault.kind) {
    case FaultKind::kOff:
      return false;
    case FaultKind::kStuck:
      if (held.index >= 0) {
        reading.values = held.values;
        reading.valid = held.valid;
      }
      return true;
    case FaultKind::kGarbage:
      each([&](double) { return fault.size * draw.normal(); });
      return true;
    case FaultKind::kWrong:
      each([&](double value) { return value * (1.0 + fault.size); });
      return true;
    case FaultKind::kSlow:
      return reading.index % std::max<std::int64_t>(1, std::llround(fault.size)) == 0;
    case FaultKind::kDelayed:
      reading.arrival += fault.size;
      return true;
    case FaultKind::kIntermittent:
      return draw.uniform() >= fault.size;
    case FaultKind::kBias:
      each([&](double value) { return value + fault.size; });
      return true;
    case FaultKind::kDrift:
      each([&](double value) { return value + fault.size * (reading.time - state.since); });
      return true;
    case FaultKind::kNoise:
      each([&](double value) { return value + fault.size * draw.normal(); });
      return true;
    default:
      return true;
  }
}

double apply_drive_fault(const MissionFault& fault, double command, double held) {
  switch (fault.kind) {
    case FaultKind::kOff:
    case FaultKind::kDead:
      return 0.0;
    case FaultKind::kStuck:
      return held;
    case FaultKind::kWeak:
      return command * (1.0 - fault.size);
    case FaultKind::kReversed:
      return -command;
    default:
      return command;
  }
}

}  // namespace bathyal
