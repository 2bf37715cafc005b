# SPDX-License-Identifier: BSD-3-Clause
"""Behaviour trees: the same statuses as py_trees, tick by tick, on random trees."""

from __future__ import annotations

import random

import pytest

import bathyal

MOST_LEVELS = 5
STATUSES = ("running", "success", "failure")


def random_tree(draw: random.Random, level: int = 0) -> dict[str, object]:
    kind = draw.choice(["sequence", "fallback", "parallel", "retry", "timeout", "invert", "leaf"])
    if level == MOST_LEVELS or (level > 0 and kind == "leaf"):
        return {"kind": "leaf", "name": f"leaf {draw.getrandbits(40)}"}
    if kind in ("retry", "timeout", "invert"):
        node: dict[str, object] = {"kind": kind, "children": [random_tree(draw, level + 1)]}
        node["count"] = draw.randint(1, 4)
        node["time"] = float(draw.randint(0, 4))
        return node
    if kind == "leaf":
        kind = "sequence"
    count = draw.randint(1, 4)
    children = [random_tree(draw, level + 1) for _ in range(count)]
    return {
        "kind": kind,
        "children": children,
        "memory": draw.random() < 0.5,
        "any": draw.random() < 0.5,
    }


def peer(tree, node, answers):
    """The same tree of py_trees, its nodes in the same order."""
    trees = pytest.importorskip("py_trees")

    class Leaf(trees.behaviour.Behaviour):
        def update(self):
            return trees.common.Status[answers(self.name).upper()]

    made: list[object] = []

    def build(node):
        row = len(made)
        made.append(None)
        kind = node["kind"]
        children = [build(child) for child in node.get("children", [])]
        name = f"node {row}"
        if kind == "leaf":
            found = Leaf(node["name"])
        elif kind == "sequence":
            found = trees.composites.Sequence(name, node["memory"], children)
        elif kind == "fallback":
            found = trees.composites.Selector(name, node["memory"], children)
        elif kind == "parallel":
            policies = trees.common.ParallelPolicy
            policy = policies.SuccessOnOne() if node["any"] else policies.SuccessOnAll()
            found = trees.composites.Parallel(name, policy, children)
        elif kind == "retry":
            found = trees.decorators.Retry(name, children[0], node["count"])
        elif kind == "timeout":
            found = trees.decorators.Timeout(name, children[0], node["time"])
        else:
            found = trees.decorators.Inverter(name, children[0])
        made[row] = found
        return found

    return build(node), made


@pytest.mark.parametrize("block", range(10))
def test_statuses_are_those_of_py_trees(block, monkeypatch):
    trees = pytest.importorskip("py_trees")
    now = [0.0]
    monkeypatch.setattr(trees.decorators.time, "monotonic", lambda: now[0])
    for seed in range(100 * block, 100 * block + 100):
        draw = random.Random(seed)
        spec = random_tree(draw)

        def answers(leaf, seed=seed):
            return random.Random(f"{seed} {leaf} {now[0]}").choice(STATUSES)

        tree = bathyal.BehaviorTree(spec)
        root, nodes = peer(tree, spec, answers)
        for tick in range(20):
            now[0] = float(tick)
            found = tree.tick(now[0], answers)
            root.tick_once()
            expected = [node.status.name.lower().replace("invalid", "idle") for node in nodes]
            assert tree.statuses == expected, (seed, tick)
            assert found == root.status.name.lower()


@pytest.mark.parametrize(
    ("tree", "message"),
    [
        ({}, "the key kind"),
        ({"kind": "loop"}, "kind"),
        ({"kind": "retry", "children": []}, "one child"),
        ({"kind": "leaf", "children": [{"kind": "leaf"}]}, "no children"),
        ({"kind": "retry", "count": 0, "children": [{"kind": "leaf"}]}, "retry"),
        ({"kind": "timeout", "time": float("nan"), "children": [{"kind": "leaf"}]}, "timeout"),
        ({"kind": "sequence", "children": [3]}, "tree"),
    ],
)
def test_trees_that_are_none_are_refused(tree, message):
    with pytest.raises(ValueError, match=message):
        bathyal.BehaviorTree(tree)


def test_an_answer_that_is_none_is_refused():
    tree = bathyal.BehaviorTree({"kind": "leaf", "name": "a"})
    with pytest.raises(ValueError, match="update"):
        tree.tick(0.0, lambda leaf: "idle")
    with pytest.raises(ZeroDivisionError):
        tree.tick(0.0, lambda leaf: 1 / 0)


def test_conditions():
    condition = bathyal.Condition("depth > 40 m or battery < 20 %", ["depth", "battery"])
    assert condition.holds([41.0, 1.0])
    assert not condition.holds([40.0, 0.2])
    with pytest.raises(ValueError, match="column 9"):
        bathyal.Condition("depth > import", ["depth"])
    with pytest.raises(ValueError, match="values"):
        condition.holds([1.0])
