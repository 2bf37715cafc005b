// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pybind11/pybind11.h>

#include <string>
#include <string_view>
#include <vector>

#include "arrays.hpp"
#include "bathyal/base/error.hpp"
#include "bathyal/vehicle/vehicle.hpp"

namespace bathyal::python {

/// (6,) finite numbers; None is zero.
inline Vec6 six_argument(std::string_view name, const py::object& object) {
  if (object.is_none()) return Vec6::Zero();
  const Values values = values_argument(name, object);
  if (values.rows() != 6) {
    throw_argument(name, "real numbers of shape (6,)", std::to_string(values.rows()) + " numbers");
  }
  Vec6 result;
  for (int i = 0; i < 6; ++i) result[i] = values.data()[i];
  if (!result.allFinite()) throw_argument(name, "finite numbers", "others");
  return result;
}

inline py::array six_to_numpy(const Vec6& values) {
  return to_numpy(std::vector<double>(values.begin(), values.end()));
}

/// (K,) numbers; None is none.
inline std::vector<double> numbers_argument(std::string_view name, const py::object& object) {
  if (object.is_none()) return {};
  const Values values = values_argument(name, object);
  return {values.data(), values.data() + values.rows()};
}

inline Vec3 vector_or_zero(std::string_view name, const py::object& object) {
  return object.is_none() ? Vec3(Vec3::Zero()) : vector_argument(name, object);
}

}  // namespace bathyal::python
