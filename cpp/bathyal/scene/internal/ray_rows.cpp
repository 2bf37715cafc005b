// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/scene/internal/ray_rows.hpp"

#include <string>

#include "bathyal/base/error.hpp"

namespace bathyal::scene {
namespace {

std::string row_text(PointView rows, Index row) {
  return "row " + std::to_string(row) + " = (" + to_text(rows(row, 0)) + ", " +
         to_text(rows(row, 1)) + ", " + to_text(rows(row, 2)) + ")";
}

}  // namespace

void check_rows(PointView first, PointView second, std::string_view first_name,
                std::string_view second_name) {
  if (first.rows() == second.rows() || first.rows() == 1) return;
  throw_argument(first_name,
                 "one row, or as many as `" + std::string(second_name) + "` (" +
                     std::to_string(second.rows()) + ")",
                 std::to_string(first.rows()) + " rows");
}

void throw_bad_row(PointView first, PointView second, Index row, std::string_view first_name,
                   std::string_view second_name, std::string_view expected) {
  const Index first_row = first.rows() == 1 ? 0 : row;
  if (!first.row(first_row).allFinite()) {
    throw_argument(first_name, "finite coordinates", row_text(first, first_row));
  }
  throw_argument(second_name, expected, row_text(second, row));
}

}  // namespace bathyal::scene
