// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/world/survey/survey.hpp"

#include "arrays.hpp"
#include "bindings.hpp"

namespace bathyal::python {
namespace {

/// Calls `bind(name, function)` with what makes the options from keyword-only arguments: every
/// function about a generated survey takes the same ones.
template <class... Extra>
struct SurveyFunction {
  template <class Function, class... Named>
  static void bind(py::module_& module, const char* name, const Function& function, const char* doc,
                   const Named&... extra) {
    const SurveyOptions d;
    module.def(
        name,
        [function](const Extra&... arguments, std::uint64_t seed, const ArrayLike& origin,
                   double length, double width, double wave_height, double wave_length,
                   double ripple_height, double roughness, int boulders, double boulder_radius,
                   double trench_depth, double trench_width, int lines, double altitude,
                   double opening, int beams, double ping_spacing, double lost_width,
                   double range_noise, double range_noise_rate, double angle_noise,
                   double spike_fraction, int num_threads) {
          SurveyOptions options;
          options.seed = seed;
          options.origin = vector_argument("origin", origin);
          options.length = length;
          options.width = width;
          options.wave_height = wave_height;
          options.wave_length = wave_length;
          options.ripple_height = ripple_height;
          options.roughness = roughness;
          options.boulders = boulders;
          options.boulder_radius = boulder_radius;
          options.trench_depth = trench_depth;
          options.trench_width = trench_width;
          options.lines = lines;
          options.altitude = altitude;
          options.opening = opening;
          options.beams = beams;
          options.ping_spacing = ping_spacing;
          options.lost_width = lost_width;
          options.range_noise = range_noise;
          options.range_noise_rate = range_noise_rate;
          options.angle_noise = angle_noise;
          options.spike_fraction = spike_fraction;
          options.num_threads = num_threads;
          return function(arguments..., options);
        },
        extra..., py::kw_only(), py::arg("seed") = d.seed,
        py::arg("origin") = py::make_tuple(d.origin.x(), d.origin.y(), d.origin.z()),
        py::arg("length") = d.length, py::arg("width") = d.width,
        py::arg("wave_height") = d.wave_height, py::arg("wave_length") = d.wave_length,
        py::arg("ripple_height") = d.ripple_height, py::arg("roughness") = d.roughness,
        py::arg("boulders") = d.boulders, py::arg("boulder_radius") = d.boulder_radius,
        py::arg("trench_depth") = d.trench_depth, py::arg("trench_width") = d.trench_width,
        py::arg("lines") = d.lines, py::arg("altitude") = d.altitude,
        py::arg("opening") = d.opening, py::arg("beams") = d.beams,
        py::arg("ping_spacing") = d.ping_spacing, py::arg("lost_width") = d.lost_width,
        py::arg("range_noise") = d.range_noise, py::arg("range_noise_rate") = d.range_noise_rate,
        py::arg("angle_noise") = d.angle_noise, py::arg("spike_fraction") = d.spike_fraction,
        py::arg("num_threads") = d.num_threads, doc);
  }
};

}  // namespace

void bind_survey(py::module_& module) {
  SurveyFunction<>::bind(
      module, "generate_survey",
      [](const SurveyOptions& options) {
        const py::gil_scoped_release release;
        return generate_survey(options);
      },
      R"(A simulated multibeam survey over a bottom that is known exactly.

Sand waves with ripples, boulders with scour and shadow, a trench, a stripe of lost pings, noise that
grows with range, and the uneven spacing of beams at equal angles. The same seed and options give the
same numbers, for any number of threads. `survey_height` gives the true height.

Parameters
----------
seed : int
origin : (3,) array
    South-west corner and the bottom's mean height [m].
length, width : float
    Along (x) and across (y) the survey lines [m].
wave_height, wave_length : float
    Sand waves, trough to crest and crest to crest [m].
ripple_height, roughness : float
    Ripples, trough to crest, and the rms of a slow undulation [m].
boulders : int
boulder_radius : float
    Of the largest [m].
trench_depth, trench_width : float
    [m]; a depth of 0 for none.
lines, beams : int
    Survey lines over the width, and beams a ping.
altitude : float
    Of the sounder above the mean height [m]. Heights and depths of 20 km at most.
opening : float
    Of the fan of beams [rad].
ping_spacing : float
    Along the line [m].
lost_width : float
    Length of the stripe of pings that the first line lost [m].
range_noise, range_noise_rate, angle_noise : float
    Standard deviation of a range, constant part [m] and growth [m/m], and of a beam's angle [rad].
spike_fraction : float
    Of soundings that are echoes from fish above the bottom, 0 to 1.
num_threads : int
    0: all.

Returns
-------
PointCloud
    With the attributes ``uncertainty``, the standard deviation of z [m], and ``intensity`` [dB].

Raises
------
ValueError
    An option out of its range, or a sounder that would touch the bottom.

Examples
--------
>>> import bathyal
>>> cloud = bathyal.generate_survey(seed=1, length=6.0, beams=64)
>>> cloud
PointCloud(5504 points)
>>> sorted(cloud.attributes)
['intensity', 'uncertainty']
)");
  SurveyFunction<ArrayLike, ArrayLike>::bind(
      module, "survey_height",
      [](const ArrayLike& x, const ArrayLike& y, const SurveyOptions& options) {
        const Values east = values_argument("x", x);
        const Values north = values_argument("y", y);
        Values height;
        {
          const py::gil_scoped_release release;
          height = survey_height(east, north, options);
        }
        return to_numpy(height);
      },
      R"(True height of the bottom under a generated survey.

Parameters
----------
x, y : (N,) arrays
    Survey coordinates [m].
seed, origin, length, …
    As given to generate_survey.

Returns
-------
(N,) array
    [m]

Examples
--------
>>> import bathyal
>>> flat = dict(wave_height=0, ripple_height=0, roughness=0, boulders=0, trench_depth=0)
>>> bathyal.survey_height([431210.0], [6172660.0], **flat)
array([-38.])
)",
      py::arg("x"), py::arg("y"));
}

}  // namespace bathyal::python
