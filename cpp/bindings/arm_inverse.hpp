// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "arrays.hpp"
#include "bathyal/arm/inverse.hpp"
#include "enum_names.hpp"

// What every kind of arm's `inverse` takes and gives.

namespace bathyal::python {

const EnumNames<InverseTask>& task_names();

/// (N, 4, 4) or (4, 4); of a task that looks at positions alone also (N, 3) or (3,).
struct Targets {
  std::vector<double> poses;  ///< (N, 4, 4)
  bool single = false;
};

Targets targets_argument(const py::object& object, InverseTask task);

/// What `inverse` returns; of a single pose the arrays have no first dimension.
struct InverseAnswer {
  InverseResult result;
  bool single = false;

  OneOrArray<py::float_> numbers(const std::vector<double>& values) const {
    if (single) return py::float_(values.front());
    return to_numpy(values);
  }
  OneOrArray<py::int_> counts(const std::vector<int>& values) const {
    if (single) return py::int_(values.front());
    return to_numpy(values);
  }
  py::array q() const {
    return to_numpy(std::vector<double>(result.q.data(), result.q.data() + result.q.size()), single,
                    {result.q.cols()});
  }
  OneOrArray<py::str> status() const {
    if (single) return py::str(std::string(to_text(result.status.front())));
    py::list names;
    for (const InverseStatus status : result.status) names.append(std::string(to_text(status)));
    const py::object array =
        py::module_::import("numpy").attr("array")(names, py::arg("dtype") = "<U12");
    array.attr("setflags")(py::arg("write") = false);
    return array;
  }
  std::size_t reached() const {
    return static_cast<std::size_t>(
        std::count(result.status.begin(), result.status.end(), InverseStatus::kReached));
  }
};

}  // namespace bathyal::python
