// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/water/sound_path.hpp"

#include <algorithm>
#include <cmath>

#include "bathyal/base/check.hpp"
#include "bathyal/base/error.hpp"
#include "bathyal/base/text.hpp"
#include "bindings.hpp"
#include "water_docs.hpp"
#include "water_parts.hpp"

namespace bathyal::python {
namespace {

double angle_of(const SoundState& state) { return std::atan2(state.down, state.along); }

/// Where beams are after their travel times, in columns of one shape.
struct TracedSound {
  py::object across;
  py::object depth;
  py::object angle;
};

TracedSound trace_sound(const SpeedSource& water, const ArrayLike& launch_angle,
                        const ArrayLike& travel_time, const ArrayLike& start_depth, double time) {
  const SpeedProfile profile = speed_source_argument(water, time);
  const Broadcast given = broadcast_arguments(
      {{"launch_angle", launch_angle}, {"travel_time", travel_time}, {"start_depth", start_depth}});
  std::vector<double> across(given.size());
  std::vector<double> depth(given.size());
  std::vector<double> angle(given.size());
  for (std::size_t i = 0; i < given.size(); ++i) {
    check_not_negative("travel_time", given.at(1, i));
    SoundPathOptions options;
    options.max_time = std::max(given.at(1, i), 1e-12);
    const SoundPath path(profile, given.at(2, i), given.at(0, i), options);
    const bool lost = path.end() != SoundPathEnd::kTime;
    const SoundState end = path.at(given.at(1, i));
    across[i] = lost ? std::nan("") : end.distance;
    depth[i] = lost ? std::nan("") : end.depth;
    angle[i] = lost ? std::nan("") : angle_of(end);
  }
  return {given.result(std::move(across)), given.result(std::move(depth)),
          given.result(std::move(angle))};
}

py::array table_of(const std::vector<SoundState>& states) {
  std::vector<double> values;
  for (const SoundState& s : states) {
    values.insert(values.end(), {s.time, s.distance, s.depth, angle_of(s)});
  }
  return to_numpy(std::move(values), {4});
}

template <class Value>
auto node_column(Value value) {
  return [value](const SoundPath& path) {
    std::vector<double> values;
    for (const SoundState& node : path.nodes()) values.push_back(value(node));
    return to_numpy(std::move(values));
  };
}

const EnumNames<SoundPathEnd> kEnds{{"time", SoundPathEnd::kTime},
                                    {"distance", SoundPathEnd::kDistance},
                                    {"surface", SoundPathEnd::kSurface}};

void bind_sound_paths(py::module_& module) {
  const SoundPathOptions d;
  py::class_<SoundPath>(module, "SoundPath", kSoundPathDoc)
      .def(py::init([](const SpeedSource& water, double start_depth, double launch_angle,
                       double max_time, double max_distance, bool surface, bool surface_reflects,
                       double time) {
             SoundPathOptions options;
             options.max_time = max_time;
             options.max_distance = max_distance;
             options.surface = surface;
             options.surface_reflects = surface_reflects;
             return SoundPath(speed_source_argument(water, time), start_depth, launch_angle,
                              options);
           }),
           py::arg("water"), py::arg("start_depth"), py::arg("launch_angle"), py::kw_only(),
           py::arg("max_time") = d.max_time, py::arg("max_distance") = d.max_distance,
           py::arg("surface") = d.surface, py::arg("surface_reflects") = d.surface_reflects,
           py::arg("time") = 0.0)
      .def_property_readonly("time", node_column([](const SoundState& s) { return s.time; }),
                             "(K,) at the ends of the arcs [s].")
      .def_property_readonly("distance",
                             node_column([](const SoundState& s) { return s.distance; }),
                             "(K,) horizontal, at the ends of the arcs [m].")
      .def_property_readonly("depth", node_column([](const SoundState& s) { return s.depth; }),
                             "(K,) at the ends of the arcs [m].")
      .def_property_readonly("angle", node_column(&angle_of),
                             "(K,) below the horizontal, where each arc begins [rad].")
      .def_property_readonly("duration", &SoundPath::duration, "Of the whole path [s].")
      .def_property_readonly(
          "end", [](const SoundPath& path) { return enum_name(path.end(), kEnds); },
          "What ended it: \"time\", \"distance\" or \"surface\".")
      .def(
          "at",
          [](const SoundPath& path, const ArrayLike& time) {
            const std::vector<double> times = column_argument("time", time);
            std::vector<SoundState> states;
            for (const double t : times) {
              check_finite("time", t);
              states.push_back(path.at(t));
            }
            return table_of(states);
          },
          py::arg("time"),
          "(N, 4) time [s], horizontal distance [m], depth [m] and angle [rad] at (N,) times, on "
          "the exact arcs; beyond the path its ends.")
      .def(
          "chords",
          [](const SoundPath& path, double tolerance) { return table_of(path.chords(tolerance)); },
          py::arg("tolerance"),
          "(M, 4) points as of `at` whose straight chords are nowhere farther from the arcs than "
          "the tolerance [m].")
      .def("__repr__", [](const SoundPath& path) {
        return "SoundPath(" + three_digits(path.duration()) + " s, " +
               counted(static_cast<long>(path.nodes().size()) - 1, "arc") + ")";
      });
}

void bind_rays_of_sound(py::module_& module) {
  py::class_<TracedSound>(module, "TracedSound", "Where beams are. Made by `trace_sound`.")
      .def_property_readonly(
          "across", [](const TracedSound& t) -> NumberOrArray { return t.across; },
          "Horizontal distance from the start [m].")
      .def_property_readonly(
          "depth", [](const TracedSound& t) -> NumberOrArray { return t.depth; },
          "Below the surface [m].")
      .def_property_readonly(
          "angle", [](const TracedSound& t) -> NumberOrArray { return t.angle; },
          "Below the horizontal [rad].")
      .def("__iter__",
           [](const TracedSound& t) { return py::iter(py::make_tuple(t.across, t.depth)); })
      .def("__repr__", [](const TracedSound& t) {
        return "TracedSound(across=" + std::string(py::repr(t.across)) +
               ", depth=" + std::string(py::repr(t.depth)) + ")";
      });
  module.def("trace_sound", &trace_sound, py::arg("water"), py::arg("launch_angle"),
             py::arg("travel_time"), py::arg("start_depth"), py::kw_only(), py::arg("time") = 0.0,
             kTraceSoundDoc);

  py::class_<Eigenray>(module, "Eigenray", "A way of sound between two points.")
      .def_readonly("launch", &Eigenray::launch, "Angle below the horizontal at the start [rad].")
      .def_readonly("arrival", &Eigenray::arrival, "Angle below the horizontal at the end [rad].")
      .def_readonly("time", &Eigenray::time, "[s]")
      .def("__repr__", [](const Eigenray& ray) {
        return "Eigenray(launch=" + three_digits(ray.launch) +
               ", arrival=" + three_digits(ray.arrival) + ", time=" + to_text(ray.time) + ")";
      });
  const EigenrayOptions d;
  module.def(
      "eigenrays",
      [](const SpeedSource& water, double from_depth, double to_depth, double distance, int angles,
         double steepest, bool surface_reflects, double time) {
        const SpeedProfile profile = speed_source_argument(water, time);
        const py::gil_scoped_release release;
        return eigenrays(
            profile, from_depth, to_depth, distance,
            {.angles = angles, .steepest = steepest, .surface_reflects = surface_reflects});
      },
      py::arg("water"), py::arg("from_depth"), py::arg("to_depth"), py::arg("distance"),
      py::kw_only(), py::arg("angles") = d.angles, py::arg("steepest") = d.steepest,
      py::arg("surface_reflects") = d.surface_reflects, py::arg("time") = 0.0, kEigenraysDoc);
}

}  // namespace

void bind_sound_path(py::module_& module) {
  bind_sound_paths(module);
  bind_rays_of_sound(module);
}

}  // namespace bathyal::python
