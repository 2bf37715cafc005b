// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/world/generate/internal/boulder_field.hpp"

#include <cmath>
#include <numbers>

#include "bathyal/world/generate/internal/cells.hpp"

namespace bathyal::generate {
namespace {

/// How many events happen whose mean number is `mean` (Knuth): small means only.
int poisson(RandomStream& random, double mean) {
  const double limit = std::exp(-mean);
  int count = 0;
  for (double product = random.uniform(); product > limit; product *= random.uniform()) ++count;
  return count;
}

struct Dome {
  double x, y, along, across, angle, height;
};

/// Numbers of radii fall off with their cube, from the largest down to a fifth of it.
Dome draw_dome(RandomStream& random, double largest, double x0, double y0, double side) {
  const double radius = 0.2 * largest / std::sqrt(1.0 - 0.96 * random.uniform());
  Dome dome{};
  dome.x = x0 + side * random.uniform();
  dome.y = y0 + side * random.uniform();
  dome.along = radius * random.uniform(1.0, 1.4);
  dome.across = radius * random.uniform(0.7, 1.0);
  dome.angle = random.uniform(0.0, std::numbers::pi);
  dome.height = radius * random.uniform(0.5, 0.9);
  return dome;
}

/// Distance from the dome's middle, 1 on its rim.
double rim_distance(const Dome& dome, double x, double y) {
  const double dx = x - dome.x;
  const double dy = y - dome.y;
  const double c = std::cos(dome.angle);
  const double s = std::sin(dome.angle);
  return std::hypot((c * dx + s * dy) / dome.along, (c * dy - s * dx) / dome.across);
}

}  // namespace

BoulderField::BoulderField(const SeabedOptions& options)
    : seed_(options.seed),
      density_(options.boulder_density),
      radius_(options.boulder_radius),
      scour_(options.boulder_scour) {}

BoulderField::Part BoulderField::at(double x, double y) const {
  Part part;
  const double cell = side(radius_);
  const double mean = density_ * cell * cell;
  double rise = 0.0;
  double hollow = 0.0;
  visit_cells(seed_, kBoulderStream, cell, x, y, [&](RandomStream& random, double x0, double y0) {
    const int count = poisson(random, mean);
    for (int i = 0; i < count; ++i) {
      const Dome dome = draw_dome(random, radius_, x0, y0, cell);
      const double reach = 2.2 * dome.along;
      if (std::abs(x - dome.x) >= reach || std::abs(y - dome.y) >= reach) continue;
      const double q = rim_distance(dome, x, y);
      if (q < 1.0) {
        part.rock = true;
        rise = std::max(rise, dome.height * std::pow(1.0 - q * q, 0.75));
      }
      hollow = std::max(hollow, scour_ * dome.height * smooth(1.0 - std::abs(q - 1.1) / 0.9));
      part.bare = std::min(part.bare, smooth((q - 1.0) / 0.4));
    }
  });
  part.height = rise - hollow;
  return part;
}

}  // namespace bathyal::generate
