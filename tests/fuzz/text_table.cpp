// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/soundings/text_table.hpp"

#include <cstdlib>
#include <stdexcept>

#include "bathyal/base/error.hpp"

// Any bytes give a table of the promised shape, an Error or, for a wish the file cannot meet, an
// invalid_argument: nothing else. The first two bytes choose the options.
extern "C" int LLVMFuzzerTestOneInput(const unsigned char* data, std::size_t size) {
  if (size < 2) return 0;
  bathyal::TextOptions options;
  options.separator = "\0 ,;\t"[data[0] % 5];
  options.decimal = "\0.,"[data[0] / 5 % 3];
  options.header_lines = data[0] / 15 % 4 - 1;
  options.empty_is_nan = (data[1] & 1U) != 0;
  options.leading = data[1] / 2 % 4;
  options.skip_lines = data[1] / 8 % 3;
  if (data[1] / 24 % 3 == 1) options.columns = {bathyal::Index{2}, bathyal::Index{0}};
  if (data[1] / 24 % 3 == 2) options.columns = {std::string("z"), std::string("x")};
  options.num_threads = 1;
  try {
    const std::string_view text(reinterpret_cast<const char*>(data) + 2, size - 2);
    const bathyal::TextTable table = bathyal::parse_text_table(text, options);
    if (table.rows < 1 || table.table.rows() != table.rows * table.width) std::abort();
    for (const bathyal::Values& column : table.extra) {
      if (column.rows() != table.rows) std::abort();
    }
  } catch (const bathyal::Error&) {
  } catch (const std::invalid_argument&) {
  }
  return 0;
}
