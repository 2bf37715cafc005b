// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <vector>

#include "bathyal/sonar/sonar.hpp"
#include "bathyal/world/material.hpp"

namespace bathyal::sonar {

/// The cosine below which a surface counts as seen along its edge.
inline constexpr double kLeastCosine = 1e-4;

/// σ₀ / cos θ and |Γ|² of every material at one frequency, in steps of √(1 − cos θ), which are
/// about even in θ; linear between.
class ScatterTables {
 public:
  ScatterTables(const SonarOptions& options,
                std::shared_ptr<const std::vector<Material>> materials);

  /// σ₀ / cos θ, of a cosine from kLeastCosine to 1.
  double over_cosine(std::int32_t material, double cosine) const {
    const Law& law = laws_[static_cast<std::size_t>(material)];
    return law.scattered.empty() ? law.strength * cosine : at(law.scattered, cosine);
  }

  /// |Γ|² at a cosine from 0 to 1.
  double reflected(std::int32_t material, double cosine) const {
    return at(laws_[static_cast<std::size_t>(material)].reflected, cosine);
  }

  /// Whether a material's sediment is used.
  bool uses_sediment() const { return uses_sediment_; }

  const std::shared_ptr<const std::vector<Material>>& materials() const { return materials_; }

 private:
  struct Law {
    double strength = 0.0;          ///< of Lambert's law, where there is no table
    std::vector<double> scattered;  ///< σ₀ / cos θ
    std::vector<double> reflected;
  };

  static constexpr std::size_t kRows = 512;

  static double at(const std::vector<double>& table, double cosine) {
    const double place = std::sqrt(std::fmax(1.0 - cosine, 0.0)) * static_cast<double>(kRows);
    const auto row = static_cast<std::size_t>(place);
    if (row >= kRows) return table[kRows];
    return table[row] + (place - static_cast<double>(row)) * (table[row + 1] - table[row]);
  }

  std::shared_ptr<const std::vector<Material>> materials_;
  std::vector<Law> laws_;
  bool uses_sediment_ = false;
};

/// Keeps the tables of the last four lists of materials: worlds may be asked by turns.
class ScatterCache {
 public:
  std::shared_ptr<const ScatterTables> tables(
      const SonarOptions& options, const std::shared_ptr<const std::vector<Material>>& materials);

 private:
  std::mutex mutex_;
  std::vector<std::shared_ptr<const ScatterTables>> last_;  ///< the latest first
};

}  // namespace bathyal::sonar
