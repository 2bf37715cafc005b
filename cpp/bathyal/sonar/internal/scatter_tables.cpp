// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/sonar/internal/scatter_tables.hpp"

#include <algorithm>
#include <utility>

#include "bathyal/sonar/backscatter.hpp"

namespace bathyal::sonar {
namespace {

constexpr std::size_t kMostLists = 4;

/// The curve of an α; soils often share one.
const RoughnessCurve& curve_of(std::vector<RoughnessCurve>& curves, double alpha) {
  for (const RoughnessCurve& curve : curves) {
    if (curve.alpha() == alpha) return curve;
  }
  return curves.emplace_back(alpha);
}

}  // namespace

ScatterTables::ScatterTables(const SonarOptions& options,
                             std::shared_ptr<const std::vector<Material>> materials)
    : materials_(std::move(materials)) {
  const bool by_material = options.backscatter == BackscatterModel::kMaterial;
  std::vector<RoughnessCurve> curves;
  const auto integral = [&curves](double alpha, double p) { return curve_of(curves, alpha).at(p); };
  const auto scattered = [&](const Material& material, double cosine) {
    return material.angle.empty()
               ? sediment_backscatter(*material.sediment, cosine, options.frequency, integral)
               : bathyal::backscatter(material, cosine, options.frequency);
  };
  for (const Material& material : *materials_) {
    Law law{material.strength, {}, {}};
    const bool has_law = !material.angle.empty() || material.sediment;
    const bool tabulated = by_material && has_law;
    uses_sediment_ = uses_sediment_ || (tabulated && material.angle.empty());
    for (std::size_t row = 0; row <= kRows; ++row) {
      const double root = static_cast<double>(row) / static_cast<double>(kRows);
      const double cosine = std::max(1.0 - root * root, kLeastCosine);
      if (tabulated) law.scattered.push_back(scattered(material, cosine) / cosine);
      if (options.multiples > 0) law.reflected.push_back(reflected_power(material, cosine));
    }
    laws_.push_back(std::move(law));
  }
}

std::shared_ptr<const ScatterTables> ScatterCache::tables(
    const SonarOptions& options, const std::shared_ptr<const std::vector<Material>>& materials) {
  const std::lock_guard<std::mutex> locked(mutex_);
  for (std::size_t i = 0; i < last_.size(); ++i) {
    if (last_[i]->materials() != materials) continue;
    std::rotate(last_.begin(), last_.begin() + static_cast<std::ptrdiff_t>(i),
                last_.begin() + static_cast<std::ptrdiff_t>(i) + 1);
    return last_.front();
  }
  if (last_.size() == kMostLists) last_.pop_back();
  last_.insert(last_.begin(), std::make_shared<const ScatterTables>(options, materials));
  return last_.front();
}

}  // namespace bathyal::sonar
