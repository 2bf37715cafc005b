// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/world/generate/internal/ripples.hpp"

#include <cmath>
#include <numbers>

#include "bathyal/world/generate/internal/cells.hpp"

namespace bathyal::generate {
namespace {

constexpr double kTurn = 2.0 * std::numbers::pi;
constexpr double kCell = 6.0;   // side of a cell of dislocations, in wavelengths
constexpr double kInner = 1.1;  // up to here from a pair's middle its phase is its own,
constexpr double kOuter = 2.5;  // and from here on none
constexpr double kCore = 0.35;  // ripples are lower within this distance of a dislocation

/// The lean `a` of sin(φ − a sin φ) whose crest divides the wavelength into stoss and lee lengths
/// that differ by `asymmetry` wavelengths: the crest is at φ = π (1 + asymmetry) / 2.
double lean_of(double asymmetry) {
  const double beyond = 0.5 * std::numbers::pi * asymmetry;
  return beyond / std::cos(beyond);
}

}  // namespace

Ripples::Ripples(const SeabedOptions& o)
    : seed_(o.seed),
      height_(o.ripple_height),
      wavelength_(o.ripple_wavelength),
      cosine_(std::cos(o.ripple_direction)),
      sine_(std::sin(o.ripple_direction)),
      lean_(lean_of(o.ripple_asymmetry)),
      defects_(o.ripple_defects),
      cover_(o.ripple_cover),
      meander_(o.seed, kMeanderStream, o.ripple_height > 0.0 ? kTurn * o.ripple_meander : 0.0, 4.0,
               24.0 * o.ripple_wavelength, 6.0 * o.ripple_wavelength),
      patches_(o.seed, kPatchStream, o.ripple_cover < 1.0 ? 1.0 : 0.0, 3.0, 2.0 * o.ripple_patch,
               0.5 * o.ripple_patch) {}

double Ripples::cover(double patch) const {
  if (cover_ >= 1.0 || cover_ <= 0.0) return cover_;
  // The normal distribution makes the field uniform: its share above 1 − cover is the cover.
  const double share = 0.5 * std::erfc(-patch / std::numbers::sqrt2);
  return smooth((share - (1.0 - cover_)) / 0.1 + 0.5);
}

double Ripples::at(double x, double y, double meander) const {
  const Fault fault = faults(x, y);
  const double along = cosine_ * x + sine_ * y;
  const double phase = kTurn / wavelength_ * along + meander + fault.phase;
  return 0.5 * height_ * fault.amplitude * std::sin(phase - lean_ * std::sin(phase));
}

/// A pair of dislocations adds the angle under which its ends are seen: it grows by 2π around one
/// end and falls by 2π around the other, and jumps by 2π, which no wave notices, between them.
Ripples::Fault Ripples::faults(double x, double y) const {
  Fault fault;
  if (defects_ == 0.0) return fault;
  const double side = kCell * wavelength_;
  visit_cells(seed_, kDefectStream, side, x, y, [&](RandomStream& random, double x0, double y0) {
    if (random.uniform() >= defects_) return;
    const double dx = x - (x0 + side * random.uniform(0.4, 0.6));
    const double dy = y - (y0 + side * random.uniform(0.4, 0.6));
    const double distance = std::hypot(dx, dy) / wavelength_;
    const double half = wavelength_ * random.uniform(0.5, 1.0);
    const double angle = random.uniform(0.0, kTurn);
    if (distance >= kOuter) return;
    const double ex = half * std::cos(angle);
    const double ey = half * std::sin(angle);
    const double ax = dx - ex, ay = dy - ey, bx = dx + ex, by = dy + ey;
    const double seen = std::atan2(ax * by - ay * bx, ax * bx + ay * by);
    fault.phase += seen * (1.0 - smooth((distance - kInner) / (kOuter - kInner)));
    const double core = kCore * kCore * wavelength_ * wavelength_;
    fault.amplitude *= (1.0 - std::exp(-(ax * ax + ay * ay) / core)) *
                       (1.0 - std::exp(-(bx * bx + by * by) / core));
  });
  return fault;
}

}  // namespace bathyal::generate
