// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "bathyal/geometry/point_cloud.hpp"

namespace bathyal::terrain {

/// The points of a cloud sorted into square cells of the plan. Only cells that hold a point are
/// kept, so a long, thin, slanted survey costs no more than a square one.
class PlanGrid {
 public:
  struct Point {
    double x, y, z;  ///< about origin() [m]
  };
  struct Cell {
    std::int64_t column, row;
    std::size_t begin, end;            ///< its range of points()
    std::size_t row_below, row_above;  ///< first cell at or after (row ∓ 1, column − 1)
  };

  /// Chooses the cell size so that an occupied cell holds about `points_per_cell` of the points.
  /// `points` must be finite and at least one.
  PlanGrid(PointView points, double points_per_cell);

  /// Cells row by row, each row by column.
  const std::vector<Cell>& cells() const { return cells_; }
  const std::vector<Point>& points() const { return points_; }
  double cell_size() const { return cell_size_; }
  const Vec3& origin() const { return origin_; }

  /// Middle of a cell in plan, about origin().
  std::array<double, 2> centre(const Cell& cell) const;

  /// The up to nine cells around (and with) cell `index`: three runs of cells(), one a row.
  std::array<std::span<const Cell>, 3> neighbours(std::size_t index) const;

  /// The points of a run of cells.
  std::span<const Point> points_of(std::span<const Cell> run) const;

 private:
  void sort_into_cells(PointView points, double size);
  void link_rows();

  Vec3 origin_ = Vec3::Zero();
  double low_x_ = 0.0, low_y_ = 0.0, width_ = 0.0, height_ = 0.0;
  double cell_size_ = 1.0;
  std::vector<Point> points_;
  std::vector<Cell> cells_;
};

}  // namespace bathyal::terrain
