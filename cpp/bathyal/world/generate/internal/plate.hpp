// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "bathyal/world/generate/internal/mesh_builder.hpp"

namespace bathyal::generate {

/// Which squares of a grid are there.
struct SquareMask {
  int columns = 0, rows = 0;
  std::vector<char> there;

  SquareMask(int column_count, int row_count)
      : columns(column_count),
        rows(row_count),
        there(static_cast<std::size_t>(column_count) * static_cast<std::size_t>(row_count), 1) {}

  /// False outside of the grid.
  bool at(int i, int j) const {
    return i >= 0 && j >= 0 && i < columns && j < rows && there[index(i, j)] != 0;
  }
  void set(int i, int j, bool value) { there[index(i, j)] = value ? 1 : 0; }

  /// Fills squares until no two touch by a corner alone: the edges of a plate would meet there.
  void join_corners();

 private:
  std::size_t index(int i, int j) const {
    return static_cast<std::size_t>(j) * static_cast<std::size_t>(columns) +
           static_cast<std::size_t>(i);
  }
};

/// A closed plate between two sheets of points (columns + 1) × (rows + 1), first index fastest,
/// with the squares that are there. Its outer side faces along ∂i × ∂j.
void add_plate(MeshBuilder& builder, const SquareMask& mask, const std::vector<Vec3>& outer,
               const std::vector<Vec3>& inner);

}  // namespace bathyal::generate
