// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/navigation/sensor.hpp"

#include <cmath>
#include <utility>

#include "bathyal/base/check.hpp"
#include "bathyal/base/random.hpp"

namespace bathyal {
namespace {

constexpr std::array<std::pair<const char*, SensorKind>, 12> kNames{{
    {"depth", SensorKind::depth},
    {"imu", SensorKind::imu},
    {"dvl", SensorKind::dvl},
    {"compass", SensorKind::compass},
    {"gps", SensorKind::gps},
    {"usbl", SensorKind::usbl},
    {"lbl", SensorKind::lbl},
    {"altimeter", SensorKind::altimeter},
    {"current", SensorKind::current},
    {"rpm", SensorKind::rpm},
    {"leak", SensorKind::leak},
    {"modem", SensorKind::modem},
}};

/// FNV-1a.
std::uint64_t hash_of(const std::string& name) {
  std::uint64_t hash = 0xcbf29ce484222325U;
  for (const char c : name) {
    hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3U;
  }
  return hash;
}

/// Key of what is drawn once a seed, and of a sample's dropout, which no channel has.
constexpr std::int64_t kOnce = -1;
constexpr int kDropoutChannel = 15;

RandomStream stream_of(std::uint64_t seed, std::uint64_t name, int channel, std::int64_t index) {
  RandomStream key(seed, name);
  return RandomStream(
      key.next(), static_cast<std::uint64_t>(index) * 16U + static_cast<std::uint64_t>(channel));
}

/// Values of the sensor's place: its pose, its velocity over ground, in its own frame.
struct Place {
  Pose world_from_sensor;
  Vec3 arm;       ///< from the vehicle's origin, in the vehicle
  Vec3 velocity;  ///< of the sensor, in the vehicle
};

Place place_of(const SensorOptions& options, const SensorTruth& truth) {
  const Vec3 arm = options.vehicle_from_sensor.translation();
  const Vec3 spin = truth.velocity.tail<3>();
  return {truth.world_from_vehicle * options.vehicle_from_sensor, arm,
          truth.velocity.head<3>() + spin.cross(arm)};
}

void put(SensorReading& reading, const Vec3& values) {
  for (int i = 0; i < 3; ++i) reading.values[static_cast<std::size_t>(reading.count++)] = values[i];
}

void put(SensorReading& reading, double value) {
  reading.values[static_cast<std::size_t>(reading.count++)] = value;
}

Vec3 specific_force(const SensorTruth& truth, const Vec3& arm) {
  const Vec3 velocity = truth.velocity.head<3>();
  const Vec3 spin = truth.velocity.tail<3>();
  const Vec3 change = truth.acceleration.tail<3>();
  const Vec3 up = truth.world_from_vehicle.linear().transpose() * Vec3(0.0, 0.0, truth.gravity);
  return truth.acceleration.head<3>() + spin.cross(velocity) + change.cross(arm) +
         spin.cross(spin.cross(arm)) + up;
}

Vec3 roll_pitch_yaw(const Eigen::Matrix3d& r) {
  return {std::atan2(r(2, 1), r(2, 2)), std::atan2(-r(2, 0), std::hypot(r(2, 1), r(2, 2))),
          std::atan2(r(1, 0), r(0, 0))};
}

/// The farthest of what is asked for is within range.
bool heard(const SensorOptions& options, const SensorTruth& truth, const Vec3& at) {
  switch (options.kind) {
    case SensorKind::dvl:
      return std::isinf(options.range) || truth.altitude <= options.range;
    case SensorKind::altimeter:
      return truth.altitude <= options.range;
    case SensorKind::gps:
      return at.z() >= truth.surface;
    case SensorKind::usbl:
    case SensorKind::lbl:
    case SensorKind::modem:
      for (const Vec3& beacon : options.beacons) {
        if (!((beacon - at).norm() <= options.range)) return false;
      }
      return true;
    default:
      return true;
  }
}

double with_errors(const SensorChannel& c, double truth, double walk, double markov,
                   RandomStream& once, RandomStream& now) {
  const double bias = c.bias * once.normal();
  const double scale = 1.0 + c.scale * once.normal();
  double value = scale * truth + bias + walk + markov + c.noise * now.normal();
  if (c.outlier_rate > 0.0 && now.uniform() < c.outlier_rate) {
    value += c.outlier_size * now.normal();
  }
  return c.quantum > 0.0 ? c.quantum * std::round(value / c.quantum) : value;
}

/// Drifts from the last sample to this one.
void drift(const SensorChannel& c, double step, bool first, RandomStream& draw, double& walk,
           double& markov) {
  const double a = draw.normal(), b = draw.normal();
  if (!first) walk += c.walk * std::sqrt(step) * a;
  if (c.markov == 0.0) return;
  const double kept = first ? 0.0 : std::exp(-step / c.markov_time);
  markov = kept * markov + c.markov * std::sqrt(1.0 - kept * kept) * b;
}

void check_channel(const std::string& at, const SensorChannel& c) {
  check_not_negative(at + "noise", c.noise);
  check_not_negative(at + "bias", c.bias);
  check_not_negative(at + "scale", c.scale);
  check_not_negative(at + "walk", c.walk);
  check_not_negative(at + "markov", c.markov);
  check_not_negative(at + "markov_time", c.markov_time);
  if (c.markov > 0.0) check_positive(at + "markov_time", c.markov_time);
  check_range(at + "outlier_rate", c.outlier_rate, 0.0, 1.0);
  check_not_negative(at + "outlier_size", c.outlier_size);
  check_not_negative(at + "quantum", c.quantum);
}

bool needs_beacons(SensorKind kind) {
  return kind == SensorKind::usbl || kind == SensorKind::lbl || kind == SensorKind::modem;
}

}  // namespace

int SensorOptions::channel_count() const {
  switch (kind) {
    case SensorKind::imu:
      return 6;
    case SensorKind::dvl:
    case SensorKind::compass:
    case SensorKind::gps:
    case SensorKind::usbl:
    case SensorKind::current:
      return 3;
    case SensorKind::lbl:
      return static_cast<int>(beacons.size());
    default:
      return 1;
  }
}

void SensorOptions::check() const {
  if (name.empty()) throw_argument("name", "a name, which keys the noise", "none");
  check_positive("rate", rate);
  check_not_negative("latency", latency);
  check_range("dropout", dropout, 0.0, 1.0);
  if (!(range > 0.0)) throw_argument("range", "a number above 0, or infinity", to_text(range));
  check_positive("sound_speed", sound_speed);
  check_rigid("vehicle_from_sensor", vehicle_from_sensor);
  const std::size_t most = kind == SensorKind::lbl ? kSensorChannels : 1;
  if (needs_beacons(kind) && (beacons.empty() || beacons.size() > most)) {
    throw_argument("beacons", most == 1 ? "one position" : "1 to 12 positions",
                   std::to_string(beacons.size()));
  }
  for (const Vec3& beacon : beacons) {
    for (const double value : beacon) check_finite("beacons", value);
  }
  for (std::size_t i = 0; i < channels.size(); ++i) {
    check_channel("channels[" + std::to_string(i) + "].", channels[i]);
  }
}

double next_time(const SensorOptions& options, const SensorState& state) {
  return static_cast<double>(state.index + 1) / options.rate;
}

SensorReading ideal_reading(const SensorOptions& options, const SensorTruth& truth) {
  const Place place = place_of(options, truth);
  const Eigen::Matrix3d sensor_from_vehicle = options.vehicle_from_sensor.linear().transpose();
  const Vec3 at = place.world_from_sensor.translation();
  SensorReading reading;
  reading.kind = options.kind;
  reading.time = truth.time;
  reading.arrival = truth.time + options.latency;
  switch (options.kind) {
    case SensorKind::depth:
      put(reading, truth.mean_surface - at.z());
      break;
    case SensorKind::imu:
      put(reading, sensor_from_vehicle * truth.velocity.tail<3>());
      put(reading, sensor_from_vehicle * specific_force(truth, place.arm));
      break;
    case SensorKind::dvl:
      put(reading, sensor_from_vehicle * place.velocity);
      break;
    case SensorKind::compass:
      put(reading, roll_pitch_yaw(truth.world_from_vehicle.linear()));
      break;
    case SensorKind::gps:
    case SensorKind::usbl:
      put(reading, at);
      break;
    case SensorKind::lbl:
      for (const Vec3& beacon : options.beacons) put(reading, (beacon - at).norm());
      break;
    case SensorKind::altimeter:
      put(reading, truth.altitude);
      break;
    case SensorKind::current:
      put(reading, place.world_from_sensor.linear().transpose() * truth.water_velocity -
                       sensor_from_vehicle * place.velocity);
      break;
    case SensorKind::rpm:
      put(reading, truth.propeller_rate);
      break;
    case SensorKind::leak:
      put(reading, truth.leak);
      break;
    case SensorKind::modem:
      put(reading, (options.beacons.at(0) - at).norm() / options.sound_speed);
      reading.arrival += reading.values[0];
      break;
  }
  if (options.kind == SensorKind::usbl) {
    reading.arrival += 2.0 * (options.beacons.at(0) - at).norm() / options.sound_speed;
  }
  reading.valid = heard(options, truth, at);
  return reading;
}

std::optional<SensorReading> sample(const SensorOptions& options, SensorState& state,
                                    const SensorTruth& truth, std::uint64_t seed) {
  constexpr double kEarly = 1e-6;  // parts of a period: times are sums of steps
  const auto index = static_cast<std::int64_t>(std::floor(truth.time * options.rate + kEarly));
  if (index <= state.index || index < 0) return {};
  const std::uint64_t name = hash_of(options.name);
  SensorReading reading = ideal_reading(options, truth);
  reading.index = index;
  for (int i = 0; i < reading.count; ++i) {
    const auto k = static_cast<std::size_t>(i);
    RandomStream once = stream_of(seed, name, i, kOnce);
    RandomStream now = stream_of(seed, name, i, index);
    drift(options.channels[k], truth.time - state.time, state.index < 0, now, state.walk[k],
          state.markov[k]);
    reading.values[k] = with_errors(options.channels[k], reading.values[k], state.walk[k],
                                    state.markov[k], once, now);
  }
  state.index = index;
  state.time = truth.time;
  RandomStream chance = stream_of(seed, name, kDropoutChannel, index);
  if (chance.uniform() < options.dropout) return {};
  return reading;
}

SensorKind sensor_kind(const std::string& name) {
  std::string names;
  for (const auto& [known, kind] : kNames) {
    if (name == known) return kind;
    names += (names.empty() ? "" : ", ") + std::string(known);
  }
  throw_argument("kind", "one of " + names, "\"" + name + "\"");
}

std::string sensor_kind_name(SensorKind kind) {
  return kNames[static_cast<std::size_t>(kind)].first;
}

}  // namespace bathyal
