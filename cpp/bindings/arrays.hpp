// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <string_view>
#include <vector>

#include "bathyal/geometry/point_cloud.hpp"
#include "bathyal/geometry/pose.hpp"
#include "typing.hpp"

// The border between numpy and the engine. Arguments: shape and type are checked here, with the
// argument's name, before anything else is done; float64 in C order is shared, anything else that
// holds real numbers is converted once. Masked values are refused: every array comes in through
// array_argument. Results: read-only arrays that share their memory.
//
// A caller may write to an array while the engine works on it in another thread. What an object
// keeps (PointCloud, TriangleMesh) is shared all the same and says so (SharedArray::writable); what
// a function works on is a snapshot. Only rays are read in place: each row is read on its own, and
// no index comes from it.

namespace bathyal::python {

namespace py = pybind11;

/// Any array, or what numpy makes one of; `expected` says what should have been given. None and an
/// array with a masked value in it are refused.
py::array array_argument(std::string_view name, const py::object& object,
                         std::string_view expected);

/// (N, 3) real numbers to work on, which nobody writes to.
Points points_argument(std::string_view name, const py::object& object);

/// (N, 3) real numbers, shared with the caller, to be kept or to be read row by row.
Points shared_points_argument(std::string_view name, const py::object& object);

/// A PointCloud, or an (N, 3) array taken as one, to work on.
using CloudLike = py::typing::Union<PointCloud, ArrayLike>;
PointCloud cloud_argument(const py::object& object);

/// The same, shared with the caller.
PointCloud shared_cloud_argument(const py::object& object);

/// (N,) real numbers to work on, which nobody writes to.
Values values_argument(std::string_view name, const py::object& object);

/// (N,) real numbers, shared with the caller, to be kept.
Values shared_values_argument(std::string_view name, const py::object& object);

/// (T, 3) whole numbers that fit in 32 bits, which nobody writes to.
Triangles triangles_argument(std::string_view name, const py::object& object);

/// Three real numbers, finite.
Vec3 vector_argument(std::string_view name, const py::object& object);

/// A rigid motion as (4, 4) real numbers, None the identity; whether it is rigid is for the engine
/// to say.
Pose pose_argument(std::string_view name, const py::object& object);

/// The same, and no None.
Pose given_pose_argument(std::string_view name, const py::object& object);

/// (K, 4, 4), likewise.
std::vector<Pose> poses_argument(std::string_view name, const py::object& object);

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

/// Name of the capsule under an array of ours whose numbers nobody can write to.
inline constexpr const char* kFinalNumbers = "bathyal final numbers";

/// A read-only numpy array over memory that `owner` keeps alive; `writable`: a caller's own, who
/// may write to it otherwise.
template <class Scalar>
py::array read_only_array(const Scalar* data, std::vector<py::ssize_t> shape,
                          std::shared_ptr<const void> owner, bool writable = false) {
  auto* holder = new std::shared_ptr<const void>(std::move(owner));
  const py::capsule base(holder, writable ? nullptr : kFinalNumbers, [](PyObject* capsule) {
    const char* name = PyCapsule_GetName(capsule);
    delete static_cast<std::shared_ptr<const void>*>(PyCapsule_GetPointer(capsule, name));
  });
  py::array_t<Scalar> array(std::move(shape), data, base);
  array.attr("setflags")(py::arg("write") = false);
  return array;
}

/// (N, Cols), or (N,) when Cols is 1.
template <class Scalar, int Cols>
py::array to_numpy(const SharedArray<Scalar, Cols>& array) {
  std::vector<py::ssize_t> shape{array.rows()};
  if constexpr (Cols != 1) shape.push_back(Cols);
  return read_only_array(array.data(), std::move(shape), array.owner(), array.writable());
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

/// (N,)
inline py::array to_numpy(const Eigen::VectorXd& values) {
  return to_numpy(std::vector<double>(values.begin(), values.end()));
}

/// (N, k)
inline py::array to_numpy(
    const Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>& table) {
  return to_numpy(std::vector<double>(table.data(), table.data() + table.size()), {table.cols()});
}

/// (3,)
inline py::array to_numpy(const Vec3& vector) {
  return to_numpy(std::vector<double>(vector.begin(), vector.end()));
}

/// (4, 4)
inline py::array to_numpy(const Pose& pose) {
  const std::array<double, 16> numbers = row_major(pose);
  return to_numpy(std::vector<double>(numbers.begin(), numbers.end()), {4});
}

/// (N, 4, 4)
inline py::array to_numpy(const std::vector<Pose>& poses) {
  std::vector<double> values;
  for (const Pose& pose : poses) {
    const std::array<double, 16> numbers = row_major(pose);
    values.insert(values.end(), numbers.begin(), numbers.end());
  }
  return to_numpy(std::move(values), {4, 4});
}

/// Rows of shape `tail`: (N, …), or as (…) the only one of a single argument.
inline py::array to_numpy(std::vector<double> values, bool single, std::vector<py::ssize_t> tail) {
  py::array rows = to_numpy(std::move(values), std::move(tail));
  return single ? py::array(rows[py::int_(0)]) : rows;
}

}  // namespace bathyal::python
