// SPDX-License-Identifier: BSD-3-Clause
#include <pybind11/stl.h>

#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "arrays.hpp"
#include "bathyal/base/error.hpp"
#include "bathyal/mission/condition.hpp"
#include "bathyal/mission/tree.hpp"
#include "behavior_tree.hpp"
#include "bindings.hpp"
#include "enum_names.hpp"

namespace bathyal::python {
namespace {

const EnumNames<NodeStatus>& status_names() {
  static const EnumNames<NodeStatus> names{{"idle", NodeStatus::kIdle},
                                           {"running", NodeStatus::kRunning},
                                           {"success", NodeStatus::kSuccess},
                                           {"failure", NodeStatus::kFailure}};
  return names;
}

/// A tree, what it remembers, and leaves that are names.
struct NamedTree {
  std::vector<std::string> leaves;
  std::shared_ptr<const BehaviorTree> tree;
  TreeState state;
};

using NodeValue = py::typing::Union<py::str, py::float_, py::bool_, py::list>;
using NodeDict = py::typing::Dict<py::str, NodeValue>;
using Answer = py::typing::Callable<py::str(py::str)>;

class CalledLeaves final : public TreeLeaves {
 public:
  CalledLeaves(const std::vector<std::string>& names, const py::object& update)
      : names_(names), update_(update) {}
  void start(int) override {}
  void stop(int) override {}
  NodeStatus update(int leaf) override {
    const auto answer = update_(names_[static_cast<std::size_t>(leaf)]).cast<std::string>();
    const NodeStatus status = enum_argument("update", answer, status_names());
    if (status == NodeStatus::kIdle) {
      throw_argument("update", "running, success or failure", "'idle'");
    }
    return status;
  }

 private:
  const std::vector<std::string>& names_;
  const py::object& update_;
};

double number_in(const py::dict& dict, const char* key, double otherwise) {
  return dict.contains(key) ? dict[key].cast<double>() : otherwise;
}

}  // namespace

TreeNode tree_argument(const py::object& object, const LeafNumber& leaf) {
  if (!py::isinstance<py::dict>(object)) {
    throw_argument("tree", "a dict with the key kind", py::repr(object).cast<std::string>());
  }
  const auto dict = py::reinterpret_borrow<py::dict>(object);
  if (!dict.contains("kind")) throw_argument("tree", "a dict with the key kind", "one without it");
  const EnumNames<NodeKind> kinds{
      {"sequence", NodeKind::kSequence}, {"fallback", NodeKind::kFallback},
      {"parallel", NodeKind::kParallel}, {"retry", NodeKind::kRetry},
      {"timeout", NodeKind::kTimeout},   {"invert", NodeKind::kInvert},
      {"leaf", NodeKind::kLeaf}};
  TreeNode node;
  node.kind = enum_argument("kind", dict["kind"].cast<std::string>(), kinds);
  if (dict.contains("name")) node.name = dict["name"].cast<std::string>();
  if (dict.contains("memory")) node.memory = dict["memory"].cast<bool>();
  if (dict.contains("any")) node.any = dict["any"].cast<bool>();
  node.count = static_cast<int>(number_in(dict, "count", 1.0));
  node.time = number_in(dict, "time", 0.0);
  if (dict.contains("children")) {
    for (const py::handle child : dict["children"].cast<py::list>()) {
      node.children.push_back(tree_argument(py::reinterpret_borrow<py::object>(child), leaf));
    }
  }
  if (node.kind == NodeKind::kLeaf) node.leaf = leaf(dict);
  return node;
}

void bind_behavior_tree(py::module_& module) {
  py::class_<NamedTree>(module, "BehaviorTree", R"(A behaviour tree whose leaves are named.

Statuses are those of py_trees (2.x), tick by tick.

Parameters
----------
tree : dict
    ``kind`` is sequence, fallback, parallel, retry, timeout, invert or leaf; ``children`` a list of
    such; ``name`` of a leaf; ``memory`` (True) of a sequence or fallback, ``any`` (False) of a
    parallel, ``count`` of a retry, ``time`` [s] of a timeout.

Raises
------
ValueError
    For a decorator without its one child, a leaf with children, numbers out of range.

Examples
--------
>>> import bathyal
>>> tree = bathyal.BehaviorTree({"kind": "fallback", "children": [
...     {"kind": "leaf", "name": "dive"}, {"kind": "leaf", "name": "surface"}]})
>>> tree.tick(0.0, lambda leaf: "failure" if leaf == "dive" else "running")
'running'
>>> tree.statuses
['running', 'failure', 'running']
)")
      .def(py::init([](const NodeDict& tree) {
             NamedTree named;
             const TreeNode root = tree_argument(tree, [&](const py::dict& leaf) {
               named.leaves.push_back(leaf.contains("name") ? leaf["name"].cast<std::string>()
                                                            : std::string());
               return static_cast<int>(named.leaves.size()) - 1;
             });
             named.tree = std::make_shared<const BehaviorTree>(root);
             named.state = named.tree->fresh();
             return named;
           }),
           py::arg("tree"))
      .def(
          "tick",
          [](NamedTree& named, double time, const Answer& update) {
            CalledLeaves leaves(named.leaves, update);
            return enum_name(named.tree->tick(named.state, time, leaves), status_names());
          },
          py::arg("time"), py::arg("update"), R"(One tick.

Parameters
----------
time : float
    [s], never falling.
update : function
    Of a leaf's name: "running", "success" or "failure".

Returns
-------
str
    Of the root.
)")
      .def_property_readonly(
          "statuses",
          [](const NamedTree& named) {
            std::vector<std::string> all;
            for (const NodeStatus status : named.state.status) {
              all.emplace_back(enum_name(status, status_names()));
            }
            return all;
          },
          "Of each node, a node before its children: idle, running, success or failure.");

  py::class_<Condition>(module, "Condition", R"(A condition on named signals, in words.

Comparisons joined by and, or, not and brackets: ``depth > 40 m or battery < 20 %``. Units are m, cm,
km, s, min, h, %, V, A, deg, rad, m/s and kg. Nothing is evaluated as code.

Parameters
----------
text : str
signals : list of str
    Names that it may use.

Raises
------
ValueError
    With the column of what is not understood.
)")
      .def(py::init([](const std::string& text, const std::vector<std::string>& signals) {
             return Condition(text, signals);
           }),
           py::arg("text"), py::arg("signals"))
      .def(
          "holds",
          [](const Condition& c, const std::vector<double>& values) {
            if (values.size() != c.signal_count()) {
              throw_argument("values", std::to_string(c.signal_count()) + " numbers",
                             std::to_string(values.size()));
            }
            return c.holds(values);
          },
          py::arg("values"), "Whether it holds for these values, one a signal; NaN is not known.")
      .def_property_readonly("text", &Condition::text, "As given.");
}

}  // namespace bathyal::python
