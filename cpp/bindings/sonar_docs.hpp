// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace bathyal::python::sonar_docs {

inline constexpr const char* kSonar = R"(The description of a sonar, and what it hears.

Made by `bathyal.sonars`, changed by `replace`. A beam is made narrow by a line array: φ is the angle
from the plane across the array, ψ turns about it. Of a side-scan the array lies along x (φ along
track, ψ from the bottom to the horizon); of a multibeam, imaging or scanning sonar along y. A ray
that meets a surface at range R under the angle θ from its normal brings

    w = σ₀(θ) · b² · exp(−4 α R) · ΔΩ / (R² cos θ),

α in Np/m, b² the two-way beam pattern, ΔΩ its solid angle; without `spreading` R⁻⁴ is left out.
Every physical effect is a switch, and off.

Examples
--------
>>> import bathyal, numpy as np
>>> world = bathyal.World()
>>> corners = [[-99, -99, 0], [99, -99, 0], [99, 99, 0], [-99, 99, 0]]
>>> _ = world.add(bathyal.TriangleMesh(corners, [[0, 1, 2], [0, 2, 3]]), material="sand")
>>> sonar = bathyal.sonars.side_scan().replace(range=50.0, spreading=True)
>>> pose = np.eye(4)
>>> pose[2, 3] = 10.0
>>> ping = sonar.ping(world, pose)
>>> ping.intensity.shape, round(float(ping.range[ping.intensity[0] > 0][0]), 3)
((2, 1500), 10.017)
)";

inline constexpr const char* kPreset = R"(A sonar by the name of its class; see `bathyal.sonars`.

Parameters
----------
name : str
    "side_scan", "side_scan_100khz", "paper_side_scan", "multibeam", "echo_sounder",
    "paper_forward_sounders", "imaging" or "scanning".
physics : str
    "off", or "real": every switch on.

Returns
-------
Sonar
)";

inline constexpr const char* kReplace = R"(Another sonar with the given fields changed.

Parameters
----------
**fields
    Any of the properties.

Returns
-------
Sonar

Raises
------
ValueError
    For a name that is no field, or a value out of its range.
)";

inline constexpr const char* kPingTruth =
    "What each sample came from: of all rays in it, the one that contributed most. NaN and −1 "
    "where "
    "nothing was hit.";

inline constexpr const char* kPing = "What a sonar heard of one ping.";

inline constexpr const char* kPingCall = R"(One ping.

Parameters
----------
world : World
world_from_vehicle : (4, 4) array
    x forward, y port, z up.
time : float
    At which the world is looked at [s].
velocity, angular_velocity : (3,) array, optional
    Of the vehicle in the world [m/s, rad/s], at rest unless given; they count where `motion` is on.
seed : int
    Of speckle, noise and dropouts. Speckle belongs to the place, noise and dropouts to the time.
ping : int
    Counts the pings of a scanning head.
truth : bool
    Whether the ping has its truth: 48 bytes a sample.
num_threads : int
    0 means all; any number gives the same bytes.

Returns
-------
Ping

Raises
------
ValueError
    For a pose that is not rigid, a sonar above the surface, below the bottom or inside a body.
)";

inline constexpr const char* kBackscatter =
    R"(Backscatter of a material, by this sonar's law and frequency.

Parameters
----------
world : World
material : str
    One of its materials.
incidence : (N,) array
    From the surface's normal, 0 to π/2 [rad].

Returns
-------
(N,) array
    σ₀: power per unit area and solid angle at 1 m.

Examples
--------
>>> import bathyal, numpy as np
>>> sonar = bathyal.sonars.side_scan_100khz().replace(backscatter="material")
>>> sigma = sonar.scattering_strength(bathyal.World(), "sand", np.radians([0.0, 30.0, 60.0]))
>>> np.round(10 * np.log10(sigma), 1).tolist()
[-9.3, -18.5, -21.6]
)";

inline constexpr const char* kHear = R"(A survey, ping after ping; `survey` keeps it as a record.

Parameters
----------
world : World
trajectory : Trajectory
    world_from_vehicle.
keep : function
    Called with the ping, its number and world_from_vehicle; the survey ends where it returns False.
seed : int
    Of all random numbers.
first, count : int
    Which of the pings at `ping_times`; −1 is to the end. Parts join to the bytes of the whole.
truth : bool
    Whether pings have their truth.
num_threads : int
    0 means all.

Raises
------
ValueError
    As `ping`, with the ping's number.
)";

/// Each field's docstring.
inline const std::vector<std::pair<std::string, std::string>>& fields() {
  static const std::vector<std::pair<std::string, std::string>> docs = {
      {"kind", "\"echo_sounder\", \"side_scan\", \"multibeam\", \"imaging\" or \"scanning\"."},
      {"name", "What it is called."},
      {"frequency", "[Hz]"},
      {"pulse_length", "[s]"},
      {"bandwidth", "[Hz]"},
      {"source_level", "[dB re 1 µPa at 1 m]"},
      {"ping_rate", "[Hz]"},
      {"range", "Slant range of the end of the last sample [m]."},
      {"samples", "Of a row."},
      {"beams", "Rows of a ping; of a side-scan port, or port and starboard."},
      {"sector", "Between the axes of the outer beams [rad]."},
      {"beam_width", "In φ, where one-way power is half [rad]."},
      {"fan_width", "In ψ, where one-way power is half [rad]."},
      {"fan_span",
       "Of ψ that rays cover [rad]; an echo sounder's beam is a cone, to which it does not apply."},
      {"tilt", "Of the fan's middle below the horizontal [rad]."},
      {"axis_tilt", "Of the beam's axis below the horizontal, where its pattern counts [rad]."},
      {"head_start", "Angle of a scanning head at ping 0, to port [rad]."},
      {"head_step", "And from ping to ping [rad]."},
      {"vehicle_from_sonar", "(4, 4), its mount."},
      {"rays",
       "\"angles\": equal angles with their solid angles; \"camera\": pixels that count equally."},
      {"rays_across_beam", "Over φ, of each beam."},
      {"rays_along_fan", "Over ψ, of each beam."},
      {"spreading", "Whether power falls with R⁻⁴."},
      {"absorption", "None, \"francois_garrison\" or \"ainslie_mccolm\"."},
      {"backscatter", "\"lambert\", or \"material\": its table or sediment where it has one."},
      {"beam_pattern",
       "None; of a line array by its shading, \"uniform\" (sinc², first side lobe −13.3 dB), "
       "\"hann\" (−31.5 dB) or \"taylor\" (−30 dB); or \"gaussian\"."},
      {"pixel_solid_angle",
       "Whether pixels count by their solid angle, cos³ of the angle off axis."},
      {"refraction", "Whether sound runs along arcs, by the profile of the water."},
      {"multiples",
       "Reflections after which a ray is still followed, 0 to 8; under a surface, that one "
       "reflects "
       "and scatters as well."},
      {"wind_speed", "At 10 m, by which the sea surface scatters [m/s]."},
      {"motion", "Whether the vehicle moves between transmission and reception."},
      {"side_lobes",
       "Whether each beam of a multibeam or an imaging sonar hears its far side lobes, too."},
      {"layover", "Whether what is nearer than a lower part of its fan is heard as well."},
      {"pulse", "None, \"rectangle\" (its length) or \"chirp\" (compressed to c / 2B)."},
      {"speckle", "None, \"rayleigh\" or \"k\"."},
      {"speckle_shape", "ν of the K distribution."},
      {"noise", "Whether the sea's noise is heard."},
      {"noise_level",
       "Its spectral level [dB re 1 µPa²/Hz]; None: `bathyal.ambient_noise` at the frequency and "
       "wind speed."},
      {"tvg", "Whether a gain over range is applied."},
      {"tvg_spreading", "Its part with range [dB a decade], 0 at 1 m."},
      {"tvg_absorption", "Its part with the way there and back [dB/m]."},
      {"tvg_offset", "Its part at all ranges [dB]."},
      {"dropout_rate", "Part of the pings that bring nothing: all their samples are 0."},
      {"beam_dropout_rate", "Part of the rows of the other pings that are 0."},
      {"bits", "Of the samples' amplitude; 0 is not quantised."},
      {"full_scale", "Intensity at which samples clip [dB]."},
  };
  return docs;
}

}  // namespace bathyal::python::sonar_docs
