// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/toolpath/internal/flags.hpp"

#include <algorithm>
#include <cmath>

#include "bathyal/base/parallel.hpp"
#include "bathyal/toolpath/internal/polygon.hpp"
#include "bathyal/toolpath/internal/route.hpp"

namespace bathyal::toolpath {
namespace {

/// Whether the insides of two segments cross.
bool cross(const PlanPoint& a, const PlanPoint& b, const PlanPoint& c, const PlanPoint& d) {
  const double ac = cross2(b - a, c - a), ad = cross2(b - a, d - a);
  const double ca = cross2(d - c, a - c), cb = cross2(d - c, b - c);
  return ((ac > 0.0 && ad < 0.0) || (ac < 0.0 && ad > 0.0)) &&
         ((ca > 0.0 && cb < 0.0) || (ca < 0.0 && cb > 0.0));
}

/// Where the tool's point moves against the travel of the bottom's point beneath it.
void flag_turning_back(ToolPath& path) {
  for (std::size_t j = 0; j + 1 < path.size(); ++j) {
    if (path.gap[j]) continue;
    const Vec3 moved = path.position[j + 1] - path.position[j];
    const Vec3 below = path.surface[j + 1] - path.surface[j];
    // At an edge of the piecewise-constant form the bottom's point rests: use the travel.
    const Vec3 ahead = below.isZero() ? Vec3(path.travel[j] + path.travel[j + 1]) : below;
    if (moved.dot(ahead) < -1e-12 * ahead.norm()) path.crossing[j] = path.crossing[j + 1] = true;
  }
}

/// Loops among samples [begin, end), which share one upright plane.
void flag_loops(ToolPath& path, std::size_t begin, std::size_t end, const Vec3& up, double reach) {
  Vec3 ahead = path.surface[end - 1] - path.surface[begin];
  ahead -= ahead.dot(up) * up;
  if (ahead.norm() <= kCoincident) ahead = path.travel[begin] - path.travel[begin].dot(up) * up;
  if (ahead.norm() <= kCoincident) return;
  ahead.normalize();
  const Vec3 origin = path.position[begin];
  std::vector<PlanPoint> flat;
  std::vector<double> along{0.0};  // arc length of the bottom's points
  for (std::size_t j = begin; j < end; ++j) {
    const Vec3 p = path.position[j] - origin;
    flat.emplace_back(ahead.dot(p), up.dot(p));
    if (j > begin) along.push_back(along.back() + (path.surface[j] - path.surface[j - 1]).norm());
  }
  for (std::size_t j = 0; j + 1 < flat.size(); ++j) {
    const double low = std::min(flat[j].x(), flat[j + 1].x());
    const double high = std::max(flat[j].x(), flat[j + 1].x());
    for (std::size_t k = j + 2; k + 1 < flat.size() && along[k] - along[j + 1] <= reach; ++k) {
      if (std::min(flat[k].x(), flat[k + 1].x()) > high) continue;
      if (std::max(flat[k].x(), flat[k + 1].x()) < low) continue;
      if (!cross(flat[j], flat[j + 1], flat[k], flat[k + 1])) continue;
      for (std::size_t i = j; i <= k + 1; ++i) path.crossing[begin + i] = true;
    }
  }
}

void flag_all_loops(ToolPath& path, const Vec3& up, double standoff) {
  for (std::size_t begin = 0; begin < path.size();) {
    std::size_t end = begin + 1;
    while (end < path.size() && !path.gap[end - 1] && path.segment[end] == path.segment[begin])
      ++end;
    flag_loops(path, begin, end, up, 10.0 * standoff);
    begin = end;
  }
}

bool meets_ground(const Scene& scene, const ToolBody& body, const Vec3& tip, const Vec3& back) {
  const double begin = std::min(body.tolerance, body.length);
  if (scene.cast(tip + begin * back, back).range <= body.length - begin) return true;
  const double clear = body.radius - body.tolerance;  // ground nearer to the axis than this is in
  if (!(clear > 0.0)) return false;
  const double last = std::max(body.radius, body.length - body.radius);
  const double shortest = 1e-3 * body.radius;  // where the balls would shrink to nothing
  for (double at = body.radius;;) {
    const double distance = scene.nearest(tip + at * back).distance;
    if (distance < clear) return true;
    if (at >= last) return false;
    // No ground lies within `distance` of here, so none within `clear` of the axis until then.
    at = std::min(last, at + std::max(distance - clear, shortest));
  }
}

}  // namespace

void flag_crossings(ToolPath& path, const Vec3& up, double standoff) {
  path.crossing.assign(path.size(), false);
  if (standoff == 0.0) return;
  flag_turning_back(path);
  flag_all_loops(path, up, standoff);
}

void flag_rolled_crossings(ToolPath& path, const Vec3& up, double standoff) {
  flag_all_loops(path, up, standoff);
}

void flag_contacts(ToolPath& path, const Surface& surface, const ToolBody& body, int num_threads) {
  path.contact.assign(path.size(), false);
  const Scene* scene = std::get_if<Scene>(&surface);
  if (scene == nullptr || body.length == 0.0) return;
  std::vector<char> contact(path.size(), 0);  // bits of vector<bool> share bytes between threads
  parallel_for(path.size(), 256, num_threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t j = begin; j < end; ++j) {
      contact[j] = meets_ground(*scene, body, path.position[j], path.approach[j]) ? 1 : 0;
    }
  });
  path.contact.assign(contact.begin(), contact.end());
}

}  // namespace bathyal::toolpath
