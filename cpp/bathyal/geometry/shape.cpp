// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/geometry/shape.hpp"

#include "bathyal/base/check.hpp"

namespace bathyal {

void Shape::check(std::string_view owner) const {
  const std::string prefix = owner.empty() ? "" : std::string(owner) + " ";
  for (const double value : size) check_not_negative(prefix + "size", value);
  check_not_negative(prefix + "radius", radius);
  check_not_negative(prefix + "length", length);
  if (kind == ShapeKind::kMesh && file.empty()) {
    throw_argument(prefix + "file", "the name of a mesh's file", "none");
  }
  for (const double value : scale) {
    check_finite(prefix + "scale", value);
    if (value == 0.0) throw_argument(prefix + "scale", "numbers other than 0", "0");
  }
  check_rigid(prefix + "pose", body_from_shape);
}

}  // namespace bathyal
