// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string_view>

#include "bathyal/geometry/pose.hpp"

namespace bathyal {

/// The rigid motion that brings `from` closest to `onto`, row to row, in least squares (Umeyama
/// 1991, without scale and without mirroring), computed about the centroids.
/// \throw std::invalid_argument for different numbers of rows, fewer than three, rows that are not
/// finite, or points of either side that lie on one line: the rotation about it would be
/// undetermined. The error calls the sides by `from_name` and `onto_name`.
Pose align(PointView from, PointView onto, std::string_view from_name = "from",
           std::string_view onto_name = "onto");

}  // namespace bathyal
