// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/world/generate/internal/laying.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "bathyal/base/error.hpp"

namespace bathyal::generate {
namespace {

constexpr double kAbove = 20000.0;  // [m]: where rays start, above every sea's floor
constexpr std::array kAcross{0.0, 0.45, -0.45, 0.85, -0.85};  // of the radius

}  // namespace

std::vector<double> heights_below(const Scene& terrain, const std::vector<Vec3>& places,
                                  int num_threads) {
  PointMatrix from(static_cast<Index>(places.size()), 3);
  PointMatrix down(static_cast<Index>(places.size()), 3);
  for (Index i = 0; i < from.rows(); ++i) {
    const Vec3& place = places[static_cast<std::size_t>(i)];
    from.row(i) << place.x(), place.y(), kAbove;
    down.row(i) << 0.0, 0.0, -1.0;
  }
  const PointView starts(from.data(), from.rows(), 3);
  const PointView directions(down.data(), down.rows(), 3);
  std::vector<double> heights;
  for (const RayHit& hit : terrain.cast(starts, directions, num_threads)) {
    heights.push_back(hit.mesh < 0 ? std::numeric_limits<double>::quiet_NaN() : kAbove - hit.range);
  }
  return heights;
}

Contact touch_terrain(const Scene& terrain, const std::vector<Vec3>& places,
                      const std::vector<double>& radius, int num_threads) {
  std::vector<Vec3> asked;
  for (std::size_t i = 0; i < places.size(); ++i) {
    const Vec3 ahead = places[std::min(i + 1, places.size() - 1)] - places[i > 0 ? i - 1 : 0];
    const Vec3 across = Vec3(-ahead.y(), ahead.x(), 0.0).normalized();
    for (const double off : kAcross) asked.emplace_back(places[i] + off * radius[i] * across);
  }
  const std::vector<double> heights = heights_below(terrain, asked, num_threads);
  Contact contact;
  for (std::size_t i = 0; i < places.size(); ++i) {
    const double* height = heights.data() + i * kAcross.size();
    if (std::isnan(height[0])) {
      throw_argument("route", "terrain below all of it",
                     "none at (" + to_text(places[i].x()) + ", " + to_text(places[i].y()) + ")");
    }
    double rest = -std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < kAcross.size(); ++k) {
      if (std::isnan(height[k])) continue;
      rest = std::max(rest, height[k] + radius[i] * std::sqrt(1.0 - kAcross[k] * kAcross[k]));
    }
    contact.bottom.push_back(height[0]);
    contact.rest.push_back(rest);
  }
  return contact;
}

std::vector<double> hang(const std::vector<double>& along, const std::vector<double>& rest,
                         double sag) {
  const double middle = 0.5 * (along.front() + along.back());
  const auto parabola = [&](std::size_t i) {
    return 0.5 * (along[i] - middle) * (along[i] - middle) / sag;
  };
  std::vector<double> bent;
  for (std::size_t i = 0; i < rest.size(); ++i) bent.push_back(rest[i] - parabola(i));
  std::vector<std::size_t> hull;
  for (std::size_t i = 0; i < rest.size(); ++i) {
    while (hull.size() > 1) {
      const std::size_t a = hull[hull.size() - 2];
      const std::size_t b = hull.back();
      const double below = (bent[i] - bent[a]) * (along[b] - along[a]);
      if ((bent[b] - bent[a]) * (along[i] - along[a]) > below) break;
      hull.pop_back();
    }
    hull.push_back(i);
  }
  std::vector<double> line = rest;
  for (std::size_t h = 0; h + 1 < hull.size(); ++h) {
    const std::size_t a = hull[h];
    const std::size_t b = hull[h + 1];
    for (std::size_t i = a + 1; i < b; ++i) {
      const double share = (along[i] - along[a]) / (along[b] - along[a]);
      line[i] = (1.0 - share) * bent[a] + share * bent[b] + parabola(i);
    }
  }
  return line;
}

}  // namespace bathyal::generate
