// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/world/survey/survey.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "bathyal/base/check.hpp"
#include "bathyal/base/parallel.hpp"
#include "bathyal/base/random.hpp"

namespace bathyal {
namespace {

constexpr double kFullTurn = 2.0 * std::numbers::pi;
constexpr double kMostSoundings = 1e8;
// Of all that is upright [m]: deeper than any sea, and ranges of it are known to far below 0.1 mm,
// to which a beam is followed (first_range).
constexpr double kHighest = 20000.0;
constexpr std::uint64_t kMotionStream = 0x100;
constexpr std::uint64_t kBeamStream = std::uint64_t{1} << 32U;

/// Where the sounder is at one ping, relative to the origin, and how it is turned.
struct Ping {
  Vec3 position;
  double roll;   ///< [rad], about the line
  double pitch;  ///< [rad]
  double yaw;    ///< [rad]
};

struct Sounding {
  Vec3 point;
  double uncertainty;
  double intensity;
};

/// A slow swing: the sum of two sines of incommensurate periods.
struct Swing {
  double phase_a, phase_b, amplitude, length;

  double at(double along) const {
    const double k = kFullTurn / length;
    return amplitude *
           (0.7 * std::sin(k * along + phase_a) + 0.3 * std::sin(2.37 * k * along + phase_b));
  }
};

Swing swing(RandomStream& random, double amplitude, double length) {
  const double phase_a = random.uniform(0.0, kFullTurn);
  return {phase_a, random.uniform(0.0, kFullTurn), amplitude, length};
}

int pings_a_line(const SurveyOptions& options) {
  return static_cast<int>(std::floor(options.length / options.ping_spacing)) + 1;
}

/// Every second line is sailed backwards, as surveys are.
std::vector<Ping> sail_line(const SurveyOptions& options, int line) {
  RandomStream random(options.seed, kMotionStream + static_cast<std::uint64_t>(line));
  const Swing surge = swing(random, 0.4 * options.ping_spacing, 2.3);
  const Swing sway = swing(random, 0.25, 19.0);
  const Swing heave = swing(random, 0.12, 7.0);
  const Swing roll = swing(random, 0.035, 5.1);
  const Swing pitch = swing(random, 0.02, 6.3);
  const Swing yaw = swing(random, 0.03, 23.0);
  const bool backwards = line % 2 == 1;
  const double y = options.width * (line + 0.5) / options.lines;
  const double lost_begin = random.uniform(0.3, 0.45) * options.length;
  std::vector<Ping> pings;
  for (int i = 0; i < pings_a_line(options); ++i) {
    const double along = i * options.ping_spacing;
    if (line == 0 && along >= lost_begin && along < lost_begin + options.lost_width) continue;
    const double x = (backwards ? options.length - along : along) + surge.at(along);
    pings.push_back({Vec3(x, y + sway.at(along), options.altitude + heave.at(along)),
                     roll.at(along), pitch.at(along),
                     yaw.at(along) + (backwards ? std::numbers::pi : 0.0)});
  }
  return pings;
}

void check_above(const std::vector<Ping>& pings, const GeneratedSeabed& seabed) {
  for (const Ping& ping : pings) {
    const double bottom = seabed.local_height(ping.position.x(), ping.position.y());
    if (ping.position.z() > bottom) continue;
    throw_argument("altitude", "a sounder above the bottom everywhere",
                   to_text(ping.position.z()) + " m where the bottom rises to " + to_text(bottom));
  }
}

/// Unit direction of a beam at `angle` to port of the sounder's nadir.
Vec3 beam_direction(const Ping& ping, double angle) {
  const double across = std::sin(angle + ping.roll);
  const double down = std::cos(angle + ping.roll);
  const Vec3 level(-down * std::sin(ping.pitch), across, -down * std::cos(ping.pitch));
  const double c = std::cos(ping.yaw);
  const double s = std::sin(ping.yaw);
  return {c * level.x() - s * level.y(), s * level.x() + c * level.y(), level.z()};
}

/// Range at which the beam first meets the bottom; it points down. Steps are as long as a bottom of
/// slope 1.5 allows; where a boulder's side is steeper, the step that went under is halved back.
double first_range(const GeneratedSeabed& seabed, const Vec3& from, const Vec3& direction) {
  const auto above = [&](double range) {
    const Vec3 p = from + range * direction;
    return p.z() - seabed.local_height(p.x(), p.y());
  };
  const double closing = -direction.z() + 1.5 * std::hypot(direction.x(), direction.y());
  double low = std::max(0.0, (from.z() - seabed.highest()) / -direction.z());
  double clearance = above(low);
  while (clearance > 1e-4) {
    const double high = low + clearance / closing;
    clearance = above(high);
    if (clearance >= 0.0) {
      low = high;
      continue;
    }
    double under = high;
    while (under - low > 1e-4) {
      const double middle = 0.5 * (low + under);
      (above(middle) > 0.0 ? low : under) = middle;
    }
    return under;
  }
  return low;
}

/// Backscatter by Lambert's law, 10 log₁₀ cos² of the angle to the bottom's normal, with speckle.
double backscatter(const GeneratedSeabed& seabed, const Vec3& point, const Vec3& direction,
                   RandomStream& random) {
  constexpr double kStep = 0.05;
  const double slope_x = (seabed.local_height(point.x() + kStep, point.y()) -
                          seabed.local_height(point.x() - kStep, point.y())) /
                         (2.0 * kStep);
  const double slope_y = (seabed.local_height(point.x(), point.y() + kStep) -
                          seabed.local_height(point.x(), point.y() - kStep)) /
                         (2.0 * kStep);
  const double cosine = -direction.dot(Vec3(-slope_x, -slope_y, 1.0).normalized());
  return -18.0 + 20.0 * std::log10(std::max(cosine, 0.02)) + 1.5 * random.normal();
}

Sounding sound(const SurveyOptions& options, const GeneratedSeabed& seabed, const Ping& ping,
               double angle, RandomStream random) {
  const Vec3 direction = beam_direction(ping, angle);
  const double range = first_range(seabed, ping.position, direction);
  const Vec3 hit = ping.position + range * direction;

  const double range_std = options.range_noise + options.range_noise_rate * range;
  double measured = range + range_std * random.normal();
  const Vec3 seen = beam_direction(ping, angle + options.angle_noise * random.normal());
  const double intensity = backscatter(seabed, hit, direction, random);
  if (random.uniform() < options.spike_fraction) measured *= random.uniform(0.55, 0.95);

  // z = range · cos(beam's angle to the vertical): both errors, carried to z.
  const double cosine = -direction.z();
  const double sine = std::sqrt(std::max(0.0, 1.0 - cosine * cosine));
  return {ping.position + measured * seen,
          std::hypot(range_std * cosine, options.angle_noise * range * sine), intensity};
}

void check_finite_rows(std::string_view name, const Values& values) {
  for (Index i = 0; i < values.rows(); ++i) {
    if (std::isfinite(values.data()[i])) continue;
    throw_argument(name, "finite numbers",
                   to_text(values.data()[i]) + " in row " + std::to_string(i));
  }
}

}  // namespace

void SurveyOptions::check() const {
  if (!origin.allFinite()) throw_argument("origin", "three finite numbers", "one that is not");
  for (const auto& [name, value] : {std::pair{"length", length},
                                    {"width", width},
                                    {"wave_length", wave_length},
                                    {"altitude", altitude},
                                    {"boulder_radius", boulder_radius},
                                    {"trench_width", trench_width},
                                    {"ping_spacing", ping_spacing}}) {
    check_positive(name, value);
  }
  for (const auto& [name, value] : {std::pair{"wave_height", wave_height},
                                    {"ripple_height", ripple_height},
                                    {"roughness", roughness},
                                    {"trench_depth", trench_depth},
                                    {"lost_width", lost_width},
                                    {"range_noise", range_noise},
                                    {"range_noise_rate", range_noise_rate},
                                    {"angle_noise", angle_noise}}) {
    check_not_negative(name, value);
  }
  for (const auto& [name, value] : {std::pair{"altitude", altitude},
                                    {"wave_height", wave_height},
                                    {"ripple_height", ripple_height},
                                    {"roughness", roughness},
                                    {"boulder_radius", boulder_radius},
                                    {"trench_depth", trench_depth}}) {
    check_range(name, value, 0.0, kHighest);
  }
  check_range("opening", opening, 1e-3, 2.8);
  check_range("spike_fraction", spike_fraction, 0.0, 1.0);
  check_range("boulders", boulders, 0, 100000);
  check_range("lines", lines, 1, 10000);
  check_range("beams", beams, 2, 100000);
  if (length / ping_spacing * lines * beams > kMostSoundings) {
    throw_argument("ping_spacing", "no more than 10⁸ soundings in all", to_text(ping_spacing));
  }
  resolve_threads(num_threads);
}

PointCloud generate_survey(const SurveyOptions& options) {
  options.check();
  const GeneratedSeabed seabed(options);
  std::vector<Ping> pings;
  for (int line = 0; line < options.lines; ++line) {
    const std::vector<Ping> sailed = sail_line(options, line);
    pings.insert(pings.end(), sailed.begin(), sailed.end());
  }
  check_above(pings, seabed);
  const auto beams = static_cast<std::size_t>(options.beams);
  const auto count = static_cast<Index>(pings.size() * beams);
  PointMatrix points(count, 3);
  Values::Matrix uncertainty(count);
  Values::Matrix intensity(count);
  parallel_for(pings.size(), 8, options.num_threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin * beams; i < end * beams; ++i) {
      const double part = static_cast<double>(i % beams) / static_cast<double>(beams - 1);
      const Sounding sounding =
          sound(options, seabed, pings[i / beams], (part - 0.5) * options.opening,
                RandomStream(options.seed, kBeamStream + i));
      const auto row = static_cast<Index>(i);
      points.row(row) = sounding.point + options.origin;
      uncertainty(row) = sounding.uncertainty;
      intensity(row) = sounding.intensity;
    }
  });
  return PointCloud(std::move(points), {{"uncertainty", Values(std::move(uncertainty))},
                                        {"intensity", Values(std::move(intensity))}});
}

Values survey_height(const Values& x, const Values& y, const SurveyOptions& options) {
  options.check();
  if (x.rows() != y.rows()) {
    throw_argument("y", std::to_string(x.rows()) + " values, as x has", std::to_string(y.rows()));
  }
  check_finite_rows("x", x);
  check_finite_rows("y", y);
  const GeneratedSeabed seabed(options);
  Values::Matrix height(x.rows());
  parallel_for(static_cast<std::size_t>(x.rows()), 4096, options.num_threads,
               [&](std::size_t begin, std::size_t end) {
                 for (std::size_t i = begin; i < end; ++i) {
                   height(static_cast<Index>(i)) = seabed.height(x.data()[i], y.data()[i]);
                 }
               });
  return height;
}

}  // namespace bathyal
