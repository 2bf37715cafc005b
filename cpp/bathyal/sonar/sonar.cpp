// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/sonar/sonar.hpp"

#include <limits>
#include <numbers>
#include <string>

#include "bathyal/base/check.hpp"

namespace bathyal {
namespace {

constexpr double kPi = std::numbers::pi;

/// Where beam `row` of `count` lies in a sector that is symmetric about 0.
double spread(double sector, int row, int count) {
  return count == 1 ? 0.0 : sector * (static_cast<double>(row) / (count - 1) - 0.5);
}

/// In the plane of `level` and z, `tilt` below the horizontal.
Vec3 tilted(const Vec3& level, double tilt) {
  return std::cos(tilt) * level - std::sin(tilt) * Vec3::UnitZ();
}

std::string numbered(int row) {
  std::string name = "beam_";
  return name += std::to_string(row);
}

Beam side_scan_beam(const SonarOptions& options, int row) {
  const bool port = row == 0;
  return {port ? "port" : "starboard", Vec3::UnitX(),
          tilted(port ? Vec3(Vec3::UnitY()) : Vec3(-Vec3::UnitY()), options.tilt),
          port ? 1.0 : -1.0, 0.0};
}

/// Several are spread in the plane of x and z.
Beam echo_sounder_beam(const SonarOptions& options, int row) {
  const double tilt = options.tilt - spread(options.sector, row, options.beams);
  return {numbered(row), Vec3::UnitY(), tilted(Vec3::UnitX(), tilt), -1.0, 0.0};
}

/// Row 0 is the outermost to port.
Beam fan_beam(const SonarOptions& options, int row) {
  return {numbered(row), Vec3::UnitY(), tilted(Vec3::UnitX(), options.tilt), -1.0,
          -spread(options.sector, row, options.beams)};
}

void check_signal(const SonarOptions& options) {
  check_range("frequency", options.frequency, 1e3, 1e7);
  check_range("pulse_length", options.pulse_length, 1e-7, 10.0);
  check_range("bandwidth", options.bandwidth, 1e-1, 1e7);
  check_finite("source_level", options.source_level);
  check_range("ping_rate", options.ping_rate, 1e-4, 1e4);
  check_range("range", options.range, 1e-3, 1e6);
  check_range("samples", options.samples, 1, 1000000);
  check_range("multiples", options.multiples, 0, 8);
  check_range("wind_speed", options.wind_speed, 0.0, 50.0);
}

void check_beams(const SonarOptions& options) {
  check_range("beams", options.beams, 1, options.kind == SonarKind::kSideScan ? 2 : 4096);
  if (options.kind == SonarKind::kScanning) check_range("beams", options.beams, 1, 1);
  check_range("sector", options.sector, 0.0, kPi);
  check_range("beam_width", options.beam_width, 1e-6, 0.5 * kPi);
  check_range("fan_width", options.fan_width, 1e-6, kPi);
  check_range("fan_span", options.fan_span, 1e-6, kPi);
  check_range("tilt", options.tilt, -0.5 * kPi, 0.5 * kPi);
  check_range("axis_tilt", options.axis_tilt, -0.5 * kPi, 0.5 * kPi);
  check_finite("head_start", options.head_start);
  check_finite("head_step", options.head_step);
  check_rigid("vehicle_from_sonar", options.vehicle_from_sonar);
}

void check_rays(const SonarOptions& options) {
  check_range("rays_across_beam", options.rays_across_beam, 1, 100000);
  check_range("rays_along_fan", options.rays_along_fan, 1, 1000000);
  constexpr double kMostRays = 3e8;
  const double rays =
      static_cast<double>(options.beams) * options.rays_across_beam * options.rays_along_fan;
  if (rays > kMostRays) {
    throw_argument("rays_along_fan", "no more than 3·10⁸ rays a ping in all beams", to_text(rays));
  }
  if (options.rays == RayModel::kCamera && options.kind == SonarKind::kSideScan) {
    constexpr double kWidest = 0.95 * kPi;  // an image plane shows less than half of all directions
    check_range("fan_span", options.fan_span, 1e-6, kWidest);
  }
}

}  // namespace

void SonarOptions::check() const {
  ReceiverOptions::check();
  check_signal(*this);
  check_beams(*this);
  check_rays(*this);
}

std::vector<Beam> beams_of(const SonarOptions& options) {
  std::vector<Beam> beams;
  for (int row = 0; row < options.beams; ++row) {
    switch (options.kind) {
      case SonarKind::kSideScan:
        beams.push_back(side_scan_beam(options, row));
        break;
      case SonarKind::kEchoSounder:
        beams.push_back(echo_sounder_beam(options, row));
        break;
      case SonarKind::kMultibeam:
      case SonarKind::kImaging:
      case SonarKind::kScanning:
        beams.push_back(fan_beam(options, row));
        break;
    }
  }
  return beams;
}

Pose head_pose(const SonarOptions& options, std::int64_t ping) {
  Pose pose = Pose::Identity();
  if (options.kind != SonarKind::kScanning) return pose;
  const double turned = options.head_start + static_cast<double>(ping) * options.head_step;
  pose.linear() = Eigen::AngleAxisd(turned, Vec3::UnitZ()).toRotationMatrix();
  return pose;
}

std::string to_string(SonarKind kind) {
  switch (kind) {
    case SonarKind::kEchoSounder:
      return "echo_sounder";
    case SonarKind::kSideScan:
      return "side_scan";
    case SonarKind::kMultibeam:
      return "multibeam";
    case SonarKind::kImaging:
      return "imaging";
    case SonarKind::kScanning:
      return "scanning";
  }
  return {};
}

}  // namespace bathyal
