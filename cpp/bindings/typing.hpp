// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pybind11/numpy.h>
#include <pybind11/typing.h>

// What signatures call arguments that are taken as any object, so that the check by hand, which
// names the argument, comes first: the stub and help() show these types.

namespace bathyal::python {

/// What numpy makes an array of.
class ArrayLike : public pybind11::object {
  static bool accept(PyObject* /*object*/) { return true; }

 public:
  PYBIND11_OBJECT_DEFAULT(ArrayLike, object, accept)
  using object::object;
};

using OptionalArray = pybind11::typing::Optional<ArrayLike>;

/// Covariates by their names.
using OptionalCovariates =
    pybind11::typing::Optional<pybind11::typing::Dict<pybind11::str, ArrayLike>>;

/// One value of a single row, an array of several.
template <class Value>
using OneOrArray = pybind11::typing::Union<Value, pybind11::array>;

}  // namespace bathyal::python

template <>
struct pybind11::detail::handle_type_name<bathyal::python::ArrayLike> {
  static constexpr auto name = const_name("numpy.typing.ArrayLike");
};
