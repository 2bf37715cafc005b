// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <string_view>
#include <vector>

#include "bathyal/geometry/point_cloud.hpp"
#include "bathyal/geometry/pose.hpp"

// The border between numpy and the engine. Arguments: shape and type are checked here, with the
// argument's name, before anything else is done; float64 in C order is shared, anything else that
// holds real numbers is converted once. Results: read-only arrays that share their memory.

namespace bathyal::python {

namespace py = pybind11;

/// (N, 3) real numbers.
Points points_argument(std::string_view name, const py::object& object);

/// A PointCloud as it is, or an (N, 3) array taken as one.
PointCloud cloud_argument(const py::object& object);

/// (N,) real numbers.
Values values_argument(std::string_view name, const py::object& object);

/// (T, 3) whole numbers that fit in 32 bits.
Triangles triangles_argument(std::string_view name, const py::object& object);

/// Three real numbers, finite.
Vec3 vector_argument(std::string_view name, const py::object& object);

/// A rigid motion as (4, 4) real numbers, None the identity; whether it is rigid is for the engine
/// to say.
Pose pose_argument(std::string_view name, const py::object& object);

/// (size, size) real numbers.
Eigen::MatrixXd square_argument(std::string_view name, const py::object& object, Index size);

/// (N, columns) real numbers in row-major order, for tables wider than three.
Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> table_argument(
    std::string_view name, const py::object& object, Index columns);

/// (N, columns) rows of real numbers, or one row as (columns,).
struct Rows {
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> table;
  bool single = false;
};
Rows rows_argument(std::string_view name, const py::object& object, Index columns);

/// A read-only numpy array over memory that `owner` keeps alive.
template <class Scalar>
py::array read_only_array(const Scalar* data, std::vector<py::ssize_t> shape,
                          std::shared_ptr<const void> owner) {
  auto* holder = new std::shared_ptr<const void>(std::move(owner));
  py::capsule base(holder, [](void* p) { delete static_cast<std::shared_ptr<const void>*>(p); });
  py::array_t<Scalar> array(std::move(shape), data, base);
  array.attr("setflags")(py::arg("write") = false);
  return array;
}

/// (N, Cols), or (N,) when Cols is 1.
template <class Scalar, int Cols>
py::array to_numpy(const SharedArray<Scalar, Cols>& array) {
  std::vector<py::ssize_t> shape{array.rows()};
  if constexpr (Cols != 1) shape.push_back(Cols);
  return read_only_array(array.data(), std::move(shape), array.owner());
}

/// Takes a vector over; `tail` are the dimensions after the first: {} for (N,), {3, 3} for (N, 3,
/// 3).
template <class Scalar>
py::array to_numpy(std::vector<Scalar> values, std::vector<py::ssize_t> tail = {}) {
  py::ssize_t width = 1;
  for (const py::ssize_t n : tail) width *= n;
  auto owned = std::make_shared<const std::vector<Scalar>>(std::move(values));
  tail.insert(tail.begin(), static_cast<py::ssize_t>(owned->size()) / width);
  return read_only_array(owned->data(), std::move(tail), owned);
}

/// (3,)
inline py::array to_numpy(const Vec3& vector) {
  return to_numpy(std::vector<double>(vector.begin(), vector.end()));
}

/// (4, 4)
inline py::array to_numpy(const Pose& pose) {
  const Eigen::Matrix<double, 4, 4, Eigen::RowMajor> matrix = pose.matrix();
  return to_numpy(std::vector<double>(matrix.data(), matrix.data() + 16), {4});
}

/// Rows of shape `tail`: (N, …), or as (…) the only one of a single argument.
inline py::array to_numpy(std::vector<double> values, bool single, std::vector<py::ssize_t> tail) {
  py::array rows = to_numpy(std::move(values), std::move(tail));
  return single ? py::array(rows[py::int_(0)]) : rows;
}

}  // namespace bathyal::python
