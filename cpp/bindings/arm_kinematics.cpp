// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/arm/kinematics.hpp"

#include <algorithm>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "arm_class.hpp"
#include "arm_docs.hpp"
#include "arrays.hpp"
#include "bathyal/arm/statics.hpp"
#include "enum_names.hpp"

namespace bathyal::python {

const EnumNames<TipFrame>& tip_frame_names() {
  static const EnumNames<TipFrame> names{{"world", TipFrame::kWorld}, {"tool", TipFrame::kTool}};
  return names;
}

namespace {

const EnumNames<Manipulability>& manipulability_names() {
  static const EnumNames<Manipulability> names{
      {"yoshikawa", Manipulability::kYoshikawa},
      {"smallest", Manipulability::kSmallest},
      {"inverse_condition", Manipulability::kInverseCondition}};
  return names;
}
const EnumNames<JacobianPart>& part_names() {
  static const EnumNames<JacobianPart> names{{"all", JacobianPart::kAll},
                                             {"linear", JacobianPart::kLinear},
                                             {"angular", JacobianPart::kAngular}};
  return names;
}

/// Memory for a result that is written whole: nobody touches its pages before those who write.
class Fresh {
 public:
  Fresh(Index rows, std::vector<py::ssize_t> tail) : shape_(std::move(tail)) {
    shape_.insert(shape_.begin(), rows);
    for (const py::ssize_t n : shape_) size_ *= static_cast<std::size_t>(n);
    data_.reset(new double[size_]);
  }

  std::span<double> memory() const { return {data_.get(), size_}; }

  /// All rows, or the only one of a single pose.
  py::array to_numpy(bool single) const {
    py::array rows = read_only_array(data_.get(), shape_, data_);
    return single ? py::array(rows[py::int_(0)]) : rows;
  }

 private:
  std::vector<py::ssize_t> shape_;
  std::size_t size_ = 1;
  std::shared_ptr<double[]> data_;
};

py::array forward_python(const Arm& arm, const ArrayLike& q, bool links, int num_threads) {
  const Rows rows = rows_argument("q", q, arm.size());
  const auto count = static_cast<py::ssize_t>(arm.links().size());
  const Fresh poses(rows.table.rows(),
                    links ? std::vector<py::ssize_t>{count, 4, 4} : std::vector<py::ssize_t>{4, 4});
  {
    const py::gil_scoped_release release;
    KinematicsOutput output;
    (links ? output.links : output.poses) = poses.memory();
    compute_kinematics(arm, view_of(rows), output, num_threads);
  }
  return poses.to_numpy(rows.single);
}

py::array jacobian_python(const Arm& arm, const ArrayLike& q, const std::string& frame,
                          int num_threads) {
  const Rows rows = rows_argument("q", q, arm.size());
  const TipFrame tip = enum_argument("frame", frame, tip_frame_names());
  const Fresh jacobians(rows.table.rows(), {6, arm.size()});
  {
    const py::gil_scoped_release release;
    compute_kinematics(arm, view_of(rows), {.jacobians = jacobians.memory(), .frame = tip},
                       num_threads);
  }
  return jacobians.to_numpy(rows.single);
}

OneOrArray<py::float_> manipulability_python(const Arm& arm, const ArrayLike& q,
                                             const std::string& kind, const std::string& part,
                                             int num_threads) {
  const Rows rows = rows_argument("q", q, arm.size());
  const Manipulability what = enum_argument("kind", kind, manipulability_names());
  const JacobianPart counted = enum_argument("part", part, part_names());
  std::vector<double> values;
  {
    const py::gil_scoped_release release;
    values = manipulability(arm, view_of(rows), what, counted, num_threads);
  }
  if (rows.single) return py::float_(values.front());
  return python::to_numpy(std::move(values));
}

OneOrArray<py::bool_> within_limits_python(const Arm& arm, const ArrayLike& q) {
  const Rows rows = rows_argument("q", q, arm.size());
  const std::vector<bool> within = within_limits(arm, view_of(rows));
  if (rows.single) return py::bool_(within.front());
  py::array_t<bool> array(static_cast<py::ssize_t>(within.size()));
  std::copy(within.begin(), within.end(), array.mutable_data());
  array.attr("setflags")(py::arg("write") = false);
  return array;
}

py::array statics_python(const Arm& arm, const ArrayLike& q, const OptionalArray& wrench,
                         const StaticsOptions& options) {
  const Rows rows = rows_argument("q", q, arm.size());
  const Rows pushes = wrench.is_none() ? Rows{} : rows_argument("wrench", wrench, 6);
  std::vector<double> torques;
  {
    const py::gil_scoped_release release;
    const Wrenches view(pushes.table.data(), pushes.table.rows(), 6);
    torques = statics(arm, view_of(rows), view, options);
  }
  return python::to_numpy(std::move(torques), rows.single, {arm.size()});
}

}  // namespace

void add_kinematics(py::class_<Arm>& cls) {
  const StaticsOptions still;
  cls.def("forward", &forward_python, py::arg("q"), py::kw_only(), py::arg("links") = false,
          py::arg("num_threads") = 0, kForwardDoc)
      .def("jacobian", &jacobian_python, py::arg("q"), py::kw_only(),
           py::arg("frame") = enum_name(TipFrame::kWorld, tip_frame_names()),
           py::arg("num_threads") = 0, kJacobianDoc)
      .def("manipulability", &manipulability_python, py::arg("q"), py::kw_only(),
           py::arg("kind") = enum_name(Manipulability::kYoshikawa, manipulability_names()),
           py::arg("part") = enum_name(JacobianPart::kAll, part_names()),
           py::arg("num_threads") = 0, kManipulabilityDoc)
      .def(
          "statics",
          [](const Arm& arm, const ArrayLike& q, const OptionalArray& wrench,
             const std::string& frame, const ArrayLike& gravity, double water_density,
             double payload, const ArrayLike& payload_center, double payload_volume,
             const OptionalArray& payload_center_of_buoyancy, int num_threads) {
            StaticsOptions options;
            options.gravity = vector_argument("gravity", gravity);
            options.water_density = water_density;
            options.payload.mass = payload;
            options.payload.volume = payload_volume;
            options.payload.center_of_mass = vector_argument("payload_center", payload_center);
            options.payload.center_of_buoyancy =
                payload_center_of_buoyancy.is_none()
                    ? options.payload.center_of_mass
                    : vector_argument("payload_center_of_buoyancy", payload_center_of_buoyancy);
            options.frame = enum_argument("frame", frame, tip_frame_names());
            options.num_threads = num_threads;
            return statics_python(arm, q, wrench, options);
          },
          py::arg("q"), py::arg("wrench") = py::none(), py::kw_only(),
          py::arg("frame") = enum_name(still.frame, tip_frame_names()),
          py::arg("gravity") =
              py::make_tuple(still.gravity.x(), still.gravity.y(), still.gravity.z()),
          py::arg("water_density") = still.water_density, py::arg("payload") = still.payload.mass,
          py::arg("payload_center") = py::make_tuple(0, 0, 0),
          py::arg("payload_volume") = still.payload.volume,
          py::arg("payload_center_of_buoyancy") = py::none(),
          py::arg("num_threads") = still.num_threads, kStaticsDoc)
      .def("within_limits", &within_limits_python, py::arg("q"),
           "Whether each pose q (N, n) keeps the limits: (N,) bool; one pose (n,) gives one.");
}

}  // namespace bathyal::python
