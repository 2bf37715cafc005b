// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/toolpath/toolpath.hpp"

#include <algorithm>
#include <map>

#include "bathyal/base/check.hpp"
#include "bathyal/base/parallel.hpp"
#include "bathyal/toolpath/internal/flags.hpp"
#include "bathyal/toolpath/internal/frames.hpp"
#include "bathyal/toolpath/internal/normals.hpp"
#include "bathyal/toolpath/internal/rolled_frames.hpp"
#include "bathyal/toolpath/internal/rolling.hpp"
#include "bathyal/toolpath/internal/timing.hpp"

namespace bathyal {
namespace {

using namespace toolpath;

/// "2 hole, 1 parallel"
std::string count_text(const Targets& targets) {
  std::map<TargetStatus, int> counts;
  for (const TargetStatus status : targets.status) ++counts[status];
  std::string text;
  for (const auto& [status, count] : counts) {
    text += (text.empty() ? "" : ", ") + std::to_string(count) + " " + std::string(to_text(status));
  }
  return text;
}

void check_found(const Targets& targets, MissedAims missed) {
  std::size_t found = 0, first_missed = targets.size();
  for (std::size_t i = targets.size(); i-- > 0;) {
    if (targets.found(i)) {
      ++found;
    } else {
      first_missed = i;
    }
  }
  if (found == 0) throw_argument("aims", "at least one that meets the bottom", count_text(targets));
  if (missed == MissedAims::kRefuse && found < targets.size()) {
    throw_argument("aims", "all to meet the bottom, as missed = \"refuse\" requires",
                   count_text(targets) + "; row " + std::to_string(first_missed) +
                       " is the first (" + std::string(to_text(targets.status[first_missed])) +
                       ")");
  }
}

/// A length so short that the path would not fit in memory is a slip of the unit.
void check_parts(std::string_view name, double length, const Route& route) {
  constexpr double kMostParts = 1e8;
  double total = 0.0;
  for (const Run& run : route.runs) {
    for (const Piece& piece : run.pieces) total += piece.length();
  }
  if (length > 0.0 && total / length > kMostParts) {
    throw_argument(name,
                   "0, or " + to_text(total / kMostParts) + " m or more for a path of " +
                       to_text(total) + " m",
                   to_text(length));
  }
}

void stand_off(ToolPath& path, double standoff) {
  if (standoff == 0.0) return;
  for (std::size_t j = 0; j < path.size(); ++j) path.position[j] += standoff * path.approach[j];
}

/// On a plane the plain offset is the ball's way already, and no ball is smaller than 10 µm.
bool is_rolled(const Surface& surface, const ToolPathOptions& options) {
  return std::holds_alternative<Scene>(surface) && options.standoff > 1e-5 &&
         options.offset == Offset::kRolling;
}

/// Says by how much the ball's centre is too near where it could not be raised far enough.
void warn_of_shortfall(ToolPath& path, const Scene& scene, double standoff, int num_threads) {
  std::vector<double> missing(path.size(), 0.0);
  parallel_for(path.size(), 256, num_threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t j = begin; j < end; ++j) {
      missing[j] = standoff - scene.nearest(path.position[j]).distance;
    }
  });
  const auto count = std::count_if(missing.begin(), missing.end(),
                                   [&](double m) { return m > 1e-9 * std::max(1.0, standoff); });
  if (count == 0) return;
  path.warnings.push_back("the path comes nearer to the bottom than the standoff at " +
                          std::to_string(count) + (count == 1 ? " sample" : " samples") +
                          ", by up to " +
                          to_text(*std::max_element(missing.begin(), missing.end())) + " m");
}

/// Positions at the standoff, the samples' own or those of a ball that rolls.
ToolPath sample_route(Route& route, const Surface& surface, const Targets& targets, const Vec3& up,
                      const ToolPathOptions& options) {
  const int threads = options.targets.num_threads;
  if (is_rolled(surface, options)) {
    const Scene& scene = std::get<Scene>(surface);
    const RolledRoute rolled = roll_along(route, scene, targets, up, options.standoff, threads);
    ToolPath path = sample_rolled(rolled, route, scene, options);
    path.warnings = std::move(route.warnings);
    path.warnings.insert(path.warnings.end(), rolled.warnings.begin(), rolled.warnings.end());
    warn_of_shortfall(path, scene, options.standoff, threads);
    return path;
  }
  estimate_normals(route, surface, options.normal_radius, threads);
  ToolPath path = options.orientation == Orientation::kBlended
                      ? sample_blended(route, options.blend_length, options.step)
                      : sample_piecewise_constant(route, options.step);
  path.warnings = std::move(route.warnings);
  stand_off(path, options.standoff);
  return path;
}

void warn_of_flags(ToolPath& path) {
  const auto warn = [&](const std::string& what, const std::vector<bool>& flags) {
    const auto count = std::count(flags.begin(), flags.end(), true);
    if (count == 0) return;
    path.warnings.push_back(what + " at " + std::to_string(count) +
                            (count == 1 ? " sample" : " samples"));
  };
  warn("the path at standoff turns back or crosses itself", path.crossing);
  warn("the tool's body meets ground", path.contact);
}

}  // namespace

void ToolPathOptions::check() const {
  targets.check();
  check_positive("blend_length", blend_length);
  check_positive("angular_rate", angular_rate);
  check_positive("speed", speed);
  check_positive("acceleration", acceleration);
  check_not_negative("standoff", standoff);
  check_not_negative("step", step);
  check_not_negative("normal_radius", normal_radius);
  check_not_negative("tool_radius", tool_radius);
  check_not_negative("tool_length", tool_length);
  check_not_negative("contact_tolerance", contact_tolerance);
  if (tool_length > 0.0 && tool_length < 2.0 * tool_radius) {
    throw_argument("tool_length", "0, or at least twice tool_radius (" + to_text(tool_radius) + ")",
                   to_text(tool_length));
  }
}

Pose ToolPath::frame(std::size_t j) const {
  Pose world_from_tool = Pose::Identity();
  world_from_tool.linear() << travel[j], -side[j], -approach[j];
  world_from_tool.translation() = position[j];
  return world_from_tool;
}

ToolPath plan_toolpath(const Surface& surface, const Aims& aims, const ToolPathOptions& options) {
  options.check();
  if (aims.rows() == 0) throw_argument("aims", "at least one row", "none");
  const Vec3 up = options.targets.reference.up();
  const int threads = options.targets.num_threads;

  Targets targets = find_targets(surface, aims, options.targets);
  check_found(targets, options.missed);
  Route route = join_targets(surface, targets, up, threads);
  check_parts("step", options.step, route);
  check_parts("normal_radius", options.normal_radius, route);
  ToolPath path = sample_route(route, surface, targets, up, options);
  path.targets = std::move(targets);
  set_times(path, {options.speed, options.acceleration, options.angular_rate});
  if (is_rolled(surface, options)) {
    flag_rolled_crossings(path, up, options.standoff);
  } else {
    flag_crossings(path, up, options.standoff);
  }
  flag_contacts(path, surface,
                {options.tool_radius, options.tool_length, options.contact_tolerance}, threads);
  warn_of_flags(path);
  return path;
}

}  // namespace bathyal
