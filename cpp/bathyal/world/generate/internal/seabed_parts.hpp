// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "bathyal/world/generate/internal/boulder_field.hpp"
#include "bathyal/world/generate/internal/ripples.hpp"
#include "bathyal/world/generate/seabed.hpp"

namespace bathyal {

/// What a bottom is the sum of.
struct SeabedModel::Parts {
  explicit Parts(const SeabedOptions& options);

  /// What sums of waves have at a place; a mesh computes them row by row.
  struct Fields {
    double relief = 0.0, meander = 0.0, patch = 0.0, edge = 0.0;
  };
  Fields fields(double x, double y) const {
    return {relief.at(x, y), ripples.meander().at(x, y), ripples.patches().at(x, y),
            edges.at(x, y)};
  }

  /// The same at all places x of a row, from what its columns have in common: the same bytes.
  struct Columns {
    generate::Relief::Columns relief, meander, patch, edge;
  };
  Columns columns(const std::vector<double>& x) const;
  void row(const Columns& columns, double y, std::vector<Fields>& fields) const;

  /// Height [m], and what lies there.
  struct Place {
    double height = 0.0;
    SeabedMaterial material = SeabedMaterial::kSilt;
  };
  Place place(double x, double y, const Fields& fields) const;

  SeabedOptions options;
  generate::Relief relief;
  generate::Ripples ripples;
  generate::BoulderField boulders;
  generate::Relief edges;  ///< how trench and cliff wander

 private:
  double trench(double x, double y, double edge) const;
  double cliff_share(double x, double y, double edge) const;
  double scour(double x, double y) const;
};

}  // namespace bathyal
