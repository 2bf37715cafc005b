// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace bathyal {

/// A source with an inner resistance: V = E(charge) − R I.
struct BatteryOptions {
  std::string name = "battery";
  double capacity = 0.0;        ///< [A h], above 0
  double resistance = 0.0;      ///< inner [Ω], 0 or more
  std::vector<double> charge;   ///< (K,) rising, from 0 to 1
  std::vector<double> voltage;  ///< (K,) open-circuit, at those charges [V], never falling, above 0

  /// \throw std::invalid_argument that names the field
  void check() const;
};

struct BatteryState {
  double charge = 1.0;  ///< share of the capacity that is left
};

/// Voltage and current at one moment.
struct BatteryLoad {
  double voltage = 0.0;    ///< at the terminals [V]
  double current = 0.0;    ///< [A]
  bool collapsed = false;  ///< more power is asked for than it can give; then the most it can
};

class Battery {
 public:
  /// \throw std::invalid_argument as BatteryOptions::check
  explicit Battery(BatteryOptions options);

  const BatteryOptions& options() const { return options_; }

  double open_circuit(double charge) const;  ///< linear between [V]; 0 for an empty one

  /// Voltage and current that agree with each other and with what the loads draw at that voltage:
  /// the largest root of V = E − R P(V) / V, by Newton's method from E, which falls to it where the
  /// power does not rise faster than V². \param power P [W] as a function of V [V]
  template <class Power>
  BatteryLoad solve(const BatteryState& state, const Power& power) const;

  BatteryState drained(const BatteryState& state, double current, double time) const {
    return {std::clamp(state.charge - current * time / (3600.0 * options_.capacity), 0.0, 1.0)};
  }

 private:
  BatteryOptions options_;
};

template <class Power>
BatteryLoad Battery::solve(const BatteryState& state, const Power& power) const {
  constexpr int kMostSteps = 60;
  constexpr double kOff = 1e-6;
  const double source = open_circuit(state.charge), r = options_.resistance;
  if (!(source > 0.0)) return {0.0, 0.0, true};
  double voltage = source;
  for (int k = 0; k < kMostSteps; ++k) {
    const double drawn = power(voltage);
    if (drawn <= 0.0 || r == 0.0) return {source, drawn / source, false};
    const double slope = (power(voltage * (1.0 + kOff)) - drawn) / (voltage * kOff);
    const double off = voltage - source + r * drawn / voltage;
    const double rate = 1.0 + r * (slope - drawn / voltage) / voltage;
    const double next = rate > 0.0 ? voltage - off / rate : 0.0;
    if (!(next > 0.0)) return {0.5 * source, 0.5 * source / r, true};  // the point of most power
    const double moved = std::abs(next - voltage);
    voltage = next;
    if (moved <= 1e-12 * source) break;
  }
  return {voltage, (source - voltage) / r, false};
}

}  // namespace bathyal
