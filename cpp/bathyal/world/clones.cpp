// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/world/clones.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <unordered_map>

#include "bathyal/base/check.hpp"
#include "bathyal/base/random.hpp"

namespace bathyal {
namespace {

constexpr int kDraws = 1000;

struct Bounds {
  Vec3 low = Vec3::Constant(std::numeric_limits<double>::infinity());
  Vec3 high = -low;

  void add(const Vec3& p) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
};

Bounds bounds_of(const Scene& scene) {
  Bounds bounds;
  for (std::int32_t row = 0; row < scene.row_count(); ++row) {
    const Pose pose = scene.poses()[static_cast<std::size_t>(row)];
    const double scale = scene.scales()[static_cast<std::size_t>(row)];
    const PointView vertices = scene.meshes()[static_cast<std::size_t>(row)].vertices();
    for (Index i = 0; i < vertices.rows(); ++i) {
      bounds.add(pose * Vec3(scale * vertices.row(i).transpose()));
    }
  }
  return bounds;
}

Bounds bounds_of(const TriangleMesh& mesh) {
  Bounds bounds;
  for (Index i = 0; i < mesh.vertex_count(); ++i) bounds.add(mesh.vertices().row(i).transpose());
  return bounds;
}

/// What lies where, seen from above: cells as wide as things must be apart.
class Neighbours {
 public:
  explicit Neighbours(double apart) : apart_(apart) {}

  bool has_room(double x, double y) const {
    if (apart_ == 0.0) return true;
    for (std::int64_t i = -1; i <= 1; ++i) {
      for (std::int64_t j = -1; j <= 1; ++j) {
        const auto found = cells_.find(key(cell(x) + i, cell(y) + j));
        if (found == cells_.end()) continue;
        for (const Eigen::Vector2d& other : found->second) {
          if (std::hypot(other.x() - x, other.y() - y) < apart_) return false;
        }
      }
    }
    return true;
  }
  void add(double x, double y) {
    if (apart_ > 0.0) cells_[key(cell(x), cell(y))].emplace_back(x, y);
  }

 private:
  std::int64_t cell(double v) const { return static_cast<std::int64_t>(std::floor(v / apart_)); }
  static std::uint64_t key(std::int64_t i, std::int64_t j) {
    return static_cast<std::uint64_t>(i) << 32U ^ static_cast<std::uint64_t>(j & 0xffffffff);
  }

  double apart_;
  std::unordered_map<std::uint64_t, std::vector<Eigen::Vector2d>> cells_;
};

/// Turned, tilted and scaled; the origin is still in place.
ClonePlace shaped(const CloneOptions& options, RandomStream& random) {
  ClonePlace place;
  place.scale = random.uniform(options.scale[0], options.scale[1]);
  const double turn = random.uniform(0.0, 2.0 * std::numbers::pi);
  const double to = random.uniform(0.0, 2.0 * std::numbers::pi);
  const double tilt = random.uniform(0.0, options.tilt);
  place.world_from_object.linear() =
      (Eigen::AngleAxisd(tilt, Vec3(std::cos(to), std::sin(to), 0.0)) *
       Eigen::AngleAxisd(options.turned ? turn : 0.0, Vec3::UnitZ()))
          .toRotationMatrix();
  return place;
}

}  // namespace

void CloneOptions::check() const {
  check_positive("scale", scale[0]);
  check_range("scale", scale[1], scale[0], 1e6);
  check_range("tilt", tilt, 0.0, std::numbers::pi);
  check_range("sunk", sunk, 0.0, 1.0);
  check_not_negative("apart", apart);
  if (!region) return;
  const auto& [low_x, low_y, high_x, high_y] = *region;
  for (const double value : *region) check_finite("region", value);
  if (!(low_x < high_x && low_y < high_y)) {
    throw_argument("region", "low x, low y, high x, high y", "an empty one");
  }
}

std::vector<ClonePlace> clone_places(const TriangleMesh& mesh, std::int64_t count,
                                     const Scene& ground, const CloneOptions& options) {
  options.check();
  check_range("count", static_cast<double>(count), 0.0, 1e7);
  const Bounds around = bounds_of(ground);
  const Bounds own = bounds_of(mesh);
  if (mesh.vertex_count() == 0) throw_argument("mesh", "a mesh with vertices", "none");
  const std::array<double, 4> region = options.region.value_or(
      std::array<double, 4>{around.low.x(), around.low.y(), around.high.x(), around.high.y()});
  const double above = around.high.z() + 1.0;
  Neighbours neighbours(options.apart);
  std::vector<ClonePlace> places;
  for (std::int64_t i = 0; i < count; ++i) {
    RandomStream random(options.seed, static_cast<std::uint64_t>(i));
    ClonePlace place = shaped(options, random);
    int draw = 0;
    for (; draw < kDraws; ++draw) {
      const double x = random.uniform(region[0], region[2]);
      const double y = random.uniform(region[1], region[3]);
      if (!neighbours.has_room(x, y)) continue;
      const RayHit hit = ground.cast(Vec3(x, y, above), -Vec3::UnitZ());
      if (hit.mesh < 0) continue;
      const double height = place.scale * (own.high.z() - own.low.z());
      place.world_from_object.translation() =
          Vec3(x, y, above - hit.range - place.scale * own.low.z() - options.sunk * height);
      neighbours.add(x, y);
      break;
    }
    if (draw == kDraws) {
      throw_argument("count", "as many places as there is ground and room for",
                     std::to_string(count) + ", " + std::to_string(i) + " found");
    }
    places.push_back(place);
  }
  return places;
}

}  // namespace bathyal
