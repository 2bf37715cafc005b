// SPDX-License-Identifier: BSD-3-Clause
#include <cstdlib>
#include <string>

#include "bathyal/base/error.hpp"
#include "bathyal/soundings/text_table.hpp"

// Whatever follows the word that makes a text a grid gives points or an Error.
extern "C" int LLVMFuzzerTestOneInput(const unsigned char* data, std::size_t size) {
  bathyal::TextOptions options;
  options.num_threads = 1;
  const std::string text = "ncols " + std::string(reinterpret_cast<const char*>(data), size);
  try {
    const bathyal::TextTable table = bathyal::parse_text_table(text, options);
    if (!table.grid || table.rows < 1 || table.table.rows() != 3 * table.rows) std::abort();
  } catch (const bathyal::Error&) {
  }
  return 0;
}
