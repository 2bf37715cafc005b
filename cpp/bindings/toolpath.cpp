// SPDX-License-Identifier: BSD-3-Clause
#include <pybind11/stl.h>

#include <algorithm>
#include <string>

#include "arrays.hpp"
#include "bathyal/base/error.hpp"
#include "bathyal/toolpath/coverage.hpp"
#include "bathyal/toolpath/toolpath.hpp"
#include "bindings.hpp"
#include "enum_names.hpp"
#include "toolpath_docs.hpp"

namespace bathyal::python {
namespace {

// Arguments -------------------------------------------------------------------------------------

using SurfaceLike = py::typing::Union<Scene, Plane>;

Surface surface_argument(const py::object& object) {
  if (py::isinstance<Plane>(object)) return object.cast<Plane>();
  if (py::isinstance<Scene>(object)) return object.cast<Scene>();
  throw_argument("surface", "a Scene or a Plane",
                 std::string(py::str(py::type::of(object).attr("__name__"))));
}

Aims aims_argument(const py::object& object) { return table_argument("aims", object, 6); }

const EnumNames<AimsFrame>& aims_frame_names() {
  static const EnumNames<AimsFrame> names{{"vehicle", AimsFrame::kVehicle},
                                          {"world", AimsFrame::kWorld}};
  return names;
}
const EnumNames<Vertical>& vertical_names() {
  static const EnumNames<Vertical> names{{"gravity", Vertical::kGravity},
                                         {"vehicle", Vertical::kVehicle}};
  return names;
}
const EnumNames<Orientation>& orientation_names() {
  static const EnumNames<Orientation> names{
      {"blended", Orientation::kBlended}, {"piecewise_constant", Orientation::kPiecewiseConstant}};
  return names;
}
const EnumNames<Offset>& offset_names() {
  static const EnumNames<Offset> names{{"rolling", Offset::kRolling}, {"plain", Offset::kPlain}};
  return names;
}
const EnumNames<MissedAims>& missed_names() {
  static const EnumNames<MissedAims> names{{"leave_out", MissedAims::kLeaveOut},
                                           {"refuse", MissedAims::kRefuse}};
  return names;
}

TargetOptions target_options(const OptionalArray& world_from_vehicle, const std::string& frame,
                             const std::string& vertical, double grazing_angle, double max_range,
                             int num_threads) {
  TargetOptions options;
  options.reference.world_from_vehicle = pose_argument("world_from_vehicle", world_from_vehicle);
  options.reference.frame = enum_argument("frame", frame, aims_frame_names());
  options.reference.vertical = enum_argument("vertical", vertical, vertical_names());
  options.grazing_angle = grazing_angle;
  options.max_range = max_range;
  options.num_threads = num_threads;
  return options;
}

// Results ---------------------------------------------------------------------------------------
// Arrays share the memory of the result they are read from, which each keeps alive.

template <class Result>
using Pointer = std::shared_ptr<Result>;

py::array read_only(py::array array) {
  array.attr("setflags")(py::arg("write") = false);
  return array;
}

template <class Result>
py::array to_array(const Pointer<Result>& owner, const std::vector<Vec3>& values) {
  static_assert(sizeof(Vec3) == 3 * sizeof(double));
  return read_only_array(reinterpret_cast<const double*>(values.data()),
                         {static_cast<py::ssize_t>(values.size()), 3}, owner);
}

template <class Result>
py::array to_array(const Pointer<Result>& owner, const std::vector<std::array<double, 4>>& values) {
  return read_only_array(values.empty() ? nullptr : values[0].data(),
                         {static_cast<py::ssize_t>(values.size()), 4}, owner);
}

template <class Result, class Scalar>
py::array to_array(const Pointer<Result>& owner, const std::vector<Scalar>& values) {
  return read_only_array(values.data(), {static_cast<py::ssize_t>(values.size())}, owner);
}

template <class Result>
py::array to_array(const Pointer<Result>& /*owner*/, const std::vector<bool>& values) {
  py::array_t<bool> array(static_cast<py::ssize_t>(values.size()));
  std::copy(values.begin(), values.end(), array.mutable_data());
  return read_only(array);
}

template <class Result>
py::array to_array(const Pointer<Result>& /*owner*/, const std::vector<TargetStatus>& values) {
  py::list words;
  for (const TargetStatus status : values) words.append(std::string(to_text(status)));
  return read_only(py::module_::import("numpy").attr("array")(words, py::arg("dtype") = "<U8"));
}

/// A property that shows one array of a struct of arrays.
template <class Result, class Field>
void add_array(py::class_<Result, Pointer<Result>>& cls, const char* name, Field Result::*field,
               const char* doc) {
  cls.def_property_readonly(
      name, [field](const Pointer<Result>& result) { return to_array(result, (*result).*field); },
      doc);
}

py::array frames(const ToolPath& path) {
  std::vector<Pose> poses;
  for (std::size_t j = 0; j < path.size(); ++j) poses.push_back(path.frame(j));
  return to_numpy(poses);
}

void bind_targets(py::module_& module) {
  py::class_<Targets, Pointer<Targets>> cls(
      module, "Targets", "Where camera axes meet the bottom, one target a row of the aims.");
  add_array(cls, "point", &Targets::point, "(K, 3) A_i [m], NaN where there is none.");
  add_array(cls, "normal", &Targets::normal,
            "(K, 3) unit, out of the bottom, NaN where there is none.");
  add_array(cls, "mesh", &Targets::mesh, "(K,) mesh of the scene, −1 where there is none.");
  add_array(cls, "triangle", &Targets::triangle,
            "(K,) triangle of the mesh, −1 where there is none.");
  add_array(cls, "barycentric", &Targets::barycentric,
            "(K, 3) (u, v, w) of eq 4: A = w V0 + u V1 + v V2; NaN where there is none.");
  add_array(cls, "range", &Targets::range,
            "(K,) along the unit direction [m], inf where there is none.");
  add_array(cls, "incidence", &Targets::incidence,
            "(K,) between the axis and the normal [rad], above π/2 from beneath.");
  add_array(cls, "status", &Targets::status,
            "(K,) \"hit\", \"miss\", \"parallel\", \"behind\", \"hole\" or \"grazing\".");
  cls.def("__len__", &Targets::size).def("__repr__", [](const Targets& targets) {
    std::size_t found = 0;
    for (std::size_t i = 0; i < targets.size(); ++i) found += targets.found(i) ? 1 : 0;
    return "Targets(" + std::to_string(found) + " of " + std::to_string(targets.size()) + " found)";
  });
}

void bind_path(py::module_& module) {
  py::class_<ToolPath, Pointer<ToolPath>> cls(
      module, "ToolPath",
      "An oriented tool path along the bottom, one sample a row, in the world frame.\n\n"
      "Positions [m], times [s], angles [rad]. All arrays are read-only.");
  add_array(cls, "position", &ToolPath::position,
            "(M, 3) the tool's point: T_j, T_j + standoff · a_j, or the rolling ball's centre.");
  add_array(cls, "surface", &ToolPath::surface,
            "(M, 3) T_j, on the bottom; what the rolling ball touches.");
  add_array(cls, "approach", &ToolPath::approach,
            "(M, 3) a_j, unit, out of the bottom; the tool's z is −a_j.");
  add_array(cls, "travel", &ToolPath::travel,
            "(M, 3) n_j, unit, along the travel, perpendicular to a_j.");
  add_array(cls, "side", &ToolPath::side, "(M, 3) b_j = a_j × n_j.");
  cls.def_property_readonly(
      "frame", &frames,
      "(M, 4, 4) world_from_tool: rotation columns [n, −b, −a], translation the position.");
  add_array(cls, "quaternion", &ToolPath::quaternion,
            "(M, 4) x y z w of the frame, continuous in sign.");
  add_array(cls, "segment", &ToolPath::segment,
            "(M,) i of the pair A_i A_{i+1}: a row of the aims.");
  add_array(cls, "mesh", &ToolPath::mesh, "(M,) mesh of the scene, −1 on a plane.");
  add_array(cls, "triangle", &ToolPath::triangle,
            "(M,) triangle of the stretch that begins here, −1 on a plane.");
  add_array(cls, "gap", &ToolPath::gap,
            "(M,) whether the stretch to the next sample crosses a gap of the bottom.");
  add_array(cls, "arc_length", &ToolPath::arc_length, "(M,) along the positions, from 0.");
  add_array(cls, "time", &ToolPath::time, "(M,) from 0, never falling.");
  add_array(cls, "normal_std", &ToolPath::normal_std,
            "(M,) root mean square of the angle the true normal may lie off; NaN where unknown.");
  add_array(cls, "crossing", &ToolPath::crossing,
            "(M,) whether the path at standoff turns back or crosses itself here.");
  add_array(cls, "contact", &ToolPath::contact, "(M,) whether the tool's body meets ground here.");
  cls.def_property_readonly(
         "targets",
         [](const Pointer<ToolPath>& path) { return Pointer<Targets>(path, &path->targets); },
         "The Targets the path goes through, one a row of the aims.")
      .def_property_readonly(
          "warnings", [](const ToolPath& path) { return path.warnings; },
          "What a person should know before the path is followed: list of str.")
      .def("__len__", &ToolPath::size)
      .def("__repr__", [](const ToolPath& path) {
        return py::str("ToolPath({} samples, {:.3f} m, {:.1f} s)")
            .format(path.size(), path.arc_length.back(), path.time.back());
      });
}

// Functions -------------------------------------------------------------------------------------

Pointer<Targets> find_targets_python(const SurfaceLike& surface, const ArrayLike& aims,
                                     const TargetOptions& options) {
  const Surface bottom = surface_argument(surface);
  const Aims rows = aims_argument(aims);
  const py::gil_scoped_release release;
  return std::make_shared<Targets>(find_targets(bottom, rows, options));
}

Pointer<ToolPath> plan_toolpath_python(const SurfaceLike& surface, const ArrayLike& aims,
                                       const ToolPathOptions& options) {
  const Surface bottom = surface_argument(surface);
  const Aims rows = aims_argument(aims);
  const py::gil_scoped_release release;
  return std::make_shared<ToolPath>(plan_toolpath(bottom, rows, options));
}

}  // namespace

void bind_toolpath(py::module_& module) {
  bind_targets(module);
  bind_path(module);

  const ToolPathOptions path;
  const TargetOptions target = path.targets;
  const CoverOptions cover;
  module.def(
      "find_targets",
      [](const SurfaceLike& surface, const ArrayLike& aims, const OptionalArray& world_from_vehicle,
         const std::string& frame, const std::string& vertical, double grazing_angle,
         double max_range, int num_threads) {
        return find_targets_python(surface, aims,
                                   target_options(world_from_vehicle, frame, vertical,
                                                  grazing_angle, max_range, num_threads));
      },
      py::arg("surface"), py::arg("aims"), py::kw_only(),
      py::arg("world_from_vehicle") = py::none(),
      py::arg("frame") = enum_name(target.reference.frame, aims_frame_names()),
      py::arg("vertical") = enum_name(target.reference.vertical, vertical_names()),
      py::arg("grazing_angle") = target.grazing_angle, py::arg("max_range") = target.max_range,
      py::arg("num_threads") = target.num_threads, kFindTargetsDoc);
  module.def(
      "plan_toolpath",
      [](const SurfaceLike& surface, const ArrayLike& aims, const OptionalArray& world_from_vehicle,
         const std::string& frame, const std::string& vertical, double grazing_angle,
         double max_range, const std::string& missed, const std::string& orientation,
         double blend_length, double angular_rate, double speed, double acceleration,
         double standoff, const std::string& offset, double step, double normal_radius,
         double tool_radius, double tool_length, double contact_tolerance, int num_threads) {
        ToolPathOptions options;
        options.targets = target_options(world_from_vehicle, frame, vertical, grazing_angle,
                                         max_range, num_threads);
        options.missed = enum_argument("missed", missed, missed_names());
        options.orientation = enum_argument("orientation", orientation, orientation_names());
        options.blend_length = blend_length;
        options.angular_rate = angular_rate;
        options.speed = speed;
        options.acceleration = acceleration;
        options.standoff = standoff;
        options.offset = enum_argument("offset", offset, offset_names());
        options.step = step;
        options.normal_radius = normal_radius;
        options.tool_radius = tool_radius;
        options.tool_length = tool_length;
        options.contact_tolerance = contact_tolerance;
        return plan_toolpath_python(surface, aims, options);
      },
      py::arg("surface"), py::arg("aims"), py::kw_only(),
      py::arg("world_from_vehicle") = py::none(),
      py::arg("frame") = enum_name(target.reference.frame, aims_frame_names()),
      py::arg("vertical") = enum_name(target.reference.vertical, vertical_names()),
      py::arg("grazing_angle") = target.grazing_angle, py::arg("max_range") = target.max_range,
      py::arg("missed") = enum_name(path.missed, missed_names()),
      py::arg("orientation") = enum_name(path.orientation, orientation_names()),
      py::arg("blend_length") = path.blend_length, py::arg("angular_rate") = path.angular_rate,
      py::arg("speed") = path.speed, py::arg("acceleration") = path.acceleration,
      py::arg("standoff") = path.standoff,
      py::arg("offset") = enum_name(path.offset, offset_names()), py::arg("step") = path.step,
      py::arg("normal_radius") = path.normal_radius, py::arg("tool_radius") = path.tool_radius,
      py::arg("tool_length") = path.tool_length,
      py::arg("contact_tolerance") = path.contact_tolerance,
      py::arg("num_threads") = target.num_threads, kPlanToolpathDoc);
  module.def(
      "cover_polygon",
      [](const SurfaceLike& surface, const ArrayLike& polygon, double spacing, double direction,
         double margin) {
        const Surface bottom = surface_argument(surface);
        const Polygon corners = table_argument("polygon", polygon, 2);
        const Aims aims = cover_polygon(bottom, corners, spacing, {direction, margin});
        return to_numpy(std::vector<double>(aims.data(), aims.data() + aims.size()), {6});
      },
      py::arg("surface"), py::arg("polygon"), py::arg("spacing"), py::kw_only(),
      py::arg("direction") = cover.direction, py::arg("margin") = cover.margin, kCoverPolygonDoc);
}

}  // namespace bathyal::python
