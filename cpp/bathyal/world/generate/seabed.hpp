// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "bathyal/geometry/triangle_mesh.hpp"

namespace bathyal {

using Vec2 = Eigen::Vector2d;

/// A bottom that is known exactly, at any place of an endless plane. Angles are counted from x
/// towards y.
struct SeabedOptions {
  std::uint64_t seed = 0;  ///< the same seed and options give the same bytes

  double depth = 0.0;            ///< mean height is −depth [m]
  double slope = 0.0;            ///< of the whole bottom [rad], 0 or more, below 1.4
  double slope_direction = 0.0;  ///< in which it rises [rad]; at the origin it is at −depth

  // Fractal relief: isotropic, of power spectral density ∝ k^−exponent between two wavelengths.
  double relief_rms = 0.15;  ///< rms [m], 0 for none
  double relief_exponent =
      3.25;                      ///< of the spectrum over the plane (one less along a line), 1 to 6
  double relief_longest = 50.0;  ///< longest wavelength [m]
  double relief_shortest = 0.5;  ///< shortest [m], above 0

  // Sand ripples.
  double ripple_height = 0.0;      ///< trough to crest [m], 0 for none
  double ripple_wavelength = 1.0;  ///< crest to crest [m], above 0
  double ripple_direction = 0.0;   ///< of the current, across the crests [rad]
  double ripple_asymmetry = 0.2;   ///< (stoss − lee) / wavelength of their lengths, 0 to 0.45
  double ripple_meander = 0.15;    ///< rms of the crests' wandering, in wavelengths, 0 to 2
  double ripple_defects = 0.2;     ///< crests that fork, pairs per 36 square wavelengths, 0 to 1
  double ripple_cover = 1.0;       ///< share of the bottom that is rippled, 0 to 1
  double ripple_patch = 30.0;      ///< size of rippled patches, where they do not cover it all [m]

  // Boulders: solid domes, few of them large.
  double boulder_density = 0.0;  ///< per m², 0 for none
  double boulder_radius = 0.6;   ///< of the largest [m], above 0; the smallest have a fifth of it
  double boulder_scour = 0.18;   ///< depth of the hollow around each, over its height, 0 to 1

  // A trench along a line through a point.
  double trench_depth = 0.0;      ///< [m], 0 for none
  double trench_width = 4.0;      ///< between the tops of its walls [m], above 0
  double trench_floor = 1.5;      ///< width of its floor [m], 0 or more, below trench_width
  double trench_direction = 0.0;  ///< along it [rad]
  Vec2 trench_point{0.0, 0.0};    ///< on its middle line [m]

  // A cliff along a line through a point.
  double cliff_height = 0.0;     ///< [m], 0 for none
  double cliff_run = 2.0;        ///< horizontal distance over which it falls [m], above 0
  double cliff_direction = 0.0;  ///< in which it falls [rad]
  Vec2 cliff_point{0.0, 0.0};    ///< at half its height [m]

  double edge_meander = 0.0;  ///< rms by which trench and cliff wander off their lines [m]

  // Scour: a hollow around each given point.
  std::vector<Vec2> scour_points;  ///< [m]
  double scour_depth = 0.4;        ///< at the middle [m], 0 or more
  double scour_radius = 2.0;       ///< [m], above 0

  int num_threads = 0;  ///< 0: all

  /// \throw std::invalid_argument that names the option.
  void check() const;
};

/// Of what the bottom is at a place, and the names.
enum class SeabedMaterial : std::int16_t { kSilt = 0, kSand = 1, kRock = 2 };
inline constexpr std::array<const char*, 3> kSeabedMaterials{"silt", "sand", "rock"};

/// The bottom of these options as a function of the place: no height depends on how a mesh of it is
/// cut or where it begins. Immutable and cheap to copy.
class SeabedModel {
 public:
  /// \throw std::invalid_argument as SeabedOptions::check.
  explicit SeabedModel(const SeabedOptions& options = {});

  const SeabedOptions& options() const;

  /// Height z [m] at each place [m]; the same bytes as a mesh's vertex there.
  /// \throw std::invalid_argument for places that are not finite or not as many x as y, or further
  /// out than 10⁷ m.
  Values height(const Values& x, const Values& y) const;

  /// Boulders and the face of the cliff are rock; where the ripples have at least half their height
  /// there is sand; all else is silt.
  std::vector<std::int16_t> material(const Values& x, const Values& y) const;

  /// A mesh of `size` [m] whose middle is at `origin`, of squares of `spacing` [m]: the largest
  /// that divides the side and is no larger than `spacing`. A vertex attribute "material" has what
  /// material() gives. Vertices go along x first; triangles are counter-clockwise from above. Where
  /// the corner of the mesh is a whole number of half squares from zero, x and y are these numbers
  /// times the square: such tiles share the bytes of their borders, and those of the whole.
  /// \throw std::invalid_argument for a size or spacing that is not above 0, for more than 5·10⁷
  /// squares, and for ripples shorter than two spacings, which would show a wavelength that is not
  /// theirs.
  TriangleMesh mesh(const Vec2& size, double spacing, const Vec2& origin = Vec2::Zero()) const;

  struct Parts;  ///< lives in internal/seabed_parts.hpp

 private:
  std::shared_ptr<const Parts> parts_;
};

/// SeabedModel(options).mesh(size, spacing, origin)
TriangleMesh make_seabed(const Vec2& size, double spacing, const SeabedOptions& options = {},
                         const Vec2& origin = Vec2::Zero());

/// What each triangle lies on, from the attribute "material" of the vertices: the middle of its
/// three corners' values. World paints by it. \throw std::invalid_argument for a mesh without that
/// attribute.
std::vector<std::int16_t> triangle_material(const TriangleMesh& mesh);

}  // namespace bathyal
