// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/geometry/triangle_mesh.hpp"

#include <utility>

#include "bathyal/base/error.hpp"

namespace bathyal {
namespace {

void check_indices(TriangleView triangles, Index vertex_count) {
  for (Index t = 0; t < triangles.rows(); ++t) {
    for (int c = 0; c < 3; ++c) {
      const auto index = triangles(t, c);
      if (index < 0 || index >= vertex_count) {
        throw_argument("triangles", "vertex indices from 0 to " + std::to_string(vertex_count - 1),
                       std::to_string(index) + " in row " + std::to_string(t));
      }
    }
  }
}

}  // namespace

TriangleMesh::TriangleMesh(Points vertices, Triangles triangles, Attributes attributes, Datum datum)
    : vertices_(std::move(vertices)),
      triangles_(std::move(triangles).snapshot()),
      attributes_(std::move(attributes)),
      datum_(std::move(datum)) {
  check_points_finite("vertices", vertices_.view());
  check_indices(triangles_.view(), vertices_.rows());
  check_attributes(attributes_, vertices_.rows());
}

TriangleMesh TriangleMesh::snapshot() const {
  if (!vertices_.writable()) return *this;
  return {vertices_.snapshot(), triangles_, bathyal::snapshot(attributes_), datum_};
}

}  // namespace bathyal
