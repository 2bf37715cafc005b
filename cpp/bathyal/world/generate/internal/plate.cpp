// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/world/generate/internal/plate.hpp"

namespace bathyal::generate {

void SquareMask::join_corners() {
  for (bool changed = true; changed;) {
    changed = false;
    for (int j = 0; j + 1 < rows; ++j) {
      for (int i = 0; i + 1 < columns; ++i) {
        const bool rising = at(i, j) && at(i + 1, j + 1);
        const bool falling = at(i + 1, j) && at(i, j + 1);
        if (rising && !at(i + 1, j) && !at(i, j + 1)) {
          set(i + 1, j, true);
          changed = true;
        } else if (falling && !at(i, j) && !at(i + 1, j + 1)) {
          set(i, j, true);
          changed = true;
        }
      }
    }
  }
}

void add_plate(MeshBuilder& builder, const SquareMask& mask, const std::vector<Vec3>& outer,
               const std::vector<Vec3>& inner) {
  std::vector<std::int32_t> outside(outer.size(), -1);
  std::vector<std::int32_t> inside(outer.size(), -1);
  const auto corner = [&](int i, int j) {
    const auto row = static_cast<std::size_t>(j) * static_cast<std::size_t>(mask.columns + 1) +
                     static_cast<std::size_t>(i);
    if (outside[row] < 0) {
      outside[row] = builder.vertex(outer[row]);
      inside[row] = builder.vertex(inner[row]);
    }
    return row;
  };
  const auto wall = [&](std::size_t a, std::size_t b) {
    builder.quad(outside[b], outside[a], inside[a], inside[b]);
  };
  for (int j = 0; j < mask.rows; ++j) {
    for (int i = 0; i < mask.columns; ++i) {
      if (!mask.at(i, j)) continue;
      const std::size_t a = corner(i, j);
      const std::size_t b = corner(i + 1, j);
      const std::size_t c = corner(i + 1, j + 1);
      const std::size_t d = corner(i, j + 1);
      builder.quad(outside[a], outside[b], outside[c], outside[d]);
      builder.quad(inside[a], inside[d], inside[c], inside[b]);
      if (!mask.at(i, j - 1)) wall(a, b);
      if (!mask.at(i + 1, j)) wall(b, c);
      if (!mask.at(i, j + 1)) wall(c, d);
      if (!mask.at(i - 1, j)) wall(d, a);
    }
  }
}

}  // namespace bathyal::generate
