// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/sonar/presets.hpp"

#include <numbers>

namespace bathyal {
namespace {

constexpr double degrees(double angle) { return angle * std::numbers::pi / 180.0; }

}  // namespace

SonarOptions side_scan_sonar() {
  SonarOptions sonar;
  sonar.beam_width = degrees(0.6);
  sonar.fan_width = degrees(50.0);
  sonar.fan_span = degrees(90.0);
  sonar.tilt = degrees(45.0);
  sonar.axis_tilt = degrees(30.0);
  return sonar;
}

SonarOptions side_scan_100khz_sonar() {
  SonarOptions sonar = side_scan_sonar();
  sonar.name = "side_scan_100khz";
  sonar.frequency = 100e3;
  sonar.pulse_length = 200e-6;
  sonar.bandwidth = 5e3;
  sonar.source_level = 220.0;
  sonar.ping_rate = 3.0;
  sonar.range = 200.0;
  sonar.samples = 2000;
  sonar.beam_width = degrees(1.0);
  sonar.rays_along_fan = 8000;  // 2 cm apart at 100 m: cables are met
  return sonar;
}

SonarOptions paper_side_scan_sonar() {
  SonarOptions sonar;
  sonar.name = "paper_side_scan";
  sonar.range = 120.0;
  sonar.samples = 2000;
  sonar.ping_rate = 5.0;
  sonar.beam_width = degrees(0.6);
  sonar.fan_width = sonar.fan_span = degrees(45.0);
  sonar.tilt = sonar.axis_tilt = degrees(22.5);
  sonar.rays = RayModel::kCamera;
  sonar.rays_across_beam = 100;
  sonar.rays_along_fan = 8000;
  return sonar;
}

SonarOptions multibeam_sonar() {
  SonarOptions sonar;
  sonar.kind = SonarKind::kMultibeam;
  sonar.name = "multibeam";
  sonar.frequency = 400e3;
  sonar.pulse_length = 50e-6;
  sonar.source_level = 215.0;
  sonar.ping_rate = 10.0;
  sonar.range = 100.0;
  sonar.samples = 2000;
  sonar.beams = 256;
  sonar.sector = degrees(120.0);
  sonar.beam_width = degrees(1.0);
  sonar.fan_width = sonar.fan_span = degrees(1.0);
  sonar.tilt = sonar.axis_tilt = degrees(90.0);
  sonar.rays_across_beam = 12;
  sonar.rays_along_fan = 10;
  return sonar;
}

SonarOptions echo_sounder_sonar() {
  SonarOptions sonar;
  sonar.kind = SonarKind::kEchoSounder;
  sonar.name = "echo_sounder";
  sonar.frequency = 200e3;
  sonar.pulse_length = 100e-6;
  sonar.bandwidth = 10e3;
  sonar.source_level = 210.0;
  sonar.ping_rate = 5.0;
  sonar.range = 100.0;
  sonar.samples = 2000;
  sonar.beams = 1;
  sonar.beam_width = sonar.fan_width = sonar.fan_span = degrees(10.0);
  sonar.tilt = sonar.axis_tilt = degrees(90.0);
  sonar.rays_across_beam = sonar.rays_along_fan = 100;
  return sonar;
}

SonarOptions paper_forward_sounders() {
  SonarOptions sonar = echo_sounder_sonar();
  sonar.name = "paper_forward_sounders";
  sonar.beams = 5;
  sonar.sector = degrees(90.0);
  sonar.tilt = sonar.axis_tilt = degrees(15.0);
  sonar.range = 75.0;
  sonar.rays = RayModel::kCamera;
  return sonar;
}

SonarOptions imaging_sonar() {
  SonarOptions sonar;
  sonar.kind = SonarKind::kImaging;
  sonar.name = "imaging";
  sonar.frequency = 900e3;
  sonar.pulse_length = 40e-6;
  sonar.bandwidth = 25e3;
  sonar.source_level = 205.0;
  sonar.ping_rate = 15.0;
  sonar.range = 30.0;
  sonar.samples = 512;
  sonar.beams = 512;
  sonar.sector = degrees(130.0);
  sonar.beam_width = degrees(130.0 / 511.0);
  sonar.fan_width = sonar.fan_span = degrees(20.0);
  sonar.tilt = sonar.axis_tilt = degrees(20.0);
  sonar.rays_across_beam = 1;
  sonar.rays_along_fan = 512;
  return sonar;
}

SonarOptions scanning_sonar() {
  SonarOptions sonar;
  sonar.kind = SonarKind::kScanning;
  sonar.name = "scanning";
  sonar.frequency = 675e3;
  sonar.pulse_length = 50e-6;
  sonar.source_level = 208.0;
  sonar.ping_rate = 20.0;
  sonar.range = 50.0;
  sonar.samples = 1000;
  sonar.beams = 1;
  sonar.beam_width = degrees(1.8);
  sonar.fan_width = sonar.fan_span = degrees(30.0);
  sonar.tilt = sonar.axis_tilt = degrees(10.0);
  sonar.head_start = degrees(-180.0);
  sonar.head_step = degrees(0.9);
  sonar.rays_across_beam = 8;
  sonar.rays_along_fan = 1000;
  return sonar;
}

SonarOptions with_real_physics(SonarOptions options) {
  options.spreading = true;
  options.absorption = AbsorptionFormula::kFrancoisGarrison;
  options.backscatter = BackscatterModel::kMaterial;
  options.beam_pattern = BeamPattern::kUniform;
  options.side_lobes = true;
  options.pixel_solid_angle = true;
  options.refraction = true;
  options.multiples = 2;
  options.motion = true;
  options.pulse = PulseModel::kRectangle;
  options.speckle = SpeckleModel::kRayleigh;
  options.noise = true;
  options.tvg = true;
  options.tvg_absorption = 1e-3 * absorption(*options.absorption, options.frequency, {});
  options.bits = 24;
  return options;
}

}  // namespace bathyal
