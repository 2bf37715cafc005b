// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/sonar/internal/echo_rows.hpp"

#include <algorithm>
#include <cmath>

namespace bathyal::sonar {

void EchoRow::put(std::size_t sample, double weight, const Return& back) {
  power[sample] += weight;
  Strongest& best = strongest[sample];
  if (!(weight > best.weight)) return;
  const double low = static_cast<double>(sample) * sample_length_;
  const double range = std::clamp(back.range, low, low + sample_length_);
  best = {weight, range, back.incidence_cosine, back.material,
          back.point + (range - back.range) * back.slide};
}

void EchoRow::add(const Return& back) {
  const auto count = static_cast<double>(power.size());
  const double middle = back.range / sample_length_;
  const double half = back.half / sample_length_;
  const double low = middle - half;
  const double high = middle + half;
  if (!(low < count) || high < 0.0) return;
  const double first = std::floor(std::max(low, 0.0));
  const double last = std::min(std::floor(high), count - 1.0);
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

void EchoRow::add(const EchoRow& later) {
  for (std::size_t i = 0; i < power.size(); ++i) {
    power[i] += later.power[i];
    if (later.strongest[i].weight > strongest[i].weight) strongest[i] = later.strongest[i];
  }
}

}  // namespace bathyal::sonar
