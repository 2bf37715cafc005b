// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "bathyal/geometry/point_cloud.hpp"

namespace bathyal {

/// Reads a point cloud of the Point Cloud Library (.pcd, version 0.5 to 0.7): ascii, binary or
/// binary_compressed, fields of any type, size and count.
///
/// x, y and z are as the file stores them; its VIEWPOINT is the sensor's pose and changes nothing.
/// Every other field rides along as an attribute of its name, one of several numbers as name_0,
/// name_1, …; `rgb` and `rgba` are taken apart into red, green, blue (and alpha), 0 to 255; fields
/// named `_` are padding. Points that are not finite are kept (clean_cloud counts and drops them).
///
/// The header's sizes are checked against the file's length first: nothing is allocated for points
/// that are not there.
/// \throw Error that names the file: not readable, no PCD header or one that contradicts itself, no
/// x, y, z, no point, data that end early or go on behind the last point of an ascii file.
PointCloud read_pcd(const std::filesystem::path& path, int num_threads = 0);

/// The same for a file in memory, called `name` in messages.
PointCloud parse_pcd(std::string_view bytes, int num_threads = 0, const std::string& name = "pcd");

}  // namespace bathyal
