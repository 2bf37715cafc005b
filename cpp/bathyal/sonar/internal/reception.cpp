// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/sonar/internal/reception.hpp"

#include <algorithm>
#include <cmath>

#include "bathyal/sonar/internal/beam_pattern.hpp"

namespace bathyal::sonar {
namespace {

constexpr double kWidthsOfTable = 16.0;  ///< halves; beyond them the pattern itself
constexpr std::size_t kRowsOfWidth = 128;
}  // namespace

Reception::Reception(const SonarOptions& options, const Beam& beam)
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
      behind_cosine_(std::cos(options.tilt - options.axis_tilt)) {
  if (pattern_ == BeamPattern::kNone) return;
  const auto rows = static_cast<std::size_t>(kWidthsOfTable) * kRowsOfWidth;
  for (std::size_t row = 0; row <= rows; ++row) {
    table_.push_back(pattern_shape(pattern_, static_cast<double>(row) / kRowsOfWidth));
  }
}

double Reception::shape(double off) const {
  const double place = std::abs(off) * kRowsOfWidth;
  const auto row = static_cast<std::size_t>(place);
  if (row + 1 >= table_.size()) return pattern_shape(pattern_, std::abs(off));
  return table_[row] + (place - static_cast<double>(row)) * (table_[row + 1] - table_[row]);
}

double Reception::power(const Vec3& direction) const {
  const bool box = pattern_ == BeamPattern::kNone;
  const double forward = direction.dot(axis_);
  if (round_) {
    if (box) return forward >= least_cosine_;
    return shape(std::sqrt(std::max(1.0 - forward * forward, 0.0)) / beam_half_);
  }
  const double sine = direction.dot(array_);
  const double cosine = std::sqrt(std::max(1.0 - sine * sine, 1e-12));
  if (box) {
    return sine >= low_ && sine <= high_ && (swath_ || forward >= least_cosine_ * cosine);
  }
  const double across = shape((sine - steered_) / beam_half_);
  if (swath_) return across;
  const double off = direction.dot(up_) * behind_cosine_ - forward * behind_sine_;
  return across * shape(off / (cosine * fan_half_));
}

}  // namespace bathyal::sonar
