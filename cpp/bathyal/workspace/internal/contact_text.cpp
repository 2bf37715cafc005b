// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/workspace/internal/contact_text.hpp"

namespace bathyal::workspace {

std::string contact_text(const Workspace& workspace, int link, int obstacle, int other_link) {
  if (link < 0) return "something touches";
  const std::string other = obstacle >= 0
                                ? workspace.obstacles()[static_cast<std::size_t>(obstacle)]
                                : link_name(workspace.arm(), other_link);
  return link_name(workspace.arm(), link) + " touches " + other;
}

std::string contact_text(const Workspace& workspace, const Clearance& clearance) {
  if (clearance.self_distance < clearance.distance) {
    return contact_text(workspace, clearance.self_links.first, -1, clearance.self_links.second);
  }
  return contact_text(workspace, clearance.link, clearance.obstacle, -1);
}

}  // namespace bathyal::workspace
