// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/world/generate/internal/seabed_parts.hpp"

#include <cmath>

#include "bathyal/world/generate/internal/cells.hpp"

namespace bathyal {
namespace {

/// Distance [m] of a place to the left of a line through `point` along `direction`.
double left_of(const Vec2& point, double direction, double x, double y) {
  return std::cos(direction) * (y - point.y()) - std::sin(direction) * (x - point.x());
}

double ahead_of(const Vec2& point, double direction, double x, double y) {
  return std::cos(direction) * (x - point.x()) + std::sin(direction) * (y - point.y());
}

}  // namespace

SeabedModel::Parts::Parts(const SeabedOptions& o)
    : options(o),
      relief(o.seed, generate::kReliefStream, o.relief_rms, o.relief_exponent, o.relief_longest,
             o.relief_shortest),
      ripples(o),
      boulders(o),
      edges(o.seed, generate::kEdgeStream, o.edge_meander, 4.0, 60.0, 8.0) {}

SeabedModel::Parts::Columns SeabedModel::Parts::columns(const std::vector<double>& x) const {
  const double* data = x.data();
  return {relief.columns(data, x.size()), ripples.meander().columns(data, x.size()),
          ripples.patches().columns(data, x.size()), edges.columns(data, x.size())};
}

void SeabedModel::Parts::row(const Columns& columns, double y, std::vector<Fields>& fields) const {
  std::vector<double> height(fields.size());
  relief.row(columns.relief, y, height.data());
  for (std::size_t i = 0; i < fields.size(); ++i) fields[i].relief = height[i];
  ripples.meander().row(columns.meander, y, height.data());
  for (std::size_t i = 0; i < fields.size(); ++i) fields[i].meander = height[i];
  ripples.patches().row(columns.patch, y, height.data());
  for (std::size_t i = 0; i < fields.size(); ++i) fields[i].patch = height[i];
  edges.row(columns.edge, y, height.data());
  for (std::size_t i = 0; i < fields.size(); ++i) fields[i].edge = height[i];
}

SeabedModel::Parts::Place SeabedModel::Parts::place(double x, double y,
                                                    const Fields& fields) const {
  Place place;
  const double rise = std::cos(options.slope_direction) * x + std::sin(options.slope_direction) * y;
  place.height = fields.relief + (std::tan(options.slope) * rise - options.depth);
  generate::BoulderField::Part boulder;
  if (boulders.any()) boulder = boulders.at(x, y);
  if (ripples.any() && boulder.bare > 0.0) {
    const double cover = boulder.bare * ripples.cover(fields.patch);
    if (cover > 0.0) place.height += cover * ripples.at(x, y, fields.meander);
    if (cover >= 0.5) place.material = SeabedMaterial::kSand;
  }
  place.height += boulder.height;
  if (boulder.rock) place.material = SeabedMaterial::kRock;
  if (options.trench_depth > 0.0) place.height -= trench(x, y, fields.edge);
  if (options.cliff_height > 0.0) {
    const double share = cliff_share(x, y, fields.edge);
    place.height += options.cliff_height * (0.5 - generate::smooth(share));
    if (share > 0.0 && share < 1.0) place.material = SeabedMaterial::kRock;
  }
  if (!options.scour_points.empty()) place.height -= scour(x, y);
  return place;
}

/// Depth below the bottom around it: a flat floor, walls that are smooth at top and bottom.
double SeabedModel::Parts::trench(double x, double y, double edge) const {
  const double off = left_of(options.trench_point, options.trench_direction, x, y) - edge;
  const double top = 0.5 * options.trench_width;
  const double wall = top - 0.5 * options.trench_floor;
  return options.trench_depth * generate::smooth((top - std::abs(off)) / wall);
}

/// 0 above the cliff, 1 below it.
double SeabedModel::Parts::cliff_share(double x, double y, double edge) const {
  const double off = ahead_of(options.cliff_point, options.cliff_direction, x, y) - edge;
  return off / options.cliff_run + 0.5;
}

/// The deepest of the hollows.
double SeabedModel::Parts::scour(double x, double y) const {
  double deepest = 0.0;
  for (const Vec2& point : options.scour_points) {
    const double t = std::hypot(x - point.x(), y - point.y()) / options.scour_radius;
    if (t < 1.0) deepest = std::max(deepest, (1.0 - t * t) * (1.0 - t * t));
  }
  return options.scour_depth * deepest;
}

}  // namespace bathyal
