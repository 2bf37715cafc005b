// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/world/generate/fish_paths.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>

#include "bathyal/base/check.hpp"
#include "bathyal/base/parallel.hpp"
#include "bathyal/base/random.hpp"
#include "bathyal/world/generate/internal/laying.hpp"

namespace bathyal {
namespace {

constexpr int kCourses = 24;  // drawn for a fish before giving up
constexpr int kRaises = 12;   // of a path that comes too near
constexpr double kSag = 3.0;  // radius to which paths bend up from a hollow [m]

/// Random, smooth in time, mostly between −1 and 1.
class Whim {
 public:
  Whim(RandomStream& random, double shortest, double longest) {
    for (Part& part : parts_) {
      part = {2.0 * std::numbers::pi / random.uniform(shortest, longest),
              random.uniform(0.0, 2.0 * std::numbers::pi)};
    }
  }

  double at(double time) const {
    double sum = 0.0;
    for (const Part& part : parts_) sum += std::sin(part.rate * time + part.phase);
    return sum / 2.0;
  }

 private:
  struct Part {
    double rate, phase;
  };
  std::array<Part, 4> parts_;
};

struct Swim {
  const Scene& scene;
  const FishPathOptions& options;
  Vec2 low, high;
  std::vector<double> time;
};

/// Turns back towards the middle near the border: how hard, 0 to 1.
double near_border(const Swim& swim, const Vec3& at) {
  const double margin = 3.0 * swim.options.speed / swim.options.turn_rate;
  double nearest = std::numeric_limits<double>::infinity();
  for (Index k = 0; k < 2; ++k) {
    const double room = std::min(margin, 0.4 * (swim.high(k) - swim.low(k)));
    nearest = std::min({nearest, (at(k) - swim.low(k)) / room, (swim.high(k) - at(k)) / room});
  }
  return std::clamp(1.0 - nearest, 0.0, 1.0);
}

/// Places at each time, z still 0; empty where it left the region.
std::vector<Vec3> draw_course(const Swim& swim, RandomStream& random) {
  const Vec2 size = swim.high - swim.low;
  Vec3 at(swim.low.x() + size.x() * random.uniform(0.2, 0.8),
          swim.low.y() + size.y() * random.uniform(0.2, 0.8), 0.0);
  const Vec2 home = 0.5 * (swim.low + swim.high);
  double course = random.uniform(0.0, 2.0 * std::numbers::pi);
  const Whim whim(random, 6.0 / swim.options.turn_rate, 20.0 / swim.options.turn_rate);
  const int parts = std::max(1, static_cast<int>(std::ceil(swim.options.step * 8.0)));
  std::vector<Vec3> places{at};
  for (std::size_t i = 1; i < swim.time.size(); ++i) {
    const double step = (swim.time[i] - swim.time[i - 1]) / parts;
    for (int k = 0; k < parts; ++k) {
      const double back = std::atan2(home.y() - at.y(), home.x() - at.x());
      const double near = near_border(swim, at);
      const double rate =
          (1.0 - near) * whim.at(swim.time[i - 1] + k * step) +
          6.0 * near * std::sin(0.5 * std::remainder(back - course, 2.0 * std::numbers::pi));
      course += swim.options.turn_rate * rate * step;
      at += swim.options.speed * step * Vec3(std::cos(course), std::sin(course), 0.0);
    }
    if (((at.head<2>() - swim.low).array() < 0.0).any() ||
        ((swim.high - at.head<2>()).array() < 0.0).any()) {
      return {};
    }
    places.push_back(at);
  }
  return places;
}

/// Binomial smoothing over some two seconds each way.
void smooth_heights(const Swim& swim, std::vector<double>& z) {
  const int rounds =
      std::clamp(static_cast<int>(4.0 / (swim.options.step * swim.options.step)), 1, 400);
  for (int round = 0; round < rounds; ++round) {
    double before = z.front();
    for (std::size_t i = 0; i < z.size(); ++i) {
      const double here = z[i];
      z[i] = 0.25 * before + 0.5 * here + 0.25 * z[std::min(i + 1, z.size() - 1)];
      before = here;
    }
  }
}

/// Smooth heights nowhere below `need`, and `higher` above that by turns.
void set_heights(const Swim& swim, const std::vector<double>& need, const Whim& whim,
                 double altitude, std::vector<Vec3>& places) {
  std::vector<double> way;
  for (const double time : swim.time) way.push_back(time * swim.options.speed);
  std::vector<double> z = generate::hang(way, need, kSag);
  smooth_heights(swim, z);
  double raise = 0.0;
  for (std::size_t i = 0; i < z.size(); ++i) raise = std::max(raise, need[i] - z[i]);
  for (std::size_t i = 0; i < z.size(); ++i) {
    const double higher = altitude * (0.5 + 0.5 * std::sin(1.5 * whim.at(swim.time[i])));
    places[i].z() = z[i] + raise + higher;
  }
}

std::vector<double> lacking(const Swim& swim, const std::vector<Vec3>& places) {
  const auto count = static_cast<Index>(places.size()) - 1;
  const PointView from(places.front().data(), count, 3);
  const PointView to(places[1].data(), count, 3);
  NearestSegmentOptions options;
  options.within = swim.options.clearance;
  std::vector<double> lacks(places.size(), 0.0);
  const auto found = swim.scene.nearest_segments(from, to, options, 1);
  for (std::size_t i = 0; i < found.size(); ++i) {
    const double lack = swim.options.clearance - found[i].distance;
    if (!(lack > 0.0)) continue;
    for (const std::size_t row : {i, i + 1}) lacks[row] = std::max(lacks[row], lack);
  }
  return lacks;
}

/// Raises the path until it is clear everywhere; false where it cannot be.
bool clear_bottom(const Swim& swim, const Whim& whim, double altitude, std::vector<Vec3>& places) {
  std::vector<double> need = generate::heights_below(swim.scene, places, 1);
  double lowest = std::numeric_limits<double>::infinity();
  for (const double height : need) {
    if (!std::isnan(height)) lowest = std::min(lowest, height);
  }
  if (!std::isfinite(lowest)) return false;
  for (double& height : need) {
    height = (std::isnan(height) ? lowest : height) + 1.02 * swim.options.clearance;
  }
  for (int round = 0; round < kRaises; ++round) {
    set_heights(swim, need, whim, altitude, places);
    for (const Vec3& place : places) {
      if (!(place.z() < swim.options.ceiling)) return false;
    }
    const std::vector<double> lacks = lacking(swim, places);
    if (*std::max_element(lacks.begin(), lacks.end()) == 0.0) return true;
    for (std::size_t i = 0; i < need.size(); ++i) {
      if (lacks[i] > 0.0) need[i] += lacks[i] + 0.1 * swim.options.clearance;
    }
  }
  return false;
}

Trajectory along_places(const std::vector<double>& time, const std::vector<Vec3>& places) {
  std::vector<Pose> poses;
  for (std::size_t i = 0; i < places.size(); ++i) {
    const Vec3 ahead =
        (places[std::min(i + 1, places.size() - 1)] - places[i > 0 ? i - 1 : 0]).normalized();
    const Vec3 port = Vec3::UnitZ().cross(ahead).normalized();
    Pose pose = Pose::Identity();
    pose.linear() << ahead, port, ahead.cross(port);
    pose.translation() = places[i];
    poses.push_back(pose);
  }
  return {time, std::move(poses)};
}

Trajectory swim_path(const Swim& swim, std::size_t fish) {
  RandomStream random(swim.options.seed, 0xf150000 + fish);
  for (int i = 0; i < kCourses; ++i) {
    std::vector<Vec3> places = draw_course(swim, random);
    const double period = std::max(8.0, 8.0 * swim.options.altitude / swim.options.speed);
    const Whim whim(random, period, 5.0 * period);  // so that they climb gently
    // Lower from one attempt to the next: a ceiling may be near.
    const double altitude = swim.options.altitude * (1.0 - static_cast<double>(i) / kCourses);
    if (!places.empty() && clear_bottom(swim, whim, altitude, places)) {
      return along_places(swim.time, places);
    }
  }
  throw_argument("region", "room for fish to turn in, over terrain, between clearance and ceiling",
                 "none found for fish " + std::to_string(fish) + " in " + std::to_string(kCourses) +
                     " attempts");
}

std::array<Vec2, 2> box_of(const Scene& scene) {
  Eigen::AlignedBox2d box;
  for (const TriangleMesh& mesh : scene.meshes()) {
    for (Index i = 0; i < mesh.vertex_count(); ++i) {
      box.extend(Vec2(mesh.vertices()(i, 0), mesh.vertices()(i, 1)));
    }
  }
  if (box.isEmpty()) throw_argument("scene", "one with a terrain", "one without vertices");
  return {box.min(), box.max()};
}

}  // namespace

void FishPathOptions::check() const {
  if (region) {
    const Vec2 size = (*region)[1] - (*region)[0];
    if (!(size.minCoeff() > 0.0) || !(size.maxCoeff() <= 1e7)) {
      throw_argument("region", "a low and a high corner",
                     "sides of " + to_text(size.x()) + " and " + to_text(size.y()) + " m");
    }
    for (const Vec2& corner : *region) {
      for (const double value : corner) check_range("region", value, -1e7, 1e7);
    }
  }
  check_range("clearance", clearance, 1e-3, 1e4);
  check_range("altitude", altitude, 0.0, 1e4);
  if (std::isnan(ceiling)) throw_argument("ceiling", "a number", "nan");
  check_range("speed", speed, 1e-3, 100.0);
  check_range("turn_rate", turn_rate, 1e-3, 10.0);
  check_range("step", step, 1e-3, 1e3);
  resolve_threads(num_threads);
}

std::vector<Trajectory> fish_paths(const Scene& scene, int count, double duration,
                                   const FishPathOptions& options) {
  check_range("count", count, 0, 1000000);
  check_positive("duration", duration);
  options.check();
  const double steps = std::ceil(duration / options.step);
  if (!(steps * std::max(count, 1) <= 1e7)) {
    throw_argument("step", "no more than 10⁷ poses in all", to_text(options.step) + " s");
  }
  const std::array<Vec2, 2> box = options.region ? *options.region : box_of(scene);
  Swim swim{scene, options, box[0], box[1], {}};
  for (double i = 0.0; i <= steps; i += 1.0) swim.time.push_back(duration * (i / steps));
  std::vector<Trajectory> paths(static_cast<std::size_t>(count));
  parallel_for(paths.size(), 1, options.num_threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) paths[i] = swim_path(swim, i);
  });
  return paths;
}

}  // namespace bathyal
