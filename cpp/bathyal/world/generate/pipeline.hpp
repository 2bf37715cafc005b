// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "bathyal/geometry/triangle_mesh.hpp"
#include "bathyal/scene/scene.hpp"
#include "bathyal/world/generate/seabed.hpp"

namespace bathyal {

/// How a pipe is laid along a smooth curve through the points of its route.
struct PipelineOptions {
  /// How far its underside lies below the bottom [m]: 0 on it, the diameter flush with it. One
  /// value, or one a point of the route, linear between; not within spans. None is 0.
  std::vector<double> burial;

  /// Free spans, from and to along the route [m]: straight from end to end, over what rises
  /// between.
  std::vector<std::array<double, 2>> spans;
  double span_gap = 0.0;  ///< how much higher the middle of a span is than that [m], 0 or more

  /// Horizontal tension over its weight in water a metre [m], above 0: the radius to which it sags
  /// where nothing carries it. ∞ bridges every hollow.
  double sag = 150.0;

  double anode_spacing = 0.0;     ///< from one anode to the next [m], 0 for none
  double anode_length = 0.6;      ///< [m], above 0
  double anode_thickness = 0.05;  ///< beyond the pipe's radius [m], above 0
  double joint_spacing = 0.0;     ///< from one field joint to the next [m], 0 for none
  double joint_length = 0.5;      ///< [m], above 0
  double joint_recess = 0.04;     ///< below the pipe's radius [m], above 0, below the radius

  double step = 0.5;    ///< between two rings [m], above 0; ends of spans, anodes have their own
  int sides = 24;       ///< of the cross-section, 3 to 256, corners on the circle
  int num_threads = 0;  ///< 0: all

  void check(double diameter, std::size_t points) const;
};

/// How a cable is laid: as a pipe, but it hangs in catenaries, and may lie with slack.
struct CableOptions {
  std::vector<double> burial;      ///< as of a pipe
  double sag = 10.0;               ///< as of a pipe [m]: the parameter of its catenaries
  double slack = 0.0;              ///< how much longer than its route, as a share, 0 to 0.3
  double slack_wavelength = 20.0;  ///< of the bends that take it up [m], above 0
  std::uint64_t seed = 0;          ///< of these bends
  double step = 0.25;              ///< between two rings [m], above 0
  int sides = 8;                   ///< 3 to 256
  int num_threads = 0;             ///< 0: all
};

/// A pipe or cable as it lies. Its stations are rings of the mesh.
struct Pipeline {
  TriangleMesh mesh;           ///< closed; a vertex attribute "kp" is the way along the route [m]
  PointMatrix center;          ///< (N, 3) its middle line [m]
  std::vector<double> kp;      ///< (N,) along the route [m], horizontal where laid on a terrain
  std::vector<double> bottom;  ///< (N,) height of the terrain below [m]; NaN without one
  std::vector<double> burial;  ///< (N,) underside below the bottom [m], 0 or more; NaN
  std::vector<double> gap;     ///< (N,) underside above the bottom [m], 0 or more; NaN
  std::vector<bool> span;      ///< (N,) in a given span, or free by a tenth of the diameter
};

/// Lays a pipe on a terrain: five rays across it at each station say where it touches, it sags
/// between. \throw std::invalid_argument for a route of one point, with no terrain below, or that
/// bends more tightly than the radius; for spans that overlap or leave the route; more than 10⁶
/// stations.
Pipeline make_pipeline(const std::vector<Vec2>& route, const Scene& terrain, double diameter,
                       const PipelineOptions& options = {});

/// The same along a middle line that is given, with neither burial nor spans.
Pipeline make_pipeline(const std::vector<Vec3>& route, double diameter,
                       const PipelineOptions& options = {});

Pipeline make_cable(const std::vector<Vec2>& route, const Scene& terrain, double diameter,
                    const CableOptions& options = {});
Pipeline make_cable(const std::vector<Vec3>& route, double diameter,
                    const CableOptions& options = {});

}  // namespace bathyal
