// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <numbers>
#include <string>

#include "bathyal/base/check.hpp"
#include "bathyal/world/generate/internal/mesh_builder.hpp"
#include "bathyal/world/generate/solids.hpp"

namespace bathyal {
namespace {

/// Horns at equal distances over the upper half, by the golden angle.
void add_horns(generate::MeshBuilder& builder, double radius, int horns) {
  for (int i = 0; i < horns; ++i) {
    const double z = 0.97 - 0.8 * i / horns;
    const double angle = 2.0 * std::numbers::pi * i / std::numbers::phi;
    const double across = std::sqrt(1.0 - z * z);
    const Vec3 out(across * std::cos(angle), across * std::sin(angle), z);
    builder.cylinder(0.9 * radius * out, 1.22 * radius * out, 0.055 * radius, 8);
  }
}

void add_manta(generate::MeshBuilder& builder, double radius, double height, int sides) {
  const Vec3 x = Vec3::UnitX();
  const Vec3 y = Vec3::UnitY();
  builder.loft(
      {generate::ellipse(Vec3::Zero(), x, y, radius, radius, sides),
       generate::ellipse(height * Vec3::UnitZ(), x, y, 0.5 * radius, 0.5 * radius, sides)});
}

}  // namespace

void MineOptions::check() const {
  if (diameter) check_range("diameter", *diameter, 1e-3, 1e3);
  if (length) check_range("length", *length, 1e-3, 1e3);
  check_range("horns", horns, 0, 100);
  check_range("sides", sides, 8, 1024);
  if (sides % 2 != 0) throw_argument("sides", "an even number", std::to_string(sides));
}

TriangleMesh make_mine(MineKind kind, const MineOptions& options) {
  options.check();
  generate::MeshBuilder builder;
  if (kind == MineKind::kCylinder) {
    const Vec3 half(0.5 * options.length.value_or(2.2), 0.0, 0.0);
    builder.cylinder(-half, half, 0.5 * options.diameter.value_or(0.53), options.sides);
  } else if (kind == MineKind::kSphere) {
    const double radius = 0.5 * options.diameter.value_or(1.0);
    builder.sphere(Vec3::Zero(), radius, options.sides);
    add_horns(builder, radius, options.horns);
  } else {
    add_manta(builder, 0.5 * options.diameter.value_or(0.98), options.length.value_or(0.47),
              options.sides);
  }
  builder.rest();
  return builder.mesh();
}

}  // namespace bathyal
