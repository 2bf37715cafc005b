// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "bathyal/base/check.hpp"
#include "bathyal/workspace/arm_shape.hpp"

namespace bathyal {
namespace {

PointMatrix box_corners(const Vec3& size) {
  PointMatrix corners(8, 3);
  for (int corner = 0; corner < 8; ++corner) {
    for (int axis = 0; axis < 3; ++axis) {
      corners(corner, axis) = (((corner >> axis) & 1) != 0 ? 0.5 : -0.5) * size[axis];
    }
  }
  return corners;
}

/// In the shape's own frame; none of a mesh that cannot be read.
std::optional<Capsule> capsule_around(const Shape& shape, const MeshCorners& corners) {
  switch (shape.kind) {
    case ShapeKind::kSphere:
      return Capsule{Vec3::Zero(), Vec3::Zero(), shape.radius};
    case ShapeKind::kCylinder: {
      const Vec3 end(0.0, 0.0, 0.5 * shape.length);
      return Capsule{-end, end, shape.radius};
    }
    case ShapeKind::kBox:
      return fit_capsule(Points(box_corners(shape.size)).view());
    case ShapeKind::kMesh:
      break;
  }
  const std::optional<Points> points = corners(shape);
  if (!points || points->rows() == 0) return std::nullopt;
  return fit_capsule(points->view());
}

/// Shapes for collisions; those for the eye of parts that have none.
std::vector<Shape> outline_of(const Link& link) {
  std::vector<Shape> outline = link.collision;
  for (const Shape& shape : link.visual) {
    if (std::ranges::find(link.collision, shape.part, &Shape::part) == link.collision.end()) {
      outline.push_back(shape);
    }
  }
  return outline;
}

/// A rotation whose z is the direction.
Pose along(const Vec3& start, const Vec3& end) {
  Pose pose = Pose::Identity();
  pose.linear() = Eigen::Quaterniond::FromTwoVectors(Vec3::UnitZ(), end - start).toRotationMatrix();
  pose.translation() = 0.5 * (start + end);
  return pose;
}

/// Of a cylinder along z about the origin.
RigidBody solid_cylinder(double radius, double length, double density) {
  RigidBody body;
  body.volume = std::numbers::pi * radius * radius * length;
  body.mass = density * body.volume;
  const double across = body.mass * (3.0 * radius * radius + length * length) / 12.0;
  body.inertia.diagonal() = Vec3(across, across, 0.5 * body.mass * radius * radius);
  return body;
}

}  // namespace

ArmCapsules capsules_of_shapes(const Arm& arm, const MeshCorners& corners) {
  ArmCapsules found;
  std::vector<std::vector<Capsule>> shapes(arm.links().size());
  bool any = false;
  for (std::size_t link = 0; link < shapes.size(); ++link) {
    const Link& one = arm.links()[link];
    for (const Shape& shape : outline_of(one)) {
      any = true;
      const std::optional<Capsule> capsule = capsule_around(shape, corners);
      if (capsule) {
        shapes[link].push_back(in_frame(*capsule, shape.body_from_shape));
      } else {
        found.warnings.push_back("link " + link_name(arm, static_cast<int>(link)) + ": its mesh " +
                                 shape.file +
                                 " cannot be read; without it, the link may be thinner than it is");
      }
    }
  }
  if (!any) {
    found.warnings.push_back(
        "the arm has no shapes: its links are bare segments without thickness; give `radii`");
  }
  found.capsules = capsules_of_links(arm, shapes);
  for (const LinkCapsule& bare : capsules_of_rows(arm)) {
    if (shapes[static_cast<std::size_t>(bare.link)].empty()) found.capsules.push_back(bare);
  }
  return found;
}

Arm with_link_radii(const Arm& arm, std::span<const double> radii, std::optional<double> density) {
  if (density) check_positive("density", *density);
  std::vector<Link> links = arm.links();
  std::vector<RigidBody> bodies(links.size());
  for (const LinkCapsule& capsule : capsules_of_rows(arm, radii)) {
    if (capsule.start_link != capsule.link) continue;
    Link& link = links[static_cast<std::size_t>(capsule.link)];
    Shape shape;
    shape.kind = ShapeKind::kCylinder;
    shape.radius = capsule.radius;
    shape.length = (capsule.end - capsule.start).norm();
    shape.body_from_shape = along(capsule.start, capsule.end);
    if (density) {
      RigidBody& body = bodies[static_cast<std::size_t>(capsule.link)];
      body = combined(body, in_frame(solid_cylinder(shape.radius, shape.length, *density),
                                     shape.body_from_shape));
    }
    link.collision.push_back(std::move(shape));
  }
  for (std::size_t i = 0; i < links.size(); ++i) {
    if (links[i].body.mass == 0.0 && links[i].body.volume == 0.0) links[i].body = bodies[i];
  }
  Arm made(arm.name(), arm.joints(), std::move(links), arm.root(), arm.flange());
  made.set_source(arm.source());
  made.set_base(arm.base());
  made.set_tool(arm.tool());
  return made;
}

}  // namespace bathyal
