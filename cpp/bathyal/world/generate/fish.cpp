// SPDX-License-Identifier: BSD-3-Clause
#include <array>
#include <cmath>

#include "bathyal/base/check.hpp"
#include "bathyal/world/generate/internal/mesh_builder.hpp"
#include "bathyal/world/generate/solids.hpp"

namespace bathyal {
namespace {

/// Of a length of 1: place along it, half height, half width.
constexpr std::array<std::array<double, 3>, 10> kBody{{{0.47, 0.025, 0.018},
                                                       {0.42, 0.055, 0.038},
                                                       {0.34, 0.085, 0.055},
                                                       {0.22, 0.112, 0.066},
                                                       {0.08, 0.120, 0.066},
                                                       {-0.06, 0.108, 0.057},
                                                       {-0.18, 0.080, 0.042},
                                                       {-0.28, 0.045, 0.024},
                                                       {-0.34, 0.028, 0.014},
                                                       {-0.38, 0.024, 0.010}}};

using Outline = std::vector<std::array<double, 2>>;  ///< x, z, counter-clockwise seen from −y

/// A thin vertical plate with the given outline.
void add_fin(generate::MeshBuilder& builder, const Outline& outline, double thickness) {
  generate::Ring port, starboard;
  for (const auto& [x, z] : outline) {
    starboard.emplace_back(x, -0.5 * thickness, z);
    port.emplace_back(x, 0.5 * thickness, z);
  }
  // Counter-clockwise seen from −y is counter-clockwise about −y: from port to starboard.
  builder.loft({port, starboard});
}

}  // namespace

void FishOptions::check() const { check_range("sides", sides, 4, 256); }

TriangleMesh make_fish(double length, const FishOptions& options) {
  check_range("length", length, 1e-3, 100.0);
  options.check();
  generate::MeshBuilder builder;
  std::vector<generate::Ring> rings;
  for (const auto& section : kBody) {
    // The rings follow one another towards −x: counter-clockwise about it is from z towards y.
    rings.push_back(generate::ellipse(Vec3(section[0], 0.0, 0.0), Vec3::UnitZ(), Vec3::UnitY(),
                                      section[1], section[2], options.sides));
  }
  builder.loft(rings, Vec3(0.5, 0.0, 0.0), Vec3(-0.4, 0.0, 0.0));
  add_fin(builder, {{-0.36, 0.02}, {-0.5, 0.13}, {-0.44, 0.0}, {-0.5, -0.13}, {-0.36, -0.02}},
          0.012);
  add_fin(builder, {{0.16, 0.10}, {0.02, 0.18}, {-0.14, 0.15}, {-0.12, 0.07}}, 0.012);
  for (Vec3& vertex : builder.vertices()) vertex *= length;
  return builder.mesh();
}

}  // namespace bathyal
