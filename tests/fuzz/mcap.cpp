// SPDX-License-Identifier: BSD-3-Clause
#include <cstdlib>

#include "bathyal/base/error.hpp"
#include "bathyal/log/mcap.hpp"

// Any bytes give messages that lie inside of them, and a reason where they break off, or an Error.
extern "C" int LLVMFuzzerTestOneInput(const unsigned char* data, std::size_t size) {
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  std::size_t held = 0;
  try {
    bathyal::read_mcap(bytes, [&](const bathyal::McapMessage& message) {
      held += message.data.size();
      if (!message.data.empty() &&
          (message.data.data() < bytes.data() ||
           message.data.data() + message.data.size() > bytes.data() + bytes.size())) {
        std::abort();
      }
    });
  } catch (const bathyal::Error&) {
  }
  if (held > size) std::abort();
  return 0;
}
