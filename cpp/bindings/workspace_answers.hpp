// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "workspace_class.hpp"

// What a workspace answers, as Python sees it.

namespace bathyal::python {

/// The name of a link; empty of −1.
std::string name_of_link(const Workspace& ws, int link);

/// Of hull, keep-out or scene; empty of −1.
std::string obstacle_name(const Workspace& ws, int obstacle);

/// What clearance() returns; of a single posture without the first dimension.
struct ClearanceRows {
  Workspace workspace;
  std::vector<Clearance> rows;
  bool single = false;

  template <class Get>
  OneOrArray<py::float_> numbers(const Get& get) const {
    std::vector<double> values;
    for (const Clearance& row : rows) values.push_back(get(row));
    return numbers_of_rows(std::move(values), single);
  }
  template <class Get>
  OneOrArray<py::str> names(const Get& get) const {
    std::vector<std::string> values;
    for (const Clearance& row : rows) values.push_back(get(row));
    return texts(values, single);
  }
  template <class Get>
  py::array points(const Get& get) const {
    std::vector<double> values;
    for (const Clearance& row : rows) {
      const Vec3 point = get(row);
      values.insert(values.end(), point.begin(), point.end());
    }
    return to_numpy(std::move(values), single, {3});
  }
};

/// What check_motion() returns, with names.
struct NamedMotionCheck {
  MotionCheck check;
  std::string link, against;
};

struct TargetRows {
  std::vector<TargetCheck> rows;
  Index size = 0;
};

/// Capsule, and what Workspace's queries return; before the class.
void bind_workspace_answers(py::module_& module);

}  // namespace bathyal::python
