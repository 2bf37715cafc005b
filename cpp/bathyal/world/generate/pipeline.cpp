// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/world/generate/pipeline.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <tuple>
#include <utility>

#include "bathyal/base/check.hpp"
#include "bathyal/base/parallel.hpp"
#include "bathyal/world/generate/internal/laying.hpp"
#include "bathyal/world/generate/internal/mesh_builder.hpp"
#include "bathyal/world/generate/internal/route.hpp"

namespace bathyal {
namespace {

constexpr double kMostStations = 1e6;
constexpr double kMostVertices = 2e7;
constexpr double kRamp = 0.02;      // over which anodes and joints begin and end [m]
constexpr double kFreeShare = 0.1;  // of the diameter: a gap that counts as a span

/// Anodes and field joints: rings around the pipe at equal distances.
struct Sleeves {
  double spacing, length, thicker;
};

std::array<Sleeves, 2> sleeves(const PipelineOptions& o) {
  return {{{o.anode_spacing, o.anode_length, o.anode_thickness},
           {o.joint_spacing, o.joint_length, -o.joint_recess}}};
}

double radius_at(double kp, double radius, const PipelineOptions& options) {
  double here = radius;
  for (const Sleeves& one : sleeves(options)) {
    if (one.spacing == 0.0) continue;
    const double off = std::abs(std::remainder(kp - 0.5 * one.spacing, one.spacing));
    here += one.thicker * std::clamp((0.5 * one.length - off) / kRamp + 0.5, 0.0, 1.0);
  }
  return here;
}

void check_count(double stations, const PipelineOptions& options) {
  if (stations <= kMostStations && stations * options.sides <= kMostVertices) return;
  throw_argument("step", "no more than 10⁶ stations and 2·10⁷ vertices in all",
                 to_text(options.step) + " m, " + to_text(std::ceil(stations)) + " stations of " +
                     std::to_string(options.sides) + " vertices");
}

/// Where rings are, along the route: every step, at the ends of spans and of sleeves.
std::vector<double> stations(double length, const PipelineOptions& options) {
  double count = std::ceil(length / options.step) + 1.0;
  for (const Sleeves& one : sleeves(options)) {
    if (one.spacing > 0.0) count += 4.0 * std::ceil(length / one.spacing);
  }
  check_count(count, options);
  std::vector<double> kp;
  const double steps = std::max(1.0, std::ceil(length / options.step * (1.0 - 1e-12)));
  for (double i = 0.0; i <= steps; i += 1.0) kp.push_back(length * (i / steps));
  for (const auto& span : options.spans) kp.insert(kp.end(), span.begin(), span.end());
  for (const Sleeves& one : sleeves(options)) {
    if (one.spacing == 0.0) continue;
    for (double at = 0.5 * one.spacing; at < length; at += one.spacing) {
      const double half = 0.5 * one.length;
      for (const double off : {half - 0.5 * kRamp, half + 0.5 * kRamp}) {
        kp.insert(kp.end(), {at - off, at + off});
      }
    }
  }
  std::sort(kp.begin(), kp.end());
  std::vector<double> apart;
  for (const double at : kp) {
    if (at < 0.0 || at > length) continue;
    if (apart.empty() || at - apart.back() > 1e-3) apart.push_back(at);
  }
  apart.back() = length;
  for (double& at : apart) {
    for (const auto& span : options.spans) {
      for (const double end : span) {
        if (std::abs(at - end) <= 1e-3) at = end;
      }
    }
  }
  return apart;
}

/// Linear between the values at `knots`.
double burial_at(double kp, const std::vector<double>& burial, const std::vector<double>& knots) {
  if (burial.empty()) return 0.0;
  if (burial.size() == 1) return burial.front();
  return generate::between(knots, burial, kp);
}

/// Puts the middle line of one span straight over what lies between its ends, and higher by the gap
/// asked for.
void lift_span(const std::array<double, 2>& span, const std::vector<double>& rest,
               const PipelineOptions& options, Pipeline& line) {
  const auto within = [&](double kp) { return kp > span[0] - 1e-3 && kp < span[1] + 1e-3; };
  std::vector<std::size_t> rows;
  for (std::size_t i = 0; i < line.kp.size(); ++i) {
    if (within(line.kp[i])) rows.push_back(i);
  }
  std::vector<double> along, height;
  for (const std::size_t i : rows) {
    const bool end = i == rows.front() || i == rows.back();
    along.push_back(line.kp[i]);
    height.push_back(end ? line.center(static_cast<Index>(i), 2) : rest[i]);
  }
  height = generate::hang(along, height, std::numeric_limits<double>::infinity());
  for (std::size_t k = 0; k < rows.size(); ++k) {
    const double t = (along[k] - along.front()) / (along.back() - along.front());
    line.center(static_cast<Index>(rows[k]), 2) =
        height[k] + 16.0 * options.span_gap * t * t * (1.0 - t) * (1.0 - t);
    line.span[rows[k]] = true;
  }
}

void check_spans(const PipelineOptions& options, double length) {
  double end = 0.0;
  for (const auto& span : options.spans) {
    if (!(span[0] >= end && span[1] > span[0] + 0.01 && span[1] <= length)) {
      throw_argument("spans",
                     "pairs from < to that rise along the route, 0 to " + to_text(length) + " m",
                     "(" + to_text(span[0]) + ", " + to_text(span[1]) + ")");
    }
    end = span[1];
  }
}

/// The mesh around the middle line.
void sweep_pipe(const std::vector<double>& radius, int sides, Pipeline& line) {
  std::vector<Vec3> center;
  for (Index i = 0; i < line.center.rows(); ++i) center.emplace_back(line.center.row(i));
  generate::MeshBuilder builder;
  builder.loft(generate::tube_rings(center, radius, sides), center.front(), center.back());
  Values::Matrix kp(static_cast<Index>(builder.vertices().size()));
  kp(0) = line.kp.front();
  kp(1) = line.kp.back();
  for (Index i = 2; i < kp.rows(); ++i) kp(i) = line.kp[static_cast<std::size_t>((i - 2) / sides)];
  line.mesh = builder.mesh({{"kp", Values(std::move(kp))}});
}

void measure_bottom(const std::vector<double>& bottom, const std::vector<double>& radius,
                    double diameter, Pipeline& line) {
  line.bottom = bottom;
  for (std::size_t i = 0; i < bottom.size(); ++i) {
    const double above = line.center(static_cast<Index>(i), 2) - radius[i] - bottom[i];
    line.gap.push_back(std::max(0.0, above));
    line.burial.push_back(std::max(0.0, -above));
    if (above > kFreeShare * diameter) line.span[i] = true;
  }
}

struct Started {
  Pipeline line;
  std::vector<double> radius;
  std::vector<Vec3> places;
};

Started start_pipe(const generate::RouteCurve& curve, double diameter,
                   const PipelineOptions& options) {
  Started started;
  started.line.kp = stations(curve.length(), options);
  started.line.center.resize(static_cast<Index>(started.line.kp.size()), 3);
  started.line.span.assign(started.line.kp.size(), false);
  for (std::size_t i = 0; i < started.line.kp.size(); ++i) {
    started.places.push_back(curve.at(started.line.kp[i]));
    started.radius.push_back(radius_at(started.line.kp[i], 0.5 * diameter, options));
    started.line.center.row(static_cast<Index>(i)) = started.places.back();
  }
  return started;
}

std::vector<Vec3> flat_route(const std::vector<Vec2>& route) {
  std::vector<Vec3> points;
  for (const Vec2& point : route) points.emplace_back(point.x(), point.y(), 0.0);
  return points;
}

Pipeline lay_pipe(Started started, const std::vector<double>& knots, const Scene& terrain,
                  double diameter, const PipelineOptions& options) {
  Pipeline& line = started.line;
  // Sleeves stick out a little below: the pipe itself is what rests.
  const std::vector<double> pipe(started.radius.size(), 0.5 * diameter);
  const generate::Contact contact =
      generate::touch_terrain(terrain, started.places, pipe, options.num_threads);
  const std::vector<double> rest = generate::hang(line.kp, contact.rest, options.sag);
  for (std::size_t i = 0; i < rest.size(); ++i) {
    line.center(static_cast<Index>(i), 2) = rest[i] - burial_at(line.kp[i], options.burial, knots);
  }
  for (const auto& span : options.spans) lift_span(span, contact.rest, options, line);
  measure_bottom(contact.bottom, pipe, diameter, line);
  sweep_pipe(started.radius, options.sides, line);
  return std::move(line);
}

}  // namespace

void PipelineOptions::check(double diameter, std::size_t points) const {
  check_range("diameter", diameter, 1e-4, 100.0);
  if (burial.size() > 1 && burial.size() != points) {
    throw_argument("burial",
                   "one value, or " + std::to_string(points) + ", one a point of the route",
                   std::to_string(burial.size()));
  }
  for (const double value : burial) check_range("burial", value, 0.0, 1000.0);
  check_range("span_gap", span_gap, 0.0, 1000.0);
  if (!(sag > 0.0)) throw_argument("sag", "a number above 0", to_text(sag));
  for (const auto& [name, spacing, length] :
       {std::tuple{"anode_spacing", anode_spacing, anode_length},
        {"joint_spacing", joint_spacing, joint_length}}) {
    check_not_negative(name, spacing);
    if (spacing > 0.0 && !(spacing > length + 2.0 * kRamp)) {
      throw_argument(name, "0, or more than the length of one, " + to_text(length) + " m",
                     to_text(spacing));
    }
  }
  check_range("anode_length", anode_length, 2.0 * kRamp, 1000.0);
  check_range("joint_length", joint_length, 2.0 * kRamp, 1000.0);
  check_range("anode_thickness", anode_thickness, 1e-4, 10.0);
  check_positive("joint_recess", joint_recess);
  if (joint_spacing > 0.0 && !(joint_recess < 0.5 * diameter)) {
    throw_argument("joint_recess", "less than the radius, " + to_text(0.5 * diameter) + " m",
                   to_text(joint_recess));
  }
  check_range("step", step, 1e-3, 1e6);
  check_range("sides", sides, 3, 256);
  resolve_threads(num_threads);
}

Pipeline make_pipeline(const std::vector<Vec2>& route, const Scene& terrain, double diameter,
                       const PipelineOptions& options) {
  options.check(diameter, route.size());
  const generate::RouteCurve curve(flat_route(route));
  check_spans(options, curve.length());
  return lay_pipe(start_pipe(curve, diameter, options), curve.knots(), terrain, diameter, options);
}

Pipeline make_pipeline(const std::vector<Vec3>& route, double diameter,
                       const PipelineOptions& options) {
  options.check(diameter, route.size());
  if (!options.burial.empty() && options.burial != std::vector<double>{0.0}) {
    throw_argument("burial", "0 where there is no terrain to lie in", "another value");
  }
  if (!options.spans.empty()) {
    throw_argument("spans", "none where there is no terrain to lie on",
                   std::to_string(options.spans.size()));
  }
  const generate::RouteCurve curve(route);
  Started started = start_pipe(curve, diameter, options);
  const std::vector<double> unknown(started.line.kp.size(),
                                    std::numeric_limits<double>::quiet_NaN());
  started.line.bottom = started.line.burial = started.line.gap = unknown;
  sweep_pipe(started.radius, options.sides, started.line);
  return std::move(started.line);
}

}  // namespace bathyal
