// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/identify/checks/internal/checks.hpp"

namespace bathyal {

std::vector<std::string> find_doubts(const Case& seen) {
  std::vector<std::string> warnings;
  doubt_fit(seen, warnings);
  doubt_data(seen, warnings);
  return warnings;
}

std::vector<std::string> find_gross_doubts(const Case& seen) {
  std::vector<std::string> warnings;
  doubt_arm(seen, warnings);
  doubt_lengths(seen, warnings);
  doubt_data(seen, warnings);
  return warnings;
}

}  // namespace bathyal
