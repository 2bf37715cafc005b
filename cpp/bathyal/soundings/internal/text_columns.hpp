// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "bathyal/soundings/internal/text_blocks.hpp"
#include "bathyal/soundings/internal/text_format.hpp"

namespace bathyal::soundings {

/// Parses the rest of the text, from the current block on, as rows of this format and joins them to
/// a table whose `table` has the first `leading` of the chosen columns (0: all).
/// \throw std::invalid_argument when `leading` is more than that; Error that names `name` and the
/// first line that could not be read.
TextTable read_columns(TextBlocks& blocks, const TextFormat& format, Index leading, int num_threads,
                       const std::string& name);

}  // namespace bathyal::soundings
