// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pybind11/pybind11.h>
#include <pybind11/typing.h>

#include <functional>
#include <string>
#include <vector>

#include "bathyal/sonar/echo.hpp"

// The description of a sonar as Python sees it: one table drives its properties, `replace`,
// comparison, files and pickling.

namespace bathyal::python {

namespace py = pybind11;

/// What a field may be given as.
class SonarValue : public py::object {
  static bool accept(PyObject* /*object*/) { return true; }

 public:
  PYBIND11_OBJECT_DEFAULT(SonarValue, object, accept)
  using object::object;
};

using SonarValues = py::typing::Dict<py::str, SonarValue>;

struct SonarField {
  std::string name;
  std::function<py::object(const SonarOptions&)> get;
  std::function<void(SonarOptions&, const py::object&)> set;
  std::function<void(py::class_<Sonar>&, const char* doc)> add;  ///< as a property, typed
};

/// In the order of the description.
const std::vector<SonarField>& sonar_fields();

/// \throw std::invalid_argument for a name that is none of them.
const SonarField& sonar_field(const std::string& name);

/// Every field's value by its name.
SonarValues sonar_to_dict(const SonarOptions& options);

/// `options` with the fields that are given.
SonarOptions replaced(SonarOptions options, const py::dict& fields);

}  // namespace bathyal::python

template <>
struct pybind11::detail::handle_type_name<bathyal::python::SonarValue> {
  static constexpr auto name =
      const_name("bool | int | float | str | numpy.typing.ArrayLike | None");
};
