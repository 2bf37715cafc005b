// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "bathyal/soundings/text_table.hpp"

namespace bathyal::soundings {

/// The format of a file, as its head shows it.
struct TextFormat {
  char separator = ' ';
  char decimal = '.';
  bool empty_is_nan = false;
  std::vector<std::string> comments;    ///< marks that remain valid with this separator
  std::array<bool, 256> may_comment{};  ///< first bytes of `comments`
  std::vector<std::string> names;       ///< one a column, or none
  std::vector<Index> slot;              ///< one a column: its place in a row of the result, or −1
  Index chosen = 0;                     ///< numbers in a row of the result
  std::size_t begin = 0;                ///< where the rows begin [bytes]
  Index lines_before = 0;               ///< lines before them
  std::string names_of_columns() const;  ///< for messages
};

/// Reads the head of a file: `block` is the text's first block, byte order mark and all.
/// \throw as read_text_table
TextFormat detect_format(std::string_view block, const TextOptions& options,
                         const std::string& name);

/// Cuts a line into fields, blanks and quotes around them taken off, a comment behind them left
/// out. One separator at the line's end makes no field of its own unless `wanted` fields need it.
/// False when a quote is not closed.
bool split_fields(std::string_view line, const TextFormat& format, std::size_t wanted,
                  std::vector<std::string_view>& fields);

/// Whether the line holds nothing but blanks or a comment.
bool is_blank_or_comment(std::string_view line, const TextFormat& format);

/// Whether the field is empty or says NA, N/A or null, in capitals or not.
bool is_missing(std::string_view field);

/// The number in a field, by name (nan, inf) and the policy for empty fields included.
bool field_value(std::string_view field, const TextFormat& format, double& value);

/// The first line of `text`, without its end, which is LF, CRLF or CR; `text` loses both.
std::string_view take_line(std::string_view& text);

/// Offset of the first byte that no text has (control characters but blanks), or npos.
std::size_t find_binary(std::string_view text);

/// The message about such a byte at `offset` in the source.
std::string not_text(std::string_view byte, std::size_t offset);

}  // namespace bathyal::soundings
