// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "bathyal/soundings/internal/growing_array.hpp"
#include "bathyal/soundings/internal/text_blocks.hpp"
#include "bathyal/soundings/internal/text_format.hpp"

namespace bathyal::soundings {

/// What a part of the text gave: rows of `TextFormat::chosen` numbers, up to the first line that
/// could not be read.
struct alignas(kPartAlignment) TextRows {
  GrowingArray<double> values;
  Index lines = 0;                     ///< lines ended, the one with the failure not counted
  std::optional<std::string> failure;  ///< why the line behind them could not be read

  void clear();
};

/// Parses whole lines, which begin at `offset` in the source [bytes]; kTextPadding bytes after
/// `text` are readable.
void parse_rows(std::string_view text, std::size_t offset, const TextFormat& format,
                TextRows& rows);

}  // namespace bathyal::soundings
