// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/sonar/internal/ray_fan.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "bathyal/sonar/internal/beam_pattern.hpp"
#include "bathyal/sonar/internal/pattern_mean.hpp"

namespace bathyal::sonar {
namespace {

/// Which of a beam's two patterns count on transmit and on receive. A multibeam's swath is
/// transmitted by one array and received by another, across it; an imaging sonar transmits over all
/// of its sector.
bool beam_counts_twice(SonarKind kind) {
  return kind == SonarKind::kSideScan || kind == SonarKind::kEchoSounder ||
         kind == SonarKind::kScanning;
}

double twice(double power, bool counts_twice) { return counts_twice ? power * power : power; }

/// Mean power over what a ray covers in φ, one way or, `squared`, two ways.
double across(const SonarOptions& options, const Beam& beam, double phi, double half_phi,
              bool squared) {
  const double width = std::sin(0.5 * options.beam_width);
  const double off = std::sin(phi) * std::cos(half_phi) - std::sin(beam.steered);
  return pattern_mean(options.beam_pattern, squared)(off / width,
                                                     std::cos(phi) * std::sin(half_phi) / width);
}

/// One-way power over ψ.
double along(const SonarOptions& options, double psi) {
  return pattern(options.beam_pattern, psi - (options.tilt - options.axis_tilt), options.fan_width);
}

/// Of a round beam, by the angle off its axis, one way.
double round_power(const SonarOptions& options, const Beam& beam, double phi, double psi) {
  const double off = std::acos(std::clamp(beam.direction(phi, psi).dot(beam.axis), -1.0, 1.0));
  if (options.beam_pattern == BeamPattern::kNone) return off <= 0.5 * options.beam_width;
  return pattern(options.beam_pattern, off, options.beam_width);
}

/// Two-way power of the beam at φ, ψ, over half of a ray's cell to either side of φ.
double two_way(const SonarOptions& options, const Beam& beam, double phi, double psi,
               double half_phi) {
  if (options.kind == SonarKind::kEchoSounder) {
    return twice(round_power(options, beam, phi, psi), true);
  }
  return across(options, beam, phi, half_phi, beam_counts_twice(options.kind)) *
         twice(along(options, psi), options.kind != SonarKind::kMultibeam);
}

/// One-way power of what is transmitted at φ, ψ; of an imaging sonar and a multibeam over all φ.
/// By that which the beam receives, the mean over a cell, it makes the mean of both.
double transmitted(const SonarOptions& options, const Beam& beam, double phi, double psi,
                   double half_phi) {
  if (options.beam_pattern == BeamPattern::kNone) return 1.0;
  if (options.kind == SonarKind::kEchoSounder) return round_power(options, beam, phi, psi);
  if (!beam_counts_twice(options.kind)) return along(options, psi);
  const double received = across(options, beam, phi, half_phi, false);
  if (!(received > 0.0)) return 0.0;
  return along(options, psi) * across(options, beam, phi, half_phi, true) / received;
}

/// A ray with what it counts, `solid` apart from the beam's pattern; none where the pattern has no
/// power.
void add_ray(const SonarOptions& options, double phi, double psi, const Vec3& direction,
             double solid, BeamRays& rays) {
  const double weight = solid * two_way(options, rays.beam, phi, psi, rays.half_phi);
  if (weight <= 0.0) return;
  rays.least = rays.weight.empty() ? direction : Vec3(rays.least.cwiseMin(direction));
  rays.most = rays.weight.empty() ? direction : Vec3(rays.most.cwiseMax(direction));
  rays.direction.insert(rays.direction.end(), direction.data(), direction.data() + 3);
  rays.weight.push_back(weight);
  if (options.motion) {
    rays.transmitted.push_back(solid * transmitted(options, rays.beam, phi, psi, rays.half_phi));
  }
}

/// The span of ψ that rays cover: of a round beam, that of φ.
double psi_span(const SonarOptions& options, double phi_span) {
  return options.kind == SonarKind::kEchoSounder ? phi_span : options.fan_span;
}

BeamRays angle_rays(const SonarOptions& options, const Beam& beam) {
  const double quarter = 0.5 * std::numbers::pi;
  const double reach = reach_of(options.beam_pattern, options.beam_width);
  const double low = std::max(beam.steered - reach, -quarter);
  const double high = std::min(beam.steered + reach, quarter);
  const double span = psi_span(options, 2.0 * reach);
  const double phi_step = (high - low) / options.rays_across_beam;
  const double psi_step = span / options.rays_along_fan;
  BeamRays rays{beam, 0.5 * psi_step, 0.5 * phi_step, {}, {}, {}, {0}};
  for (int i = 0; i < options.rays_across_beam; ++i) {
    const double phi = low + (i + 0.5) * phi_step;
    const double angle =
        psi_step * (std::sin(phi + rays.half_phi) - std::sin(phi - rays.half_phi));  // solid
    for (int j = 0; j < options.rays_along_fan; ++j) {
      const double psi = (j + 0.5) * psi_step - 0.5 * span;
      add_ray(options, phi, psi, beam.direction(phi, psi).normalized(), angle, rays);
    }
    rays.columns.push_back(rays.weight.size());
  }
  return rays;
}

/// Pixels at equal distances in the image plane.
BeamRays camera_rays(const SonarOptions& options, const Beam& beam) {
  Beam steered = beam;
  steered.axis = beam.direction(beam.steered, 0.0);
  const Vec3 up = beam.up();
  const Vec3 right = beam.sense * steered.axis.cross(up);
  const double half_width = std::tan(0.5 * options.beam_width);
  const double half_height = std::tan(0.5 * psi_span(options, options.beam_width));
  const auto at = [](int i, int count, double half) {
    return half * ((2.0 * i + 1.0) / count - 1.0);
  };
  const double pixel = 4.0 * half_width * half_height /
                       (static_cast<double>(options.rays_across_beam) * options.rays_along_fan);
  BeamRays rays{beam, 0.0, 0.0, {}, {}, {}, {0}};
  for (int i = 0; i < options.rays_across_beam; ++i) {
    const double x = at(i, options.rays_across_beam, half_width);
    for (int j = 0; j < options.rays_along_fan; ++j) {
      const double y = at(j, options.rays_along_fan, half_height);
      const Vec3 direction = (steered.axis + x * right + y * up).normalized();
      const double cosine = direction.dot(steered.axis);
      const double phi = std::asin(std::clamp(direction.dot(beam.array), -1.0, 1.0));
      const double psi = std::atan2(direction.dot(up), direction.dot(beam.axis));
      const double counts = options.pixel_solid_angle ? pixel * cosine * cosine * cosine : 1.0;
      add_ray(options, phi, psi, direction, counts, rays);
    }
    rays.columns.push_back(rays.weight.size());
  }
  return rays;
}

}  // namespace

std::vector<BeamRays> ray_fans(const SonarOptions& options) {
  std::vector<BeamRays> fans;
  for (const Beam& beam : beams_of(options)) {
    fans.push_back(options.rays == RayModel::kCamera ? camera_rays(options, beam)
                                                     : angle_rays(options, beam));
  }
  return fans;
}

}  // namespace bathyal::sonar
