// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pybind11/pybind11.h>

#include <string>
#include <vector>

#include "bathyal/navigation/navigation_track.hpp"

namespace bathyal::python {

/// What runs and smoothers of the filter return.
struct PyTrack {
  std::vector<NavigationEstimate> rows;
  std::vector<DeviceUpdates> updates;
  std::vector<std::string> names;  ///< of the updates
};

void bind_navigation_track(pybind11::module_& module);

}  // namespace bathyal::python
