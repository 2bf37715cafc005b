// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "bathyal/geometry/point_cloud.hpp"

namespace bathyal {

/// How write_xyz writes.
struct WriteXyzOptions {
  int decimals =
      -1;  ///< digits behind the point, 0 to 17; −1: the shortest that read back the same
  char separator = ' ';                 ///< ' ', ',', ';' or '\t'
  std::string preamble;                 ///< text above everything else, written as it is
  bool header = false;                  ///< a first line with the names of the columns
  std::vector<std::string> attributes;  ///< which, in this order, behind x y z
  int num_threads = 0;                  ///< 0: all

  /// \throw std::invalid_argument
  void check() const;
};

/// Writes x y z and the named attributes, one point a line, '\n' behind each. Fixed decimals are
/// rounded as printf does; nan and inf are written by name. The bytes do not depend on
/// num_threads. The caller writes aside and renames: a file left by a failure is incomplete.
/// \throw std::invalid_argument for an attribute that the cloud lacks; Error that names the path
/// when it cannot be written.
void write_xyz(const std::filesystem::path& path, const PointCloud& cloud,
               const WriteXyzOptions& options = {});

}  // namespace bathyal
