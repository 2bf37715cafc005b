// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace bathyal {

enum class NodeStatus : std::uint8_t { kIdle, kRunning, kSuccess, kFailure };

enum class NodeKind : std::uint8_t {
  kSequence,  ///< one after the other, until one fails
  kFallback,  ///< one after the other, until one succeeds
  kParallel,  ///< all at once; fails with the first that fails
  kRetry,     ///< its child again until it has failed `count` times
  kTimeout,   ///< fails when its child runs for longer than `time`
  kInvert,
  kLeaf,
};

/// A behaviour tree as it is given.
struct TreeNode {
  NodeKind kind = NodeKind::kLeaf;
  std::string name = {};
  std::vector<TreeNode> children = {};
  bool memory =
      true;          ///< a sequence or fallback goes on where it was; else it begins anew each tick
  bool any = false;  ///< a parallel succeeds with its first child; else with all of them
  int count = 1;     ///< of a retry, 1 or more
  double time = 0.0;  ///< of a timeout [s], 0 or more
  int leaf = -1;      ///< number of a leaf, as its owner counts

  /// \throw std::invalid_argument for a decorator without its one child, a leaf with children, a
  ///        count or time out of range, or a tree deeper than 100.
  void check() const;
};

/// What a tree remembers between ticks, by node in the order of `BehaviorTree::node`.
struct TreeState {
  std::vector<NodeStatus> status;
  std::vector<std::int32_t> current;   ///< row among its children
  std::vector<std::int32_t> failures;  ///< of a retry
  std::vector<double> since;           ///< of a timeout [s]
};

/// What leaves do.
class TreeLeaves {
 public:
  virtual void start(int leaf) = 0;
  virtual NodeStatus update(int leaf) = 0;  ///< running, success or failure
  virtual void stop(int leaf) = 0;          ///< while it runs: something else takes its place

  TreeLeaves() = default;
  TreeLeaves(const TreeLeaves&) = delete;
  TreeLeaves& operator=(const TreeLeaves&) = delete;

 protected:
  ~TreeLeaves() = default;
};

/// Sequences, fallbacks, parallels and decorators; statuses as py_trees gives them (Stonier, 2.x).
class BehaviorTree {
 public:
  /// \throw std::invalid_argument as TreeNode::check
  explicit BehaviorTree(TreeNode root);

  TreeState fresh() const;

  /// \param time of the tick [s], never falling
  NodeStatus tick(TreeState& state, double time, TreeLeaves& leaves) const;

  /// Ends what runs.
  void stop(TreeState& state, TreeLeaves& leaves) const;

  std::size_t size() const { return nodes_.size(); }
  const TreeNode& node(std::size_t row) const { return *nodes_[row].given; }

 private:
  struct Node {
    const TreeNode* given;
    std::vector<std::size_t> children;
  };
  struct Tick;

  std::size_t add(const TreeNode& given);

  TreeNode root_;
  std::vector<Node> nodes_;  ///< each before its children
};

}  // namespace bathyal
