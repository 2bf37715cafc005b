// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/workspace/motion/internal/path_search.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>

#include "bathyal/workspace/motion/internal/plan_goal.hpp"

namespace bathyal::workspace {
namespace {

constexpr std::uint64_t kSearchStream = 1000;
constexpr double kMostStep = 4.0;  // [rad] of a straight motion, all coordinates together
// A motion that meets something is kept halfway to the contact, where that is as far as this:
// postures near to contacts lead nowhere. Tried on 230 worlds (benchmarks/python/plan.py).
constexpr double kBackOff = 0.5;
constexpr double kLeastStep = 1.0;  // [rad]

/// Coordinates in which a length means as much for each: sliding ones in arm's lengths per half
/// turn.
JointRow scales(const Arm& arm) {
  JointRow scale = JointRow::Ones(arm.size());
  for (const Joint& joint : arm.joints()) {
    if (joint.coordinate < 0 || joint.type != JointType::kPrismatic) continue;
    scale[joint.coordinate] = std::numbers::pi / std::max(1e-3, chain_length(arm));
  }
  return scale;
}

struct Tree {
  std::vector<JointRow> q;
  std::vector<int> parent;

  int add(JointRow posture, int from) {
    q.push_back(std::move(posture));
    parent.push_back(from);
    return static_cast<int>(q.size()) - 1;
  }

  int nearest(const JointRow& to, const JointRow& scale) const {
    int best = 0;
    double least_square = INFINITY;
    for (std::size_t i = 0; i < q.size(); ++i) {
      const double square = (q[i] - to).cwiseProduct(scale).squaredNorm();
      if (square < least_square) {
        least_square = square;
        best = static_cast<int>(i);
      }
    }
    return best;
  }

  /// From a node to its root.
  Postures branch(int node) const {
    Postures rows;
    for (; node >= 0; node = parent[static_cast<std::size_t>(node)]) {
      rows.push_back(q[static_cast<std::size_t>(node)]);
    }
    return rows;
  }
};

class Search {
 public:
  Search(PlanCheck& check, const JointRow& start, const Postures& goals, int attempt)
      : check_(&check),
        scale_(scales(check.arm())),
        random_(check.options().seed, kSearchStream + static_cast<std::uint64_t>(attempt)) {
    trees_[0].add(start, -1);
    for (const JointRow& goal : goals) trees_[1].add(goal, -1);
  }

  Postures run() {
    for (int side = 0; !check_->spent(); side = 1 - side) {
      Tree& own = trees_[side];
      Tree& other = trees_[1 - side];
      const std::size_t root = random_.next() % 2;  // half a turn around start or goal
      const JointRow middle = trees_[root].q.front();
      const JointRow sample = drawn_posture(check_->arm(), middle, random_);
      const auto grown = extend(own, own.nearest(sample, scale_), sample);
      if (!grown) continue;
      const JointRow aim = own.q[static_cast<std::size_t>(grown->node)];
      if (const int meets = connect(other, aim); meets >= 0) {
        return side == 0 ? joined(grown->node, meets) : joined(meets, grown->node);
      }
    }
    return {};
  }

 private:
  struct Grown {
    int node;
    bool arrived;
  };

  /// One straight motion towards a posture, as far as it is free.
  std::optional<Grown> extend(Tree& tree, int from, const JointRow& to) {
    const JointRow base = tree.q[static_cast<std::size_t>(from)];
    const double length = (to - base).cwiseProduct(scale_).norm();
    const bool whole = length <= kMostStep;
    const JointRow end = whole ? to : JointRow(base + kMostStep / length * (to - base));
    const double share = check_->free_share(base, end);
    if (share >= 1.0) return Grown{tree.add(end, from), whole};
    const double part = kBackOff * share;
    if (part * std::min(length, kMostStep) < kLeastStep) return std::nullopt;
    return Grown{tree.add(base + part * (end - base), from), false};
  }

  /// The node of the tree at `to`, or -1.
  int connect(Tree& tree, const JointRow& to) {
    int from = tree.nearest(to, scale_);
    while (!check_->spent()) {
      const JointRow base = tree.q[static_cast<std::size_t>(from)];
      const double before = (to - base).cwiseProduct(scale_).norm();
      const auto grown = extend(tree, from, to);
      if (!grown) return -1;
      if (grown->arrived) return grown->node;
      const JointRow& at = tree.q[static_cast<std::size_t>(grown->node)];
      // A motion that met something goes no further in this direction.
      if ((to - at).cwiseProduct(scale_).norm() > before - 0.999 * kMostStep) return -1;
      from = grown->node;
    }
    return -1;
  }

  Postures joined(int start_node, int goal_node) const {
    Postures path = trees_[0].branch(start_node);
    std::ranges::reverse(path);
    const Postures rest = trees_[1].branch(goal_node);
    path.insert(path.end(), rest.begin() + 1, rest.end());  // both have the node where they meet
    return path;
  }

  PlanCheck* check_;
  JointRow scale_;
  RandomStream random_;
  Tree trees_[2];
};

/// Leg and point at a way from the start of a path.
std::pair<std::size_t, JointRow> point_along(const Postures& path, const JointRow& scale,
                                             double way) {
  for (std::size_t i = 0; i + 1 < path.size(); ++i) {
    const double length = (path[i + 1] - path[i]).cwiseProduct(scale).norm();
    if (way <= length || i + 2 == path.size()) {
      const double share = length > 0.0 ? std::min(1.0, way / length) : 0.0;
      return {i, path[i] + share * (path[i + 1] - path[i])};
    }
    way -= length;
  }
  return {0, path.front()};
}

double length_of(const Postures& path, const JointRow& scale) {
  double length = 0.0;
  for (std::size_t i = 0; i + 1 < path.size(); ++i) {
    length += (path[i + 1] - path[i]).cwiseProduct(scale).norm();
  }
  return length;
}

/// Each row is joined to the last one that it sees.
Postures without_detours(PlanCheck& check, const Postures& path) {
  Postures kept{path.front()};
  for (std::size_t i = 0; i + 1 < path.size();) {
    std::size_t next = path.size() - 1;
    while (next > i + 1 && !check.spent() && check.free_share(path[i], path[next]) < 1.0) --next;
    if (check.spent()) next = i + 1;
    kept.push_back(path[next]);
    i = next;
  }
  return kept;
}

}  // namespace

Postures find_path(PlanCheck& check, const JointRow& start, const Postures& goals, int attempt) {
  if (attempt == 0) {
    for (const JointRow& goal : goals) {
      if (check.free_share(start, goal) >= 1.0) return {start, goal};
    }
  }
  return Search(check, start, goals, attempt).run();
}

Postures shortened(PlanCheck& check, Postures path, int attempt) {
  if (path.size() > 2) path = without_detours(check, path);
  const JointRow scale = scales(check.arm());
  RandomStream random(check.options().seed,
                      2 * kSearchStream + static_cast<std::uint64_t>(attempt));
  for (int i = 0; i < check.options().shortcuts && path.size() > 2 && !check.spent(); ++i) {
    const double whole = length_of(path, scale);
    double from = random.uniform(0.0, whole), to = random.uniform(0.0, whole);
    if (from > to) std::swap(from, to);
    const auto [first, start] = point_along(path, scale, from);
    const auto [last, end] = point_along(path, scale, to);
    if (first == last || check.free_share(start, end) < 1.0) continue;
    Postures shorter(path.begin(), path.begin() + static_cast<std::ptrdiff_t>(first) + 1);
    shorter.push_back(start);
    shorter.push_back(end);
    shorter.insert(shorter.end(), path.begin() + static_cast<std::ptrdiff_t>(last) + 1, path.end());
    path = std::move(shorter);
  }
  if (path.size() > 2) path = without_detours(check, path);
  return path;
}

}  // namespace bathyal::workspace
