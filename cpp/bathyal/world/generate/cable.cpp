// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <numbers>

#include "bathyal/base/check.hpp"
#include "bathyal/base/random.hpp"
#include "bathyal/world/generate/internal/route.hpp"
#include "bathyal/world/generate/pipeline.hpp"

namespace bathyal {
namespace {

PipelineOptions as_pipe(const CableOptions& cable) {
  check_range("slack", cable.slack, 0.0, 0.3);
  check_positive("slack_wavelength", cable.slack_wavelength);
  PipelineOptions pipe;
  pipe.burial = cable.burial;
  pipe.sag = cable.sag;
  pipe.step = cable.step;
  pipe.sides = cable.sides;
  pipe.num_threads = cable.num_threads;
  return pipe;
}

struct Bends {
  double wavelength, amplitude, phase;
};

/// Places along the curve, eight a wavelength, moved to both sides of it; not at its ends.
std::vector<Vec3> bend(const generate::RouteCurve& curve, const std::vector<double>& along,
                       const Bends& bends) {
  const double k = 2.0 * std::numbers::pi / bends.wavelength;
  std::vector<Vec3> places;
  for (const double at : along) {
    const double near = std::min(at, curve.length() - at);
    const Vec3 ahead =
        curve.at(std::min(at + 0.01, curve.length())) - curve.at(std::max(at - 0.01, 0.0));
    const Vec3 across = Vec3(-ahead.y(), ahead.x(), 0.0).normalized();
    const double off = bends.amplitude * std::min(1.0, near / bends.wavelength);
    places.emplace_back(curve.at(at) + off * std::sin(k * at + bends.phase) * across);
  }
  return places;
}

/// The route with bends that make it longer by the slack. Burial goes with it.
std::vector<Vec3> slacken(const std::vector<Vec3>& route, const CableOptions& cable,
                          PipelineOptions& pipe) {
  if (cable.slack == 0.0) return route;
  pipe.check(1.0, route.size());
  const generate::RouteCurve curve(route);
  const double count = std::ceil(8.0 * curve.length() / cable.slack_wavelength) + 1.0;
  if (!(count >= 9.0 && count < 1e5)) {
    throw_argument("slack_wavelength", "from 10⁻⁴ of the route's length to all of it",
                   to_text(cable.slack_wavelength));
  }
  std::vector<double> along;
  for (double i = 0.0; i < count; i += 1.0) along.push_back(curve.length() * (i / (count - 1.0)));
  // To second order a sine of amplitude A and wave number k is longer by the share (A k)² / 4.
  RandomStream random(cable.seed, 0xcab1e);
  Bends bends{cable.slack_wavelength,
              std::sqrt(cable.slack) * cable.slack_wavelength / std::numbers::pi,
              random.uniform(0.0, 2.0 * std::numbers::pi)};
  for (int i = 0; i < 8; ++i) {
    const double longer = generate::RouteCurve(bend(curve, along, bends)).length() / curve.length();
    bends.amplitude *= std::sqrt(cable.slack / std::max(longer - 1.0, 0.1 * cable.slack));
  }
  if (pipe.burial.size() > 1) {
    const std::vector<double> knots = curve.knots();
    std::vector<double> burial;
    for (const double at : along) burial.push_back(generate::between(knots, pipe.burial, at));
    pipe.burial = burial;
  }
  return bend(curve, along, bends);
}

}  // namespace

Pipeline make_cable(const std::vector<Vec2>& route, const Scene& terrain, double diameter,
                    const CableOptions& options) {
  PipelineOptions pipe = as_pipe(options);
  std::vector<Vec3> level;
  for (const Vec2& point : route) level.emplace_back(point.x(), point.y(), 0.0);
  std::vector<Vec2> line;
  for (const Vec3& point : slacken(level, options, pipe)) line.emplace_back(point.x(), point.y());
  return make_pipeline(line, terrain, diameter, pipe);
}

Pipeline make_cable(const std::vector<Vec3>& route, double diameter, const CableOptions& options) {
  PipelineOptions pipe = as_pipe(options);
  const std::vector<Vec3> line = slacken(route, options, pipe);
  return make_pipeline(line, diameter, pipe);
}

}  // namespace bathyal
