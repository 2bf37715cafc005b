// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>

#include "bathyal/geometry/shared_array.hpp"
#include "bathyal/soundings/internal/text_blocks.hpp"

namespace bathyal::soundings {

/// The points of an ESRI ASCII grid: cell centres, row by row from the north, those without a value
/// left out.
struct AsciiGrid {
  Points points;  ///< in the file's units, z as the file has it
  Index columns = 0;
  Index rows = 0;
  Index without_value = 0;  ///< cells of the no-data value or NaN
};

/// Whether the text's first word is `ncols`, in capitals or not.
bool is_ascii_grid(std::string_view head);

/// Reads `ncols nrows xll{corner,center} yll{corner,center} cellsize | dx dy [nodata_value]` and
/// then ncols · nrows numbers, wherever their lines end. The no-data value is −9999 unless stated.
/// Memory follows the numbers that are there, not what the header claims.
/// \throw Error that names `name` and the line: a header that lacks a word or makes no sense, a
/// word that is no number, more or fewer numbers than cells, no cell with a value.
AsciiGrid read_grid_blocks(TextBlocks& blocks, int num_threads, const std::string& name);

}  // namespace bathyal::soundings
