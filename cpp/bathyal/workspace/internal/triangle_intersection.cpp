// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>

#include "bathyal/geometry/predicates.hpp"
#include "bathyal/workspace/internal/triangle_pairs.hpp"

namespace bathyal::workspace {
namespace {

using Corners = std::array<Point3, 3>;

Point3 point3(const Vec3& p) { return {p.x(), p.y(), p.z()}; }

Point2 without_axis(const Point3& p, int axis) {
  return axis == 0 ? Point2{p.y, p.z} : axis == 1 ? Point2{p.z, p.x} : Point2{p.x, p.y};
}

/// An axis along which the triangle has a shadow; −1 for one without area.
int shadow_axis(const Corners& t) {
  for (int axis = 0; axis < 3; ++axis) {
    if (orient2d(without_axis(t[0], axis), without_axis(t[1], axis), without_axis(t[2], axis)) != 0)
      return axis;
  }
  return -1;
}

bool boxes_meet(const Point2& p, const Point2& q, const Point2& a, const Point2& b) {
  return std::max(p.x, q.x) >= std::min(a.x, b.x) && std::max(a.x, b.x) >= std::min(p.x, q.x) &&
         std::max(p.y, q.y) >= std::min(a.y, b.y) && std::max(a.y, b.y) >= std::min(p.y, q.y);
}

/// Closed segments of the plane.
bool segments_meet(const Point2& p, const Point2& q, const Point2& a, const Point2& b) {
  return boxes_meet(p, q, a, b) && orient2d(p, q, a) * orient2d(p, q, b) <= 0 &&
         orient2d(a, b, p) * orient2d(a, b, q) <= 0;
}

/// A closed segment in the plane of a triangle with area.
bool meets_in_plane(const Point3& p, const Point3& q, const Corners& t) {
  const int axis = shadow_axis(t);
  const Point2 from = without_axis(p, axis), to = without_axis(q, axis);
  std::array<Point2, 3> corner;
  for (std::size_t c = 0; c < 3; ++c) corner[c] = without_axis(t[c], axis);
  bool left = true, right = true;
  for (std::size_t c = 0; c < 3; ++c) {
    const Point2 &a = corner[c], &b = corner[(c + 1) % 3];
    if (segments_meet(from, to, a, b)) return true;
    const int side = orient2d(a, b, from);
    left = left && side >= 0;
    right = right && side <= 0;
  }
  return left || right;  // inside of all three edges
}

/// Whether a closed segment meets a closed triangle with area.
bool meets(const Point3& p, const Point3& q, const Corners& t) {
  const int from = orient3d(t[0], t[1], t[2], p), to = orient3d(t[0], t[1], t[2], q);
  if (from == 0 && to == 0) return meets_in_plane(p, q, t);
  if (from * to > 0) return false;
  bool left = true, right = true;
  for (std::size_t c = 0; c < 3 && (left || right); ++c) {
    const int side = orient3d(p, q, t[c], t[(c + 1) % 3]);
    left = left && side >= 0;
    right = right && side <= 0;
  }
  return left || right;
}

/// All corners of `b` strictly on one side of `a`.
bool apart(const Corners& a, const Corners& b) {
  const int side = orient3d(a[0], a[1], a[2], b[0]);
  return side != 0 && orient3d(a[0], a[1], a[2], b[1]) == side &&
         orient3d(a[0], a[1], a[2], b[2]) == side;
}

/// No corner shared: what they have in common ends on an edge of one of them.
bool strangers_meet(const Corners& a, const Corners& b) {
  if (apart(a, b) || apart(b, a)) return false;
  for (std::size_t c = 0; c < 3; ++c) {
    if (meets(a[c], a[(c + 1) % 3], b) || meets(b[c], b[(c + 1) % 3], a)) return true;
  }
  return false;
}

/// An edge shared: they meet elsewhere only where one is folded flat onto the other.
bool folded(const Point3& from, const Point3& to, const Point3& a, const Point3& b) {
  if (orient3d(from, to, a, b) != 0) return false;
  const int axis = shadow_axis({from, to, a});
  const auto side = [&](const Point3& apex) {
    return orient2d(without_axis(from, axis), without_axis(to, axis), without_axis(apex, axis));
  };
  return side(a) == side(b);
}

}  // namespace

bool intersect(const WeldedMesh& mesh, std::size_t first, std::size_t second) {
  std::array<std::int32_t, 3> i = mesh.triangles[first], j = mesh.triangles[second];
  std::size_t shared = 0;  // moved to the front of both, in the same order
  for (std::size_t c = 0; c < 3; ++c) {
    const auto found = std::find(j.begin() + static_cast<std::ptrdiff_t>(shared), j.end(), i[c]);
    if (found == j.end()) continue;
    std::swap(*found, j[shared]);
    std::swap(i[c], i[shared]);
    ++shared;
  }
  Corners a, b;
  for (std::size_t c = 0; c < 3; ++c) {
    a[c] = point3(mesh.points[static_cast<std::size_t>(i[c])]);
    b[c] = point3(mesh.points[static_cast<std::size_t>(j[c])]);
  }
  if (shared == 0 && (apart(a, b) || apart(b, a))) return false;  // most pairs end here
  if (shadow_axis(a) < 0 || shadow_axis(b) < 0) return false;
  if (shared == 3) return true;
  if (shared == 2) return folded(a[0], a[1], a[2], b[2]);
  if (shared == 1) return meets(a[1], a[2], b) || meets(b[1], b[2], a);
  return strangers_meet(a, b);
}

}  // namespace bathyal::workspace
