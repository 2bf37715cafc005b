// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/navigation/navigation_filter.hpp"

#include <pybind11/stl.h>

#include <cmath>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "bathyal/base/error.hpp"
#include "bathyal/base/text.hpp"
#include "bathyal/navigation/dead_reckoning.hpp"
#include "bathyal/navigation/navigation_smoother.hpp"
#include "bathyal/navigation/navigation_state_bytes.hpp"
#include "bathyal/navigation/smooth_reckoning.hpp"
#include "bindings.hpp"
#include "navigation_filter_docs.hpp"
#include "navigation_track.hpp"
#include "sensors.hpp"

namespace bathyal::python {
namespace {

namespace docs = navigation_filter_docs;
using NumbersByName = py::KWArgs<py::float_>;
using Deviations = py::typing::Union<py::float_, ArrayLike>;

/// A filter with its state, and its record where one is kept.
struct PyFilter {
  NavigationRecord record;
  NavigationState state;
  bool keeps = false;

  const NavigationFilter& filter() const { return record.filter(); }
  std::vector<NavigationStep>* steps() { return keeps ? &record.steps() : nullptr; }
};

/// One number for the three axes, or one each.
Vec3 deviations_argument(std::string_view name, const py::object& given) {
  const py::array array = array_argument(name, given, "a number or 3 of them");
  if (array.ndim() == 0)
    return Vec3::Constant(values_argument(name, array.attr("ravel")()).data()[0]);
  return vector_argument(name, given);
}

void put_options(NavigationOptions& options, const NumbersByName& given) {
  for (const auto& [key, value] : given) {
    const std::string name = py::cast<std::string>(key);
    bool known = false;
    for (const docs::Option& option : docs::options()) {
      if (name != option.name) continue;
      known = true;
      try {
        options.*option.member = py::cast<double>(value);
      } catch (const py::cast_error&) {
        throw_argument(name, "a number", py::repr(value).cast<std::string>());
      }
    }
    if (known) continue;
    std::vector<std::string> names;
    for (const docs::Option& option : docs::options()) names.emplace_back(option.name);
    throw_argument(name, "one of the options " + listed(names), "none of them");
  }
}

std::unique_ptr<PyFilter> make_filter(const std::vector<SensorOptions>& devices, double time,
                                      const OptionalArray& pose, const ArrayLike& velocity,
                                      bool record, const Deviations& initial_position,
                                      const Deviations& initial_velocity,
                                      const Deviations& initial_attitude,
                                      const NumbersByName& given) {
  NavigationOptions options;
  options.devices = devices;
  options.initial_position = deviations_argument("initial_position", initial_position);
  options.initial_velocity = deviations_argument("initial_velocity", initial_velocity);
  options.initial_attitude = deviations_argument("initial_attitude", initial_attitude);
  put_options(options, given);
  const Pose begin = pose_argument("pose", pose);
  check_rigid("pose", begin);
  NavigationRecord kept(std::move(options));
  NavigationState state = kept.filter().start(time, begin, vector_argument("velocity", velocity));
  return std::make_unique<PyFilter>(PyFilter{std::move(kept), std::move(state), record});
}

NavigationUpdate update(PyFilter& f, const std::string& device, double time,
                        const ArrayLike& values) {
  const int row = f.filter().device(device);
  const SensorOptions& sensor = f.filter().options().devices[static_cast<std::size_t>(row)];
  const std::vector<double> numbers = numbers_argument("values", values);
  SensorReading reading;
  reading.kind = sensor.kind;
  reading.time = reading.arrival = time;
  reading.count = static_cast<int>(numbers.size());
  for (std::size_t i = 0; i < std::min(numbers.size(), reading.values.size()); ++i) {
    reading.values[i] = numbers[i];
  }
  return f.filter().update(f.state, row, reading, f.steps());
}

std::shared_ptr<PyTrack> run(PyFilter& f, const std::vector<SensorReadings>& readings, int every) {
  std::vector<DeviceReadings> given;
  auto track = std::make_shared<PyTrack>();
  for (const SensorReadings& one : readings) {
    given.push_back({f.filter().device(one.sensor.name), one.rows});
    track->names.push_back(one.sensor.name);
  }
  const py::gil_scoped_release release;
  FilterRun got = run_readings(f.filter(), f.state, given, every, f.steps());
  track->rows = std::move(got.estimate);
  track->updates = std::move(got.updates);
  return track;
}

std::shared_ptr<PyTrack> smoothed(const PyFilter& f) {
  if (!f.keeps) throw_argument("record", "True, of a filter that is to be smoothed", "False");
  auto track = std::make_shared<PyTrack>();
  const py::gil_scoped_release release;
  track->rows = f.record.smoothed();
  return track;
}

std::shared_ptr<PyTrack> smooth_arrays(const ArrayLike& time, const ArrayLike& attitude,
                                       const ArrayLike& velocity, const ArrayLike& fix_time,
                                       const ArrayLike& fix_position, const Deviations& fix_noise,
                                       const Deviations& initial_attitude,
                                       const NumbersByName& given) {
  NavigationOptions options = reckoning_options();
  options.initial_attitude = deviations_argument("initial_attitude", initial_attitude);
  put_options(options, given);
  const ReckonedTrack track{numbers_argument("time", time), attitude_argument(attitude),
                            rows_of_three("velocity", velocity)};
  const PositionFixes fixes{numbers_argument("fix_time", fix_time),
                            rows_of_three("fix_position", fix_position),
                            deviations_argument("fix_noise", fix_noise)};
  auto result = std::make_shared<PyTrack>();
  const py::gil_scoped_release release;
  SmoothedTrack got = smooth_reckoning(track, fixes, options);
  DeviceUpdates updates;
  for (const NavigationUpdate& fix : got.fixes) {
    updates.nis.push_back(fix.used ? fix.nis : std::nan(""));
    updates.accepted.push_back(fix.accepted);
  }
  result->rows = std::move(got.estimate);
  result->updates = {std::move(updates)};
  result->names = {"fix"};
  return result;
}

py::array numbers(const NavigationUpdate& u) {
  return to_numpy(std::vector<double>(u.innovation.begin(), u.innovation.begin() + u.count));
}

py::array covariance(const NavigationUpdate& u) {
  const Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> corner =
      u.covariance.topLeftCorner(u.count, u.count);
  return to_numpy(corner);
}

void bind_update(py::module_& module) {
  py::class_<NavigationUpdate>(module, "NavigationUpdate", "What became of a reading.")
      .def_readonly("used", &NavigationUpdate::used,
                    "Whether it says something of the motion, and came in time.")
      .def_readonly("accepted", &NavigationUpdate::accepted, "Whether it also passed the gate.")
      .def_property_readonly("innovation", &numbers, "(C,) reading minus predicted.")
      .def_property_readonly("covariance", &covariance, "(C, C) of the innovation.")
      .def_readonly("nis", &NavigationUpdate::nis,
                    "Square of the innovation by its covariance; its mean is C where the filter is "
                    "right.");
}

}  // namespace

void bind_navigation_filter(py::module_& module) {
  bind_update(module);
  bind_navigation_track(module);
  const NavigationOptions d;
  const Deviations none = py::float_(0.0);
  py::class_<PyFilter>(module, "NavigationFilter", docs::kFilter)
      .def(py::init(&make_filter), py::arg("devices") = std::vector<SensorOptions>(), py::kw_only(),
           py::arg("time") = 0.0, py::arg("pose") = py::none(),
           py::arg("velocity") = py::make_tuple(0.0, 0.0, 0.0), py::arg("record") = false,
           py::arg("initial_position") = none, py::arg("initial_velocity") = none,
           py::arg("initial_attitude") = none)
      .def(
          "predict",
          [](PyFilter& f, double time, const ArrayLike& rate, const ArrayLike& force) {
            f.filter().predict(f.state, time, vector_argument("rate", rate),
                               vector_argument("force", force), f.steps());
          },
          py::arg("time"), py::arg("rate"), py::arg("force"), docs::kPredict)
      .def(
          "predict_motion",
          [](PyFilter& f, double time, const ArrayLike& attitude, const ArrayLike& velocity) {
            const Eigen::Quaterniond turn(
                rotation_of_angles(vector_argument("attitude", attitude)));
            f.filter().predict_motion(f.state, time, turn, vector_argument("velocity", velocity),
                                      f.steps());
          },
          py::arg("time"), py::arg("attitude"), py::arg("velocity"), docs::kPredictMotion)
      .def("update", &update, py::arg("device"), py::arg("time"), py::arg("values"), docs::kUpdate)
      .def("run", &run, py::arg("readings"), py::kw_only(), py::arg("every") = 1, docs::kRun)
      .def("smooth", &smoothed,
           "The best estimate at each prediction given all readings, those after it too; needs "
           "record=True.")
      .def(
          "to_bytes", [](const PyFilter& f) { return py::bytes(to_bytes(f.state)); },
          "Its whole state but the record: equal states have equal bytes.")
      .def(
          "restore",
          [](PyFilter& f, const py::bytes& state) {
            f.state = navigation_state_of(std::string_view(state));
            f.record.clear();
            f.state.now.steps = 0;
            for (NavigationSnapshot& past : f.state.snapshots) past.estimate.steps = 0;
          },
          py::arg("state"), "Goes back to a state as `to_bytes` gave it; a record begins anew.")
      .def_property_readonly(
          "time", [](const PyFilter& f) { return f.state.now.time; }, "[s]")
      .def_property_readonly(
          "pose", [](const PyFilter& f) { return to_numpy(f.state.now.world_from_vehicle()); },
          "(4, 4) world_from_vehicle.")
      .def_property_readonly(
          "position", [](const PyFilter& f) { return to_numpy(f.state.now.position); },
          "(3,) in the world [m].")
      .def_property_readonly(
          "velocity", [](const PyFilter& f) { return to_numpy(f.state.now.velocity); },
          "(3,) over ground, in the world [m/s].")
      .def_property_readonly(
          "gyro_bias", [](const PyFilter& f) { return to_numpy(f.state.now.gyro_bias); },
          "(3,) in the vehicle [rad/s].")
      .def_property_readonly(
          "accel_bias", [](const PyFilter& f) { return to_numpy(f.state.now.accel_bias); },
          "(3,) in the vehicle [m/s²].")
      .def_property_readonly(
          "current",
          [](const PyFilter& f) { return to_numpy(Eigen::VectorXd(f.state.now.current)); },
          "(2,) of the water in the world [m/s].")
      .def_property_readonly(
          "log_scale", [](const PyFilter& f) { return f.state.now.log_scale; },
          "The log reads 1 + this times the speed.")
      .def_property_readonly(
          "covariance",
          [](const PyFilter& f) {
            const Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> whole =
                f.state.now.covariance;
            return to_numpy(whole);
          },
          "(24, 24) of its errors, in the order the class names.")
      .def("__repr__", [](const PyFilter& f) {
        return "NavigationFilter(at " + to_text(f.state.now.time) + " s, " +
               counted(static_cast<long>(f.filter().options().devices.size()), "device") + ")";
      });
  const NavigationOptions reckoning = reckoning_options();
  module.def("smooth", &smooth_arrays, py::arg("time"), py::arg("attitude"), py::arg("velocity"),
             py::arg("fix_time"), py::arg("fix_position"), py::kw_only(),
             py::arg("fix_noise") = Deviations(py::float_(PositionFixes().noise.x())),
             py::arg("initial_attitude") =
                 Deviations(to_numpy(reckoning.initial_attitude).attr("tolist")()),
             docs::kSmooth);
}

}  // namespace bathyal::python
