// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <string>

#include "bathyal/geometry/shared_array.hpp"

namespace bathyal {

/// Named numbers that ride along with points or vertices (uncertainty [m], intensity, red, green,
/// blue, …): each as long as the points.
using Attributes = std::map<std::string, Values>;

/// What positions refer to. Empty text means unknown; nothing here is guessed.
struct Datum {
  std::string crs;       ///< coordinate reference system: "EPSG:…" or WKT
  std::string vertical;  ///< vertical datum, as the source names it
};

/// Positions in metres, z up, in double: survey coordinates (10⁵ to 10⁷ m) are kept as they are and
/// each kernel subtracts a local origin for itself (local_origin).
class PointCloud {
 public:
  PointCloud() = default;

  /// \throw std::invalid_argument when an attribute is not as long as `points`. Points that are not
  /// finite are allowed here, so that they can be counted and dropped by clean_cloud.
  explicit PointCloud(Points points, Attributes attributes = {}, Datum datum = {});

  PointView points() const { return points_.view(); }
  const Points& shared_points() const { return points_; }
  const Attributes& attributes() const { return attributes_; }
  const Datum& datum() const { return datum_; }
  Index size() const { return points_.rows(); }

  /// The same cloud over points and attributes that nobody can write to: see SharedArray.
  PointCloud snapshot() const;

 private:
  Points points_;
  Attributes attributes_;
  Datum datum_;
};

/// The origin a kernel subtracts before it works: the middle of the bounding box of the finite
/// points, snapped to whole metres; zero where there is no finite point.
Vec3 local_origin(PointView points);

/// \throw std::invalid_argument that names `name` and the first row that is not finite.
void check_points_finite(std::string_view name, PointView points);

/// \throw std::invalid_argument when an attribute's length is not `count`.
void check_attributes(const Attributes& attributes, Index count);

/// A snapshot of each.
Attributes snapshot(const Attributes& attributes);

}  // namespace bathyal
