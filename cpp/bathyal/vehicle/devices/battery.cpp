// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/vehicle/devices/battery.hpp"

#include <utility>

#include "bathyal/base/check.hpp"

namespace bathyal {

void BatteryOptions::check() const {
  check_positive("capacity", capacity);
  check_not_negative("resistance", resistance);
  if (charge.size() < 2) {
    throw_argument("charge", "2 numbers or more", std::to_string(charge.size()));
  }
  if (voltage.size() != charge.size()) {
    throw_argument("voltage", std::to_string(charge.size()) + " numbers, one a charge",
                   std::to_string(voltage.size()));
  }
  if (charge.front() != 0.0 || charge.back() != 1.0) {
    throw_argument("charge", "numbers from 0 to 1",
                   to_text(charge.front()) + " to " + to_text(charge.back()));
  }
  for (std::size_t i = 0; i < charge.size(); ++i) {
    check_positive("voltage", voltage[i]);
    if (i == 0) continue;
    if (!(charge[i] > charge[i - 1]))
      throw_argument("charge", "rising numbers", to_text(charge[i]));
    if (voltage[i] < voltage[i - 1]) {
      throw_argument("voltage", "numbers that never fall", to_text(voltage[i]));
    }
  }
}

Battery::Battery(BatteryOptions options) : options_(std::move(options)) { options_.check(); }

double Battery::open_circuit(double charge) const {
  if (!(charge > 0.0)) return 0.0;
  const std::vector<double>& at = options_.charge;
  if (charge >= 1.0) return options_.voltage.back();
  const auto high =
      static_cast<std::size_t>(std::upper_bound(at.begin(), at.end(), charge) - at.begin());
  const double share = (charge - at[high - 1]) / (at[high] - at[high - 1]);
  return options_.voltage[high - 1] + share * (options_.voltage[high] - options_.voltage[high - 1]);
}

}  // namespace bathyal
