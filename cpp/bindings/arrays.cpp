// SPDX-License-Identifier: BSD-3-Clause
#include "arrays.hpp"

#include <limits>
#include <string>

#include "bathyal/base/error.hpp"

namespace bathyal::python {
namespace {

std::string shape_text(const py::array& array) {
  std::string text = "(";
  for (py::ssize_t i = 0; i < array.ndim(); ++i) {
    text += std::to_string(array.shape(i)) + (array.ndim() == 1 || i + 1 < array.ndim() ? "," : "");
    if (i + 1 < array.ndim()) text += " ";
  }
  return text + ")";
}

/// numpy's MaskedArray; null where nobody has imported numpy.ma, so that there is no masked array.
py::object masked_array_type() {
  const py::object modules = py::module_::import("sys").attr("modules");
  const py::object masked = modules.attr("get")("numpy.ma");
  return masked.is_none() ? py::object() : py::getattr(masked, "MaskedArray", py::object());
}

/// A masked array that has a masked value, `object` itself or an item of the list or tuple that it
/// is: numpy would drop the masks without a sound. Null where there is none.
py::object with_masked_values(const py::object& object, const py::object& type, int depth = 0) {
  if (py::isinstance(object, type)) {
    const py::object mask = object.attr("mask").attr("any")();
    return py::cast<bool>(mask) ? object : py::object();
  }
  constexpr int kDeepest = 4;  // a list may hold itself
  const bool is_list = PyList_Check(object.ptr()) != 0 || PyTuple_Check(object.ptr()) != 0;
  if (!is_list || depth == kDeepest) return {};
  for (const py::handle item : py::reinterpret_borrow<py::sequence>(object)) {
    py::object found =
        with_masked_values(py::reinterpret_borrow<py::object>(item), type, depth + 1);
    if (found) return found;
  }
  return {};
}

void refuse_masked_values(std::string_view name, const py::object& object) {
  if (Py_TYPE(object.ptr()) == py::detail::npy_api::get().PyArray_Type_) return;
  const py::object type = masked_array_type();
  if (!type) return;
  const py::object masked = with_masked_values(object, type);
  if (!masked) return;
  const py::object count = masked.attr("mask").attr("sum")();
  throw_argument(
      name, "an array without masked values",
      std::string(py::str(count)) + " masked of " + std::string(py::str(masked.attr("size"))));
}

/// Whether somebody else may write to the numbers of `array`, which was made of `object`: not when
/// it is a copy that nobody else has, nor when it shows numbers of ours.
bool is_writable(const py::array& array, const py::object& object) {
  const bool is_known = py::isinstance<py::array>(object) || PyList_Check(object.ptr()) ||
                        PyTuple_Check(object.ptr());  // others may keep the array that they made
  if (array.owndata()) return array.is(object) || !is_known;
  for (py::object owner = array; py::isinstance<py::array>(owner); owner = owner.attr("base")) {
    if (py::reinterpret_borrow<py::array>(owner).writeable()) return true;
    const py::object base = owner.attr("base");
    if (PyCapsule_IsValid(base.ptr(), kFinalNumbers) != 0) return false;
  }
  return true;
}

/// A C-contiguous array of `Scalar`; shares memory when the argument already is one.
template <class Scalar>
py::array_t<Scalar, py::array::c_style> typed_array(std::string_view name, const py::array& array,
                                                    std::string_view kinds,
                                                    std::string_view expected) {
  if (kinds.find(array.dtype().kind()) == std::string_view::npos) {
    throw_argument(name, expected, "dtype " + std::string(py::str(array.dtype())));
  }
  auto typed = py::array_t<Scalar, py::array::c_style | py::array::forcecast>::ensure(array);
  if (!typed) throw py::error_already_set();
  return typed;
}

/// Keeps a numpy array alive from C++, whichever thread lets go of it last.
std::shared_ptr<const void> keep_alive(py::object object) {
  return {new py::object(std::move(object)), [](const void* p) {
            const py::gil_scoped_acquire gil;
            delete static_cast<const py::object*>(p);
          }};
}

template <int Cols>
SharedArray<double, Cols> shared_argument(std::string_view name, const py::object& object) {
  const std::string shape = Cols == 1 ? "shape (N,)" : "shape (N, " + std::to_string(Cols) + ")";
  const std::string expected = "real numbers of " + shape;
  const py::array array = array_argument(name, object, expected);
  const bool fits = Cols == 1 ? array.ndim() == 1 : array.ndim() == 2 && array.shape(1) == Cols;
  if (!fits) throw_argument(name, expected, "shape " + shape_text(array));
  const auto typed = typed_array<double>(name, array, "fiu", expected);
  const bool writable = is_writable(typed, object);
  return {typed.data(), typed.shape(0), keep_alive(typed), writable};
}

}  // namespace

py::array array_argument(std::string_view name, const py::object& object,
                         std::string_view expected) {
  refuse_masked_values(name, object);
  py::array array;
  try {
    array = py::array::ensure(object);
  } catch (const py::error_already_set&) {
    array = py::array();
  }
  if (!array || object.is_none()) {
    PyErr_Clear();
    throw_argument(name, expected, std::string(py::str(py::type::of(object).attr("__name__"))));
  }
  return array;
}

Points points_argument(std::string_view name, const py::object& object) {
  return shared_argument<3>(name, object).snapshot();
}

Points shared_points_argument(std::string_view name, const py::object& object) {
  return shared_argument<3>(name, object);
}

PointCloud cloud_argument(const py::object& object) {
  return shared_cloud_argument(object).snapshot();
}

PointCloud shared_cloud_argument(const py::object& object) {
  if (py::isinstance<PointCloud>(object)) return object.cast<PointCloud>();
  return PointCloud(shared_points_argument("cloud", object));
}

Values values_argument(std::string_view name, const py::object& object) {
  return shared_argument<1>(name, object).snapshot();
}

Values shared_values_argument(std::string_view name, const py::object& object) {
  return shared_argument<1>(name, object);
}

Triangles triangles_argument(std::string_view name, const py::object& object) {
  const std::string expected = "whole numbers of shape (T, 3)";
  const py::array array = array_argument(name, object, expected);
  if (array.ndim() != 2 || array.shape(1) != 3) {
    throw_argument(name, expected, "shape " + shape_text(array));
  }
  if (array.dtype().kind() == 'i' && array.itemsize() <= 4) {
    const auto typed = typed_array<std::int32_t>(name, array, "i", expected);
    const bool writable = is_writable(typed, object);
    return Triangles(typed.data(), typed.shape(0), keep_alive(typed), writable).snapshot();
  }
  const auto wide =
      typed_array<std::int64_t>(name, array, array.size() == 0 ? "iuf" : "iu", expected);
  TriangleMatrix triangles(wide.shape(0), 3);
  for (Index i = 0; i < triangles.size(); ++i) {
    const std::int64_t index = wide.data()[i];
    if (index < std::numeric_limits<std::int32_t>::min() ||
        index > std::numeric_limits<std::int32_t>::max()) {
      throw_argument(name, "indices that fit in 32 bits", std::to_string(index));
    }
    triangles.data()[i] = static_cast<std::int32_t>(index);
  }
  return triangles;
}

Vec3 vector_argument(std::string_view name, const py::object& object) {
  const std::string expected = "three finite numbers";
  const py::array array = array_argument(name, object, expected);
  if (array.ndim() != 1 || array.shape(0) != 3) {
    throw_argument(name, expected, "shape " + shape_text(array));
  }
  const auto typed = typed_array<double>(name, array, "fiu", expected);
  const Vec3 vector(typed.at(0), typed.at(1), typed.at(2));
  if (!vector.allFinite()) throw_argument(name, expected, std::string(py::str(object)));
  return vector;
}

Pose pose_argument(std::string_view name, const py::object& object) {
  Pose pose = Pose::Identity();
  if (object.is_none()) return pose;
  pose.matrix() = square_argument(name, object, 4);
  return pose;
}

Pose given_pose_argument(std::string_view name, const py::object& object) {
  if (object.is_none()) throw_argument(name, "real numbers of shape (4, 4)", "None");
  return pose_argument(name, object);
}

std::vector<Pose> poses_argument(std::string_view name, const py::object& object) {
  constexpr const char* kExpected = "real numbers of shape (K, 4, 4)";
  const py::array array = array_argument(name, object, kExpected);
  if (array.ndim() != 3 || array.shape(1) != 4 || array.shape(2) != 4) {
    throw_argument(name, kExpected, "shape " + shape_text(array));
  }
  const auto typed = typed_array<double>(name, array, "fiu", kExpected);
  std::vector<Pose> poses(static_cast<std::size_t>(array.shape(0)));
  for (std::size_t i = 0; i < poses.size(); ++i) poses[i] = pose_of_rows(typed.data() + 16 * i);
  return poses;
}

Eigen::MatrixXd square_argument(std::string_view name, const py::object& object, Index size) {
  const std::string width = std::to_string(size);
  const std::string expected = "real numbers of shape (" + width + ", " + width + ")";
  const py::array array = array_argument(name, object, expected);
  if (array.ndim() != 2 || array.shape(0) != size || array.shape(1) != size) {
    throw_argument(name, expected, "shape " + shape_text(array));
  }
  const auto typed = typed_array<double>(name, array, "fiu", expected);
  using Rows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  return Eigen::Map<const Rows>(typed.data(), size, size);
}

Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> table_argument(
    std::string_view name, const py::object& object, Index columns) {
  const std::string expected = "real numbers of shape (N, " + std::to_string(columns) + ")";
  const py::array array = array_argument(name, object, expected);
  if (array.ndim() != 2 || array.shape(1) != columns) {
    throw_argument(name, expected, "shape " + shape_text(array));
  }
  const auto typed = typed_array<double>(name, array, "fiu", expected);
  using Table = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  return Eigen::Map<const Table>(typed.data(), typed.shape(0), columns);
}

Rows rows_argument(std::string_view name, const py::object& object, Index columns) {
  const std::string width = std::to_string(columns);
  const std::string expected = "real numbers of shape (N, " + width + ") or (" + width + ",)";
  const py::array array = array_argument(name, object, expected);
  const bool fits = (array.ndim() == 1 && array.shape(0) == columns) ||
                    (array.ndim() == 2 && array.shape(1) == columns);
  if (!fits) throw_argument(name, expected, "shape " + shape_text(array));
  const auto typed = typed_array<double>(name, array, "fiu", expected);
  Rows rows;
  rows.single = array.ndim() == 1;
  rows.table = Eigen::Map<const decltype(rows.table)>(typed.data(),
                                                      rows.single ? 1 : array.shape(0), columns);
  return rows;
}

}  // namespace bathyal::python
