// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "bathyal/workspace/workspace.hpp"

namespace bathyal::workspace {

/// "panda_link5 touches hull"; `obstacle` or `other_link` is -1.
std::string contact_text(const Workspace& workspace, int link, int obstacle, int other_link);
std::string contact_text(const Workspace& workspace, const Clearance& clearance);
inline std::string contact_text(const Workspace& workspace, const MotionCheck& check) {
  return contact_text(workspace, check.link, check.obstacle, check.other_link);
}

}  // namespace bathyal::workspace
