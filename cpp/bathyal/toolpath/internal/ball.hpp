// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "bathyal/scene/scene.hpp"

namespace bathyal::toolpath {

/// Where a ball comes closest to a triangle.
struct Touch {
  Vec3 point = Vec3::Zero();   ///< of the triangle
  Vec3 toward = Vec3::Zero();  ///< unit, from there to the ball's centre; zero where they are one
  double distance = 0.0;       ///< between them [m]
  std::int32_t mesh = -1;
  std::int32_t triangle = -1;
};

/// A ball of the standoff's radius among the triangles of a scene, which it may touch but not cut.
/// Rounding counts against it: the radius it rolls with is larger by the slack, a few units in the
/// last place of the scene's coordinates, so that a centre that is free is no nearer than `radius`.
class Ball {
 public:
  /// Keeps a reference to the scene. radius > 0.
  Ball(const Scene& scene, double radius);

  double radius() const { return radius_; }
  double slack() const { return slack_; }
  double rolling_radius() const { return radius_ + slack_; }

  /// The nearest triangle of the scene; mesh −1 where there is none.
  Touch nearest(const Vec3& centre) const;

  /// The nearest point of that triangle.
  Touch touch(std::int32_t mesh, std::int32_t triangle, const Vec3& centre) const;

  bool is_free(const Vec3& centre) const { return nearest(centre).distance >= radius_; }

  /// Whether every centre on the straight way is.
  bool is_free(const Vec3& from, const Vec3& to) const;

  /// The first free centre from `from` along the unit `direction`, none within `reach` [m].
  std::optional<Vec3> lift(const Vec3& from, const Vec3& direction, double reach) const;

  /// The centre nearest to `near` up along `direction` where the ball touches; looked for from as
  /// far back as two radii. `near` itself where the ball lies free even there; none where nothing
  /// is free within 30 radii.
  std::optional<Vec3> lay(const Vec3& near, const Vec3& direction) const;

 private:
  const Scene& scene_;
  double radius_;
  double slack_;
};

}  // namespace bathyal::toolpath
