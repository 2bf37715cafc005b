// SPDX-License-Identifier: BSD-3-Clause
#include "navigation_track.hpp"

#include <cstdint>
#include <memory>
#include <utility>

#include "arrays.hpp"
#include "bathyal/base/text.hpp"
#include "navigation_filter_docs.hpp"

namespace bathyal::python {
namespace {

/// (N,) or (N, k): what `get` gives of each estimate.
template <class Get>
py::array rows_of(const PyTrack& track, const Get& get) {
  std::vector<double> values;
  py::ssize_t width = 0;
  for (const NavigationEstimate& row : track.rows) {
    const auto vector = get(row);
    width = static_cast<py::ssize_t>(vector.size());
    values.insert(values.end(), vector.data(), vector.data() + vector.size());
  }
  return to_numpy(std::move(values), {width});
}

/// The row of a device among what a track says of its readings.
const DeviceUpdates& updates_of(const PyTrack& track, const std::string& device) {
  for (std::size_t i = 0; i < track.names.size(); ++i) {
    if (track.names[i] == device) return track.updates[i];
  }
  throw_argument(
      "device",
      track.names.empty() ? "none: the track has no readings" : "one of " + listed(track.names),
      "\"" + device + "\"");
}

}  // namespace

void bind_navigation_track(py::module_& module) {
  py::class_<PyTrack, std::shared_ptr<PyTrack>>(module, "NavigationTrack",
                                                navigation_filter_docs::kTrack)
      .def_property_readonly(
          "time",
          [](const PyTrack& t) {
            std::vector<double> time;
            for (const NavigationEstimate& row : t.rows) time.push_back(row.time);
            return to_numpy(std::move(time));
          },
          "(N,) [s].")
      .def_property_readonly(
          "pose",
          [](const PyTrack& t) {
            std::vector<Pose> poses;
            for (const NavigationEstimate& row : t.rows) poses.push_back(row.world_from_vehicle());
            return to_numpy(poses);
          },
          "(N, 4, 4) world_from_vehicle.")
      .def_property_readonly(
          "position",
          [](const PyTrack& t) { return rows_of(t, [](const auto& e) { return e.position; }); },
          "(N, 3) in the world [m].")
      .def_property_readonly(
          "velocity",
          [](const PyTrack& t) { return rows_of(t, [](const auto& e) { return e.velocity; }); },
          "(N, 3) over ground, in the world [m/s].")
      .def_property_readonly(
          "gyro_bias",
          [](const PyTrack& t) { return rows_of(t, [](const auto& e) { return e.gyro_bias; }); },
          "(N, 3) in the vehicle [rad/s].")
      .def_property_readonly(
          "accel_bias",
          [](const PyTrack& t) { return rows_of(t, [](const auto& e) { return e.accel_bias; }); },
          "(N, 3) in the vehicle [m/s²].")
      .def_property_readonly(
          "current",
          [](const PyTrack& t) { return rows_of(t, [](const auto& e) { return e.current; }); },
          "(N, 2) of the water in the world [m/s].")
      .def_property_readonly(
          "fix_lever",
          [](const PyTrack& t) { return rows_of(t, [](const auto& e) { return e.fix_lever; }); },
          "(N, 3) from where fixes should belong to, in the vehicle [m].")
      .def_property_readonly(
          "fix_point",
          [](const PyTrack& t) { return rows_of(t, [](const auto& e) { return e.fix_point(); }); },
          "(N, 3) where fixes belong to, in the world [m]: the position and the fix lever off it.")
      .def_property_readonly(
          "log_mount",
          [](const PyTrack& t) { return rows_of(t, [](const auto& e) { return e.log_mount; }); },
          "(N, 3) by which the log is turned more than its mount says [rad].")
      .def_property_readonly(
          "log_scale",
          [](const PyTrack& t) {
            std::vector<double> scale;
            for (const NavigationEstimate& row : t.rows) scale.push_back(row.log_scale);
            return to_numpy(std::move(scale));
          },
          "(N,) the log reads 1 + this times the speed.")
      .def_property_readonly(
          "std",
          [](const PyTrack& t) {
            return rows_of(t, [](const NavigationEstimate& e) {
              return NavigationVector(e.covariance.diagonal().cwiseMax(0.0).cwiseSqrt());
            });
          },
          "(N, 24) standard deviations of the errors, in the order `NavigationFilter` names.")
      .def(
          "accepted",
          [](const PyTrack& t, const std::string& device) {
            const DeviceUpdates& updates = updates_of(t, device);
            std::vector<std::uint8_t> flags(updates.accepted.begin(), updates.accepted.end());
            return to_numpy(std::move(flags)).attr("astype")("bool").cast<py::array>();
          },
          py::arg("device"),
          "(K,) of bool: which readings of a device were used and passed the gate.")
      .def(
          "nis",
          [](const PyTrack& t, const std::string& device) {
            return to_numpy(std::vector<double>(updates_of(t, device).nis));
          },
          py::arg("device"), "(K,) normalised innovations squared of a device; NaN where not used.")
      .def("__len__", [](const PyTrack& t) { return t.rows.size(); })
      .def("__repr__", [](const PyTrack& t) {
        return "NavigationTrack(" + counted(static_cast<long>(t.rows.size()), "row") + ")";
      });
}

}  // namespace bathyal::python
