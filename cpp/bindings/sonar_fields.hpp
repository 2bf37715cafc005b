// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pybind11/pybind11.h>

#include <functional>
#include <string>
#include <vector>

#include "bathyal/sonar/sonar.hpp"

// The description of a sonar as Python sees it: one table drives its properties, `replace`,
// comparison, files and pickling.

namespace bathyal::python {

namespace py = pybind11;

struct SonarField {
  std::string name;
  std::function<py::object(const SonarOptions&)> get;
  std::function<void(SonarOptions&, const py::object&)> set;
};

/// In the order of the description.
const std::vector<SonarField>& sonar_fields();

/// \throw std::invalid_argument for a name that is none of them.
const SonarField& sonar_field(const std::string& name);

/// Every field's value by its name.
py::typing::Dict<py::str, py::object> sonar_to_dict(const SonarOptions& options);

/// `options` with the fields that are given.
SonarOptions replaced(SonarOptions options, const py::dict& fields);

}  // namespace bathyal::python
