// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/soundings/pcd.hpp"

#include <cstdlib>

#include "bathyal/base/error.hpp"

// Any bytes give a cloud with a point or more, or an Error.
extern "C" int LLVMFuzzerTestOneInput(const unsigned char* data, std::size_t size) {
  try {
    const bathyal::PointCloud cloud =
        bathyal::parse_pcd({reinterpret_cast<const char*>(data), size}, 1);
    if (cloud.size() < 1) std::abort();
  } catch (const bathyal::Error&) {
  }
  return 0;
}
