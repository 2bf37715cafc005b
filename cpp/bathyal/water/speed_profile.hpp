// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

namespace bathyal {

/// Sound speed by depth, linear between rows: layers of constant gradient, in which rays of sound
/// are arcs of circles. Above the first row and below the last it goes on as there.
class SpeedProfile {
 public:
  /// The same at every depth [m/s].
  explicit SpeedProfile(double speed);

  /// \param depth rising [m] \param speed [m/s], above 0
  /// \throw std::invalid_argument for no row, depths that do not rise, another count of speeds, or
  ///        one that is not above 0 and finite.
  SpeedProfile(std::vector<double> depth, std::vector<double> speed);

  double speed(double depth) const;
  const std::vector<double>& depth() const { return depth_; }
  const std::vector<double>& speed() const { return speed_; }

  /// Layer i lies between rows i − 1 and i: layer 0 above the first, layer size() below the last.
  std::size_t layer_count() const { return depth_.size() + 1; }
  double gradient(std::size_t layer) const { return gradient_[layer]; }  ///< of the speed [1/s]
  double top(std::size_t layer) const;                                   ///< depth [m], or −∞
  double bottom(std::size_t layer) const;                                ///< depth [m], or ∞

  /// The layer of a depth; on a row that below it.
  std::size_t layer(double depth) const;

 private:
  std::vector<double> depth_;
  std::vector<double> speed_;
  std::vector<double> gradient_;  ///< of each layer
};

}  // namespace bathyal
