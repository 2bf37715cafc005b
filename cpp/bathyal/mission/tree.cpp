// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/mission/tree.hpp"

#include <string>
#include <utility>

#include "bathyal/base/check.hpp"
#include "bathyal/base/error.hpp"

namespace bathyal {
namespace {

constexpr int kMostLevels = 100;

bool decorates(NodeKind kind) {
  return kind == NodeKind::kRetry || kind == NodeKind::kTimeout || kind == NodeKind::kInvert;
}

void check_node(const TreeNode& node, int depth) {
  if (depth > kMostLevels) throw_argument("tree", "at most 100 levels", "more");
  if (decorates(node.kind) && node.children.size() != 1) {
    throw_argument(node.name.empty() ? "tree" : node.name, "one child",
                   std::to_string(node.children.size()) + " of them");
  }
  if (node.kind == NodeKind::kLeaf && !node.children.empty()) {
    throw_argument(node.name.empty() ? "leaf" : node.name, "no children",
                   std::to_string(node.children.size()) + " of them");
  }
  if (node.kind == NodeKind::kRetry) check_range("retry", node.count, 1, 1'000'000);
  if (node.kind == NodeKind::kTimeout) check_not_negative("timeout", node.time);
  for (const TreeNode& child : node.children) check_node(child, depth + 1);
}

}  // namespace

void TreeNode::check() const { check_node(*this, 1); }

/// One tick: the same steps, in the same order, as py_trees takes.
struct BehaviorTree::Tick {
  const std::vector<Node>& nodes;
  TreeState& state;
  double time;
  TreeLeaves& leaves;

  NodeStatus& status(std::size_t row) const { return state.status[row]; }

  void stop(std::size_t row) const {
    const Node& node = nodes[row];
    if (node.given->kind == NodeKind::kLeaf && status(row) == NodeStatus::kRunning) {
      leaves.stop(node.given->leaf);
    }
    for (const std::size_t child : node.children) {
      if (status(child) != NodeStatus::kIdle) stop(child);
    }
    status(row) = NodeStatus::kIdle;
    state.current[row] = 0;
  }

  void stop_from(std::size_t row, std::size_t first) const {
    const auto& children = nodes[row].children;
    for (std::size_t k = first; k < children.size(); ++k) {
      if (status(children[k]) != NodeStatus::kIdle) stop(children[k]);
    }
  }

  void stop_running_children(std::size_t row) const {
    for (const std::size_t child : nodes[row].children) {
      if (status(child) == NodeStatus::kRunning) stop(child);
    }
  }

  NodeStatus sequence(std::size_t row) const {
    const Node& node = nodes[row];
    std::size_t k = 0;
    if (status(row) != NodeStatus::kRunning) {
      stop_from(row, 0);
    } else if (node.given->memory) {
      k = static_cast<std::size_t>(state.current[row]);
    }
    for (; k < node.children.size(); ++k) {
      state.current[row] = static_cast<std::int32_t>(k);
      const NodeStatus found = tick(node.children[k]);
      if (found == NodeStatus::kSuccess) continue;
      if (!node.given->memory) stop_from(row, k + 1);
      return found;
    }
    return NodeStatus::kSuccess;
  }

  NodeStatus fallback(std::size_t row) const {
    const Node& node = nodes[row];
    if (status(row) != NodeStatus::kRunning) state.current[row] = 0;
    const auto previous = static_cast<std::size_t>(state.current[row]);
    std::size_t k = 0;
    if (node.given->memory) {
      for (; k < previous; ++k) stop(node.children[k]);
    }
    for (; k < node.children.size(); ++k) {
      const NodeStatus found = tick(node.children[k]);
      if (found == NodeStatus::kFailure) continue;
      state.current[row] = static_cast<std::int32_t>(k);
      if (k != previous) stop_from(row, k + 1);
      return found;
    }
    if (!node.children.empty()) {
      state.current[row] = static_cast<std::int32_t>(node.children.size() - 1);
    }
    return NodeStatus::kFailure;
  }

  NodeStatus parallel(std::size_t row) const {
    const Node& node = nodes[row];
    if (status(row) != NodeStatus::kRunning) stop_from(row, 0);
    std::size_t succeeded = 0;
    bool failed = false;
    for (const std::size_t child : node.children) {
      const bool done = !node.given->any && status(child) == NodeStatus::kSuccess;
      const NodeStatus found = done ? NodeStatus::kSuccess : tick(child);
      failed = failed || found == NodeStatus::kFailure;
      if (found == NodeStatus::kSuccess) ++succeeded;
    }
    const std::size_t needed = node.given->any ? 1 : node.children.size();
    if (!failed && !node.children.empty() && succeeded < needed) return NodeStatus::kRunning;
    stop_running_children(row);
    return failed ? NodeStatus::kFailure : NodeStatus::kSuccess;
  }

  NodeStatus decorator(std::size_t row) const {
    const Node& node = nodes[row];
    if (status(row) != NodeStatus::kRunning) {
      state.failures[row] = 0;
      state.since[row] = time;
    }
    NodeStatus found = tick(node.children.front());
    switch (node.given->kind) {
      case NodeKind::kInvert:
        if (found == NodeStatus::kSuccess) return NodeStatus::kFailure;
        return found == NodeStatus::kFailure ? NodeStatus::kSuccess : found;
      case NodeKind::kRetry:
        if (found != NodeStatus::kFailure) return found;
        return ++state.failures[row] < node.given->count ? NodeStatus::kRunning : found;
      default:
        if (found == NodeStatus::kRunning && time > state.since[row] + node.given->time) {
          stop(node.children.front());
          return NodeStatus::kFailure;
        }
        return found;
    }
  }

  NodeStatus leaf(std::size_t row) const {
    const int number = nodes[row].given->leaf;
    if (status(row) != NodeStatus::kRunning) leaves.start(number);
    return leaves.update(number);
  }

  NodeStatus tick(std::size_t row) const {
    NodeStatus found = NodeStatus::kSuccess;
    switch (nodes[row].given->kind) {
      case NodeKind::kSequence:
        found = sequence(row);
        break;
      case NodeKind::kFallback:
        found = fallback(row);
        break;
      case NodeKind::kParallel:
        found = parallel(row);
        break;
      case NodeKind::kLeaf:
        found = leaf(row);
        break;
      default:
        found = decorator(row);
    }
    status(row) = found;
    return found;
  }
};

BehaviorTree::BehaviorTree(TreeNode root) : root_(std::move(root)) {
  root_.check();
  add(root_);
}

std::size_t BehaviorTree::add(const TreeNode& given) {
  const std::size_t row = nodes_.size();
  nodes_.push_back({&given, {}});
  for (const TreeNode& child : given.children) {
    const std::size_t at = add(child);
    nodes_[row].children.push_back(at);
  }
  return row;
}

TreeState BehaviorTree::fresh() const {
  TreeState state;
  state.status.assign(nodes_.size(), NodeStatus::kIdle);
  state.current.assign(nodes_.size(), 0);
  state.failures.assign(nodes_.size(), 0);
  state.since.assign(nodes_.size(), 0.0);
  return state;
}

NodeStatus BehaviorTree::tick(TreeState& state, double time, TreeLeaves& leaves) const {
  return Tick{nodes_, state, time, leaves}.tick(0);
}

void BehaviorTree::stop(TreeState& state, TreeLeaves& leaves) const {
  Tick{nodes_, state, 0.0, leaves}.stop(0);
}

}  // namespace bathyal
