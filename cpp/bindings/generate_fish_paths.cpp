// SPDX-License-Identifier: BSD-3-Clause
#include <pybind11/stl.h>

#include <string>

#include "bathyal/base/error.hpp"
#include "bathyal/world/generate/fish_paths.hpp"
#include "bindings.hpp"
#include "generate.hpp"

namespace bathyal::python {
namespace {

constexpr const char* kFishPathsDoc =
    R"(Random smooth paths over a terrain, for fish or what drifts.

Each path, straight between its poses as a Trajectory is, is checked against the scene. The same
bytes for any number of threads; more fish leave the first ones' paths alone.

Parameters
----------
scene : Scene
count : int
duration : float
    [s]
seed : int
region : (2, 2) array, optional
    Low and high corner of the place in which they swim, seen from above [m]; else the scene's box.
clearance : float
    No path comes nearer to the scene [m].
altitude : float
    Up to so much higher than that they swim [m].
ceiling : float
    z below which they stay [m].
speed : float
    Horizontal [m/s].
turn_rate : float
    Typical rate at which they change course [rad/s].
step : float
    Between two poses [s].
num_threads : int
    0: all.

Returns
-------
list of Trajectory
    world_from_fish: x ahead, back up.

Raises
------
ValueError
    For an option out of its range, and where no path was found: a region too small to turn in, a
    ceiling too low.

Examples
--------
>>> import bathyal
>>> bottom = bathyal.Scene(bathyal.make_seabed(40, 0.5))
>>> bathyal.fish_paths(bottom, 2, 60.0, seed=1)[0]
Trajectory(241 poses, 0 to 60 s)
)";

}  // namespace

void bind_fish_paths(py::module_& module) {
  const FishPathOptions d;
  module.def(
      "fish_paths",
      [](const Scene& scene, int count, double duration, std::uint64_t seed,
         const OptionalArray& region, double clearance, double altitude, double ceiling,
         double speed, double turn_rate, double step, int num_threads) {
        FishPathOptions o;
        o.seed = seed;
        if (!region.is_none()) {
          const std::vector<Vec2> corners = places_argument("region", region);
          if (corners.size() != 2) {
            throw_argument("region", "two corners, shape (2, 2)", std::to_string(corners.size()));
          }
          o.region = {corners[0], corners[1]};
        }
        o.clearance = clearance;
        o.altitude = altitude;
        o.ceiling = ceiling;
        o.speed = speed;
        o.turn_rate = turn_rate;
        o.step = step;
        o.num_threads = num_threads;
        const py::gil_scoped_release release;
        return fish_paths(scene, count, duration, o);
      },
      py::arg("scene"), py::arg("count"), py::arg("duration"), py::kw_only(),
      py::arg("seed") = d.seed, py::arg("region") = py::none(), py::arg("clearance") = d.clearance,
      py::arg("altitude") = d.altitude, py::arg("ceiling") = d.ceiling, py::arg("speed") = d.speed,
      py::arg("turn_rate") = d.turn_rate, py::arg("step") = d.step,
      py::arg("num_threads") = d.num_threads, kFishPathsDoc);
}

}  // namespace bathyal::python
