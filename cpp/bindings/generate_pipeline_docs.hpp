// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace bathyal::python {

inline constexpr const char* kMakePipelineDoc = R"(A pipeline along a smooth curve through a route.

On a terrain it rests where it touches, five rays across it at each station, and sags between: least
line over the bottom with z'' of at most 1/sag.

Parameters
----------
route : (K, 2) or (K, 3) array
    On a terrain places seen from above, else the middle line itself [m].
diameter : float
    [m]
terrain : Scene, optional
    What it lies on: its uppermost surface.
burial : float or (K,) array
    How far the underside lies below the bottom [m]: 0 on it, the diameter flush. Of a value each
    point of the route, linear between; not within spans.
spans : (S, 2) array
    Free spans, from and to along the route [m], rising: straight over what rises between the ends.
span_gap : float
    How much higher than that the middle of a span is [m].
sag : float
    Horizontal tension over its weight in water a metre [m]; inf bridges every hollow.
anode_spacing, anode_length, anode_thickness : float
    Rings beyond the pipe's radius [m], a spacing of 0 for none.
joint_spacing, joint_length, joint_recess : float
    Field joints below the pipe's radius [m], a spacing of 0 for none.
step : float
    Between two rings of the mesh [m].
sides : int
    Of the cross-section, its corners on the circle.
num_threads : int
    0: all.

Returns
-------
Pipeline

Raises
------
ValueError
    For a route of one point, two neighbours at one place, no terrain below, bends tighter than the
    radius (a route that crosses itself further on is not found), spans that overlap or leave the
    route.

Examples
--------
>>> import bathyal
>>> bottom = bathyal.Scene(bathyal.make_seabed(60, 0.5, relief_rms=0.0))
>>> pipe = bathyal.make_pipeline([(-20, 0), (20, 0)], 0.4, bottom, burial=0.1, spans=[(10, 20)])
>>> pipe
Pipeline(81 stations, 40 m)
>>> pipe.burial[[0, -1]].round(6)
array([0.1, 0.1])
)";

inline constexpr const char* kMakeCableDoc = R"(A cable along a smooth curve through a route.

It lies as a pipeline does, but thin and heavy for its tension: over hollows it hangs in catenaries,
for small slopes z'' = 1/sag.

Parameters
----------
route : (K, 2) or (K, 3) array
    On a terrain places seen from above, else the middle line itself [m].
diameter : float
    [m]
terrain : Scene, optional
    What it lies on: its uppermost surface.
burial : float or (K,) array
    How far the underside lies below the bottom [m].
sag : float
    Parameter of its catenaries: horizontal tension over its weight in water a metre [m].
slack : float
    How much longer it is than the route, as a share, 0 to 0.3, in bends to both sides.
slack_wavelength : float
    Of these bends [m].
seed : int
    Of where they begin.
step : float
    Between two rings of the mesh [m].
sides : int
    Of the cross-section.
num_threads : int
    0: all.

Returns
-------
Pipeline
    Stations along the line with its slack.

Examples
--------
>>> import bathyal
>>> bathyal.make_cable([(0, 0, -5), (30, 0, -5)], 0.05)
Pipeline(121 stations, 30 m)
)";

}  // namespace bathyal::python
