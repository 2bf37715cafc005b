// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/sonar/internal/echo_rows.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace bathyal::sonar {
namespace {

/// On the border of a sample, where rounding alone keeps it off.
double snapped(double place) {
  constexpr double kRounding = 1e-9;
  if (!(place > 0.0 && place < 1e9)) return place;
  const auto border = static_cast<double>(static_cast<std::int64_t>(place + 0.5));
  return std::abs(place - border) < kRounding ? border : place;
}

/// The whole number below one that is not negative.
double whole(double place) { return static_cast<double>(static_cast<std::int64_t>(place)); }

}  // namespace

void EchoRow::reset(std::size_t samples, double sample_length) {
  take();
  power_.resize(samples, 0.0);
  strongest_.resize(samples);
  sample_length_ = sample_length;
}

void EchoRow::put(std::size_t sample, double weight, const Return& back) {
  power_[sample] += weight;
  Strongest& best = strongest_[sample];
  if (!(weight > best.weight)) return;
  const double low = static_cast<double>(sample) * sample_length_;
  const double range = std::clamp(back.range, low, low + sample_length_);
  best = {weight, range, back.incidence_cosine, back.material,
          back.point + (range - back.range) * back.slide};
}

void EchoRow::add(const Return& back) {
  const auto count = static_cast<double>(power_.size());
  const double middle = back.range / sample_length_;
  if (!(back.half > 0.0)) {  // a point
    const double place = snapped(middle);
    if (!(place >= 0.0 && place < count)) return;
    const auto sample = static_cast<std::size_t>(place);
    touch(sample, sample);
    put(sample, back.weight, back);
    return;
  }
  const double half = back.half / sample_length_;
  const double low =
      snapped(std::max(middle - half, std::min(middle, back.least / sample_length_)));
  const double high = snapped(middle + half);
  if (!(low < count) || high < 0.0) return;
  const double first = whole(std::max(low, 0.0));
  const double last = std::min(whole(std::min(high, count)), count - 1.0);
  touch(static_cast<std::size_t>(first), static_cast<std::size_t>(last));
  if (first >= last && low >= first && high < first + 1.0) {
    put(static_cast<std::size_t>(first), back.weight, back);
    return;
  }
  const double density = back.weight / (high - low);
  for (double sample = first; sample <= last; sample += 1.0) {
    const double part = std::min(high, sample + 1.0) - std::max(low, sample);
    if (part > 0.0) put(static_cast<std::size_t>(sample), density * part, back);
  }
}

void EchoRow::add(const EchoPart& later) {
  if (later.power.empty()) return;
  touch(later.first, later.first + later.power.size() - 1);
  for (std::size_t i = 0; i < later.power.size(); ++i) {
    power_[later.first + i] += later.power[i];
    Strongest& best = strongest_[later.first + i];
    if (later.strongest[i].weight > best.weight) best = later.strongest[i];
  }
}

EchoPart EchoRow::take() {
  const auto begin = static_cast<std::ptrdiff_t>(first_), end = static_cast<std::ptrdiff_t>(end_);
  EchoPart part{first_,
                {power_.begin() + begin, power_.begin() + end},
                {strongest_.begin() + begin, strongest_.begin() + end}};
  std::fill(power_.begin() + begin, power_.begin() + end, 0.0);
  std::fill(strongest_.begin() + begin, strongest_.begin() + end, Strongest());
  first_ = end_ = 0;
  return part;
}

void EchoRow::touch(std::size_t first, std::size_t last) {
  const bool empty = first_ == end_;
  first_ = empty ? first : std::min(first_, first);
  end_ = empty ? last + 1 : std::max(end_, last + 1);
}

}  // namespace bathyal::sonar
