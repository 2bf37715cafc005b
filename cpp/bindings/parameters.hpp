// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pybind11/pybind11.h>

#include <string>
#include <string_view>
#include <vector>

#include "parameter_types.hpp"

// What a call that fits no signature of a bound function has wrong, read from the signatures that
// pybind11 keeps.

namespace bathyal::python {

struct Parameter {
  std::string name;
  std::string type;  ///< as pybind11 writes it
  bool has_default = false;
  bool keyword_only = false;
};

struct Signature {
  std::vector<Parameter> parameters;
  bool any_positional = false;  ///< it has *args
  bool any_named = false;       ///< it has **kwargs
};

/// Of "(name: type, *, name: type = default) -> type".
Signature parse_signature(std::string_view text);

/// What to raise, and its text.
struct Misfit {
  PyObject* type = nullptr;
  std::string text;
};

/// The first fault of a call: an argument too many, unknown or missing, one of a wrong type, a
/// number out of range. Of several overloads, the one that goes wrong last is spoken of.
Misfit find_misfit(const pybind11::detail::function_record& record, PyObject* const* arguments,
                   std::size_t count, PyObject* names);

}  // namespace bathyal::python
