// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/identify/checks/internal/checks.hpp"

namespace bathyal::identify {

std::vector<std::string> all_warnings(const CheckContext& context) {
  std::vector<std::string> warnings;
  check_fit(context, warnings);
  check_data(context, warnings);
  return warnings;
}

std::vector<std::string> gross_warnings(const CheckContext& context) {
  std::vector<std::string> warnings;
  check_arm(context, warnings);
  check_lengths(context, warnings);
  check_data(context, warnings);
  return warnings;
}

}  // namespace bathyal::identify
