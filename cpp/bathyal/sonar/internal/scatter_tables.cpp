// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/sonar/internal/scatter_tables.hpp"

#include <algorithm>
#include <utility>

#include "bathyal/sonar/backscatter.hpp"

namespace bathyal::sonar {

ScatterTables::ScatterTables(const SonarOptions& options,
                             std::shared_ptr<const std::vector<Material>> materials)
    : materials_(std::move(materials)) {
  const bool by_material = options.backscatter == BackscatterModel::kMaterial;
  for (const Material& material : *materials_) {
    Law law{material.strength, {}, {}};
    const bool has_law = !material.angle.empty() || material.sediment;
    const bool tabulated = by_material && has_law;
    uses_sediment_ = uses_sediment_ || (tabulated && material.angle.empty());
    for (std::size_t row = 0; row <= kRows; ++row) {
      const double root = static_cast<double>(row) / static_cast<double>(kRows);
      const double cosine = std::max(1.0 - root * root, kLeastCosine);
      if (tabulated)
        law.scattered.push_back(bathyal::backscatter(material, cosine, options.frequency) / cosine);
      if (options.multiples > 0) law.reflected.push_back(reflected_power(material, cosine));
    }
    laws_.push_back(std::move(law));
  }
}

std::shared_ptr<const ScatterTables> ScatterCache::tables(
    const SonarOptions& options, const std::shared_ptr<const std::vector<Material>>& materials) {
  const std::lock_guard<std::mutex> locked(mutex_);
  if (!last_ || last_->materials() != materials)
    last_ = std::make_shared<const ScatterTables>(options, materials);
  return last_;
}

}  // namespace bathyal::sonar
