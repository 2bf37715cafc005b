// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/workspace/reach/standpoint.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "bathyal/base/check.hpp"
#include "bathyal/base/parallel.hpp"
#include "bathyal/workspace/reach/internal/hull_room.hpp"
#include "bathyal/workspace/reach/internal/reach_depth.hpp"
#include "bathyal/workspace/reach/reach_map.hpp"

namespace bathyal {
namespace {

using workspace::HullRoom;
using workspace::ReachDepth;

constexpr double kTurn = 2.0 * std::numbers::pi;
constexpr double kHalfMargin = 0.1;   ///< depth of a margin of one half [m]
constexpr double kMostLookups = 3e8;  ///< of targets in the map, over all places looked at
constexpr double kApart = 0.2;        ///< alternatives differ by [m], or
constexpr double kApartTurned = 20.0 / 360.0 * kTurn;
constexpr int kKeptOfHeading = 64;
constexpr int kHalvings = 4;  ///< of the step while a place is refined

/// A level pose of the vehicle and how the reach map scores it.
struct Candidate {
  Vec3 position = Vec3::Zero();
  double heading = 0.0;  ///< about z, from the world's x [rad]
  double score = 0.0;

  Pose pose() const {
    return Eigen::Translation3d(position) * Eigen::AngleAxisd(heading, Vec3::UnitZ());
  }
};

bool better(const Candidate& a, const Candidate& b) {
  if (a.score != b.score) return a.score > b.score;
  const auto key = [](const Candidate& c) {
    return std::array{c.heading, c.position.x(), c.position.y(), c.position.z()};
  };
  return key(a) < key(b);
}

bool apart(const Pose& a, const Pose& b) {
  return (a.translation() - b.translation()).norm() >= kApart ||
         Eigen::AngleAxisd(a.linear().transpose() * b.linear()).angle() >= kApartTurned;
}

double margin_of(double depth) { return depth / (depth + kHalfMargin); }

/// Count and mean margin of the targets that `depth` has above 0.
template <class Depth>
double score_of(std::size_t count, const Depth& depth) {
  double reached = 0.0;
  double margins = 0.0;
  for (std::size_t i = 0; i < count; ++i) {
    const double d = depth(i);
    if (!(d > 0.0)) continue;
    reached += 1.0;
    margins += margin_of(d);
  }
  return reached == 0.0 ? 0.0 : reached + margins / reached;
}

class Search {
 public:
  Search(const ReachDepth& depth, std::vector<Vec3> targets, const StandpointOptions& options)
      : depth_(depth), targets_(std::move(targets)), options_(options) {
    const double cells = (depth_.high() - depth_.low()).array().max(options.voxel).prod();
    const double count = static_cast<double>(targets_.size());
    const double lookups = count * count * options.headings * cells / std::pow(options.step, 3);
    step_ = options.step * std::max(1.0, std::cbrt(lookups / kMostLookups));
  }

  /// Of all places of the vehicle from which the map reaches a target.
  Eigen::AlignedBox3d area() const {
    const Vec3 far = depth_.low().cwiseAbs().cwiseMax(depth_.high().cwiseAbs());
    const double across = far.head<2>().norm() + step_;
    Eigen::AlignedBox3d box;
    for (const Vec3& target : targets_) {
      box.extend(Vec3(target - Vec3(across, across, depth_.high().z() + step_)));
      box.extend(Vec3(target - Vec3(-across, -across, depth_.low().z() - step_)));
    }
    return box;
  }

  /// The best places of every heading, best first.
  std::vector<Candidate> scan(const HullRoom& room) const {
    std::vector<std::vector<Candidate>> of_heading(static_cast<std::size_t>(options_.headings));
    parallel_for(of_heading.size(), 1, options_.num_threads,
                 [&](std::size_t h, std::size_t /*end*/) {
                   of_heading[h] = scan(room, kTurn * static_cast<double>(h) / options_.headings);
                 });
    std::vector<Candidate> all;
    for (const auto& some : of_heading) all.insert(all.end(), some.begin(), some.end());
    std::ranges::sort(all, better);
    return all;
  }

  double score(const Candidate& c) const {
    const Pose vehicle_from_world = c.pose().inverse();
    return score_of(targets_.size(),
                    [&](std::size_t i) { return depth_.at(vehicle_from_world * targets_[i]); });
  }

  /// Uphill on the map, where the hull has room.
  Candidate refine(Candidate c, const HullRoom& room) const {
    double step = 0.5 * step_;
    double turn = 0.5 * kTurn / options_.headings;
    for (int halving = 0; halving < kHalvings; ++halving, step *= 0.5, turn *= 0.5) {
      for (int round = 0; round < 8; ++round) {
        Candidate best = c;
        for (int k = 0; k < 8; ++k) {
          Candidate next = c;
          const double sign = k % 2 == 0 ? 1.0 : -1.0;
          if (k < 6) next.position[k / 2] += sign * step;
          if (k >= 6) next.heading += sign * turn;
          next.score = score(next);
          if (next.score > best.score && room.seems_clear(next.pose()) && room.clear(next.pose())) {
            best = next;
          }
        }
        if (!(best.score > c.score)) break;
        c = best;
      }
    }
    return c;
  }

 private:
  std::vector<Candidate> scan(const HullRoom& room, double heading) const {
    const Eigen::AngleAxisd vehicle_from_world(-heading, Vec3::UnitZ());
    std::vector<Vec3> turned;
    for (const Vec3& target : targets_) turned.push_back(vehicle_from_world * target);
    std::vector<Candidate> found;
    for (const std::array<std::int64_t, 3>& cell : lattice(turned)) {
      const Vec3 place = step_ * Vec3(static_cast<double>(cell[0]), static_cast<double>(cell[1]),
                                      static_cast<double>(cell[2]));
      const double score = score_of(turned.size(), [&](std::size_t i) {
        return static_cast<double>(depth_.of_voxel(turned[i] - place));
      });
      if (score > 0.0) found.push_back({vehicle_from_world.inverse() * place, heading, score});
    }
    std::ranges::sort(found, better);
    std::vector<Candidate> kept;
    for (const Candidate& one : found) {
      if (kept.size() == kKeptOfHeading) break;
      const auto near = [&](const Candidate& k) {
        return (k.position - one.position).norm() < 1.5 * step_;
      };
      if (std::ranges::none_of(kept, near) && room.seems_clear(one.pose())) kept.push_back(one);
    }
    return kept;
  }

  /// Points of the lattice from which some target lies in the map's box.
  std::vector<std::array<std::int64_t, 3>> lattice(const std::vector<Vec3>& turned) const {
    std::vector<std::array<std::int64_t, 3>> cells;
    for (const Vec3& target : turned) {
      const Eigen::Array3d low = ((target - depth_.high()) / step_).array().ceil();
      const Eigen::Array3d high = ((target - depth_.low()) / step_).array().floor();
      for (double x = low[0]; x <= high[0]; ++x) {
        for (double y = low[1]; y <= high[1]; ++y) {
          for (double z = low[2]; z <= high[2]; ++z) {
            cells.push_back({static_cast<std::int64_t>(x), static_cast<std::int64_t>(y),
                             static_cast<std::int64_t>(z)});
          }
        }
      }
    }
    std::ranges::sort(cells);
    cells.erase(std::unique(cells.begin(), cells.end()), cells.end());
    return cells;
  }

  const ReachDepth& depth_;
  std::vector<Vec3> targets_;
  const StandpointOptions& options_;
  double step_;
};

/// The best of the candidates with room for the hull, apart from each other, moved uphill.
std::vector<Candidate> refined(const Search& search, const HullRoom& room,
                               const std::vector<Candidate>& candidates,
                               const StandpointOptions& options) {
  std::vector<Candidate> chosen;
  // Asked for in turn, by blocks whose exact checks run on all threads.
  const std::size_t block = 64;
  const auto most = static_cast<std::size_t>(options.refined);
  for (std::size_t first = 0; first < candidates.size() && chosen.size() < most; first += block) {
    const std::size_t count = std::min(block, candidates.size() - first);
    std::vector<std::uint8_t> clear(count, 0);
    parallel_for(count, 1, options.num_threads, [&](std::size_t i, std::size_t /*end*/) {
      clear[i] = room.clear(candidates[first + i].pose()) ? 1 : 0;
    });
    for (std::size_t i = 0; i < count && chosen.size() < most; ++i) {
      const Candidate& one = candidates[first + i];
      const auto is_apart = [&](const Candidate& c) { return apart(c.pose(), one.pose()); };
      if (clear[i] != 0 && std::ranges::all_of(chosen, is_apart)) chosen.push_back(one);
    }
  }
  parallel_for(chosen.size(), 1, options.num_threads, [&](std::size_t i, std::size_t /*end*/) {
    chosen[i].score = search.score(chosen[i]);
    chosen[i] = search.refine(chosen[i], room);
  });
  std::ranges::sort(chosen, better);
  return chosen;
}

/// What check_target says decides.
StandpointPlace place_of(const Workspace& ws, const ReachDepth& depth, const Pose& pose,
                         PointView targets, const StandpointOptions& options) {
  const Workspace there = ws.with_vehicle_pose(pose);
  const std::vector<TargetCheck> checks =
      there.check_target(targets, 0.0, options.seed, options.num_threads);
  StandpointPlace place{pose, 0.0, {}};
  double margins = 0.0;
  double count = 0.0;
  const Pose vehicle_from_world = pose.inverse();
  for (std::size_t i = 0; i < checks.size(); ++i) {
    const bool free = checks[i].status == TargetIndicator::kFree;
    place.reached.push_back(free ? 1 : 0);
    if (!free) continue;
    count += 1.0;
    const Vec3 target = targets.row(static_cast<Index>(i)).transpose();
    margins += margin_of(std::max(depth.at(vehicle_from_world * target), 1e-6));
  }
  if (count > 0.0) place.score = count + margins / count;
  return place;
}

/// Surroundings of the reach map: what moves with the vehicle.
Surroundings carried(const Surroundings& surroundings) {
  Surroundings own = surroundings;
  own.world_from_vehicle = Pose(Pose::Identity());
  own.vehicle_pose_std.setZero();
  own.scene.reset();
  std::erase_if(own.keepouts, [](const KeepOut& keepout) { return keepout.frame() == "world"; });
  return own;
}

Standpoint none(StandpointStatus status, std::string reason) {
  return {status, std::move(reason), {}};
}

std::string text_of_count(std::size_t count, std::size_t all) {
  return std::to_string(count) + " of " + std::to_string(all) + (all == 1 ? " target" : " targets");
}

}  // namespace

std::string_view to_text(StandpointStatus status) {
  switch (status) {
    case StandpointStatus::kAll:
      return "all";
    case StandpointStatus::kSome:
      return "some";
    case StandpointStatus::kNoReach:
      return "no_reach";
    case StandpointStatus::kNoRoom:
      return "no_room";
    case StandpointStatus::kBlocked:
      return "blocked";
  }
  return "";
}

void StandpointOptions::check() const {
  check_positive("voxel", voxel);
  check_positive("step", step);
  check_not_negative("hull_clearance", hull_clearance);
  check_range("headings", headings, 1, 360);
  check_range("refined", refined, 1, 1000);
  check_not_negative("alternatives", alternatives);
  resolve_threads(num_threads);
}

Standpoint best_standpoint(const Arm& arm, const Surroundings& surroundings, PointView targets,
                           const StandpointOptions& options) {
  options.check();
  std::vector<Vec3> points;
  for (Index i = 0; i < targets.rows(); ++i) {
    points.emplace_back(targets.row(i).transpose());
    if (!points.back().allFinite()) {
      throw_argument("targets", "finite numbers", "others in row " + std::to_string(i));
    }
  }
  if (points.empty()) throw_argument("targets", "one point or more", "none");

  Surroundings around = surroundings;
  around.world_from_vehicle = Pose(Pose::Identity());
  const Workspace ws(arm, around);
  const ReachMap map =
      reach_map(Workspace(arm, carried(surroundings)), {.voxel = options.voxel,
                                                        .directions = 6,
                                                        .seed = options.seed,
                                                        .num_threads = options.num_threads});
  const ReachDepth depth(map, options.num_threads);
  if (depth.empty()) {
    return none(StandpointStatus::kNoReach,
                "the arm touches its own hull, keep-outs or itself in every posture found");
  }

  const Search search(depth, points, options);
  const HullRoom room(around, options.hull_clearance, search.area(), options.num_threads);
  const std::vector<Candidate> chosen = refined(search, room, search.scan(room), options);
  if (chosen.empty()) {
    return none(StandpointStatus::kNoRoom,
                "wherever the arm would reach a target, the hull comes nearer than " +
                    to_text(options.hull_clearance) + " m to the bottom or to a keep-out");
  }

  std::vector<StandpointPlace> places;
  for (const Candidate& one : chosen) {
    places.push_back(place_of(ws, depth, one.pose(), targets, options));
  }
  std::ranges::stable_sort(places, std::greater{}, &StandpointPlace::score);
  Standpoint result;
  for (StandpointPlace& place : places) {
    if (std::cmp_greater(result.places.size(), options.alternatives)) break;
    const auto is_apart = [&](const StandpointPlace& p) {
      return apart(p.world_from_vehicle, place.world_from_vehicle);
    };
    if (place.score > 0.0 && std::ranges::all_of(result.places, is_apart)) {
      result.places.push_back(std::move(place));
    }
  }
  if (result.places.empty()) {
    return none(StandpointStatus::kBlocked, "no target is free from any of the " +
                                                std::to_string(chosen.size()) +
                                                " places that were checked: the arm touches "
                                                "something, or the targets lie in the ground or "
                                                "in a keep-out");
  }
  const auto reached =
      static_cast<std::size_t>(std::ranges::count(result.places.front().reached, 1));
  result.status = reached == points.size() ? StandpointStatus::kAll : StandpointStatus::kSome;
  result.reason = text_of_count(reached, points.size()) + " reached";
  return result;
}

}  // namespace bathyal
