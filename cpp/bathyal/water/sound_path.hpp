// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <limits>
#include <vector>

#include "bathyal/water/speed_profile.hpp"

// The path of sound in layers of constant gradient g (Officer 1958; Medwin, Clay 1998, ch. 3): arcs
// of circles of radius c / (g cos θ), θ from the horizontal, positive downwards. Along an arc the
// inverse Gudermannian of θ falls by g per second, so that place and direction after a time are
// closed forms, written here so that they hold for g = 0, for vertical and for horizontal rays
// without a case of their own. A path lies in a vertical plane: `distance` is horizontal in it.

namespace bathyal {

/// A point of a path.
struct SoundState {
  double time = 0.0;      ///< since the launch [s]
  double distance = 0.0;  ///< horizontal [m]
  double depth = 0.0;     ///< [m]
  double along = 1.0;     ///< cosine of the angle below the horizontal, 0 or more
  double down = 0.0;      ///< its sine, positive downwards
  double speed = 0.0;     ///< of sound here [m/s]
};

/// The state after a time on an arc of a gradient: exact, for times of either sign.
SoundState advance(const SoundState& from, double gradient, double time);

/// What ended a path.
enum class SoundPathEnd {
  kTime,      ///< max_time
  kDistance,  ///< max_distance
  kSurface,   ///< depth 0, where it is not reflected
};

struct SoundPathOptions {
  double max_time = 1.0;                                          ///< [s], above 0
  double max_distance = std::numeric_limits<double>::infinity();  ///< horizontal [m], above 0
  bool surface = true;            ///< depth 0 is the sea surface, where a path ends or is reflected
  bool surface_reflects = false;  ///< as a flat mirror
  std::size_t max_arcs = 100000;

  void check() const;
};

class SoundPath {
 public:
  /// \param depth of the launch [m]
  /// \param angle of the launch below the horizontal, −½π to ½π [rad]
  /// \throw std::invalid_argument for a depth or angle outside, Error for more than max_arcs.
  SoundPath(const SpeedProfile& profile, double depth, double angle,
            const SoundPathOptions& options = {});

  double duration() const { return nodes_.back().time; }  ///< [s]
  SoundPathEnd end() const { return end_; }

  /// Ends of the arcs: the launch, each crossing of a row of the profile, the end.
  const std::vector<SoundState>& nodes() const { return nodes_; }

  /// Gradient [1/s] of the arc from node i to i + 1.
  double gradient(std::size_t arc) const { return gradient_[arc]; }

  /// After a time, on the exact arc; times beyond the ends give the ends.
  SoundState at(double time) const;

  /// Where the path is at a horizontal distance (it never turns back in the horizontal); beyond its
  /// ends, and for a vertical path, the ends.
  SoundState at_distance(double distance) const;

  /// Points of the path, its nodes among them, so close that the straight chord between neighbours
  /// is nowhere farther from the arc than the tolerance [m]. Each has its exact time.
  std::vector<SoundState> chords(double tolerance) const;

 private:
  void arc_to(SoundState to, double gradient);

  std::vector<SoundState> nodes_;
  std::vector<double> gradient_;
  SoundPathEnd end_ = SoundPathEnd::kTime;
};

/// A way of sound between two points.
struct Eigenray {
  double launch = 0.0;   ///< angle below the horizontal at the first point [rad]
  double arrival = 0.0;  ///< angle at the second [rad]
  double time = 0.0;     ///< [s]
};

struct EigenrayOptions {
  int angles = 2000;      ///< of the fan that is searched, 10 to 10⁶
  double steepest = 1.5;  ///< of the fan [rad]; the straight line to the point is always within it
  bool surface_reflects = false;

  void check() const;
};

/// All ways from a depth to another at a horizontal distance, by a fan of launch angles and
/// bisection between those that pass the point on different sides; the quickest first. Empty in a
/// shadow. Two ways closer than the fan's spacing may be missed. \param distance 0 or more [m]
/// \throw std::invalid_argument
std::vector<Eigenray> eigenrays(const SpeedProfile& profile, double from_depth, double to_depth,
                                double distance, const EigenrayOptions& options = {});

}  // namespace bathyal
