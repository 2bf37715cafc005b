// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/sonar/internal/reception.hpp"

#include <algorithm>
#include <cmath>

namespace bathyal::sonar {

Reception::Reception(const SonarOptions& options, const Beam& beam, double half_phi)
    : pattern_(options.beam_pattern),
      round_(options.kind == SonarKind::kEchoSounder),
      swath_(options.kind == SonarKind::kMultibeam),
      array_(beam.array),
      axis_(beam.axis),
      up_(beam.up()),
      steered_(std::sin(beam.steered)),
      beam_half_(std::sin(0.5 * options.beam_width)),
      fan_half_(std::sin(0.5 * options.fan_width)),
      low_(std::sin(std::max(beam.steered - 0.5 * options.beam_width, -std::asin(1.0)))),
      high_(std::sin(std::min(beam.steered + 0.5 * options.beam_width, std::asin(1.0)))),
      least_cosine_(std::cos(0.5 * (round_ ? options.beam_width : options.fan_span))),
      behind_sine_(std::sin(options.tilt - options.axis_tilt)),
      behind_cosine_(std::cos(options.tilt - options.axis_tilt)),
      cell_sine_(std::sin(half_phi)),
      cell_cosine_(std::cos(half_phi)),
      mean_(pattern_mean(options.beam_pattern, false)) {}

double Reception::power(const Vec3& direction) const {
  const bool box = pattern_ == BeamPattern::kNone;
  const double forward = direction.dot(axis_);
  if (round_) {
    if (box) return forward >= least_cosine_;
    return mean_(std::sqrt(std::max(1.0 - forward * forward, 0.0)) / beam_half_, 0.0);
  }
  const double sine = direction.dot(array_);
  const double cosine = std::sqrt(std::max(1.0 - sine * sine, 1e-12));
  if (box) {
    return sine >= low_ && sine <= high_ && (swath_ || forward >= least_cosine_ * cosine);
  }
  const double across =
      mean_((sine * cell_cosine_ - steered_) / beam_half_, cosine * cell_sine_ / beam_half_);
  if (swath_) return across;
  const double off = direction.dot(up_) * behind_cosine_ - forward * behind_sine_;
  return across * mean_(off / (cosine * fan_half_), 0.0);
}

}  // namespace bathyal::sonar
