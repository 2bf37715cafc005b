# SPDX-License-Identifier: BSD-3-Clause
"""An object made by `__new__` alone is refused wherever it is used, of every class there is."""

from __future__ import annotations

import subprocess
import sys
from collections.abc import Callable
from typing import Any

import pytest

import bathyal
from bathyal import _core


def bound_classes(scope: Any) -> list[type]:
    found = [
        member
        for member in vars(scope).values()
        if isinstance(member, type) and type(member).__name__ == "pybind11_type"
    ]
    return found + [inner for outer in found for inner in bound_classes(outer)]


CLASSES = bound_classes(_core)


def uses(kind: type) -> dict[str, Callable[[Any], object]]:
    """What can be done with an object without any argument: its properties and special methods."""
    found: dict[str, Callable[[Any], object]] = {}
    for name in dir(kind):
        member = getattr(kind, name, None)
        if isinstance(member, property):
            found[name] = lambda made, name=name: getattr(made, name)
    for special in (repr, str, len, iter, bool):
        name = f"__{special.__name__}__"
        if "instancemethod" in type(vars(kind).get(name)).__name__:
            found[name] = special
    return found


def use_all(kind: type) -> None:
    made: Any = kind.__new__(kind)
    for name, use in uses(kind).items():
        says = rf"`self`: expected an? {kind.__name__}, got one whose __init__ has not run"
        with pytest.raises((TypeError, AttributeError), match=f"{says}|has no attribute"):
            pytest.fail(f"{kind.__name__}.{name}: {use(made)!r}")
    with pytest.raises((TypeError, ValueError), match=r"expected .+, got "):
        bathyal.triangulate(made)


def test_there_are_classes_to_look_at() -> None:
    assert {bathyal.PointCloud, bathyal.Scene, bathyal.Arm, bathyal.Diagnosis} <= set(CLASSES)
    assert sum(bool(uses(kind)) for kind in CLASSES) > 25


def test_an_object_without_init_is_refused() -> None:
    """In a process of its own: what is tested for ends it."""
    code = "import test_uninitialised as t\nfor kind in t.CLASSES: t.use_all(kind)"
    done = subprocess.run(
        [sys.executable, "-c", code],
        cwd=__file__.rpartition("/")[0],
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 0, done.stderr[-2000:]


def test_a_subclass_that_forgets_init_is_refused() -> None:
    class Named(bathyal.PointCloud):
        def __init__(self, name: str) -> None:
            self.name = f"{name} of {len(self)} points"

    with pytest.raises(TypeError, match=r"`self`: expected a PointCloud, got one whose __init__"):
        Named("reef")


def test_it_is_refused_as_an_argument() -> None:
    cloud = bathyal.PointCloud.__new__(bathyal.PointCloud)
    mesh = bathyal.TriangleMesh.__new__(bathyal.TriangleMesh)
    for call in (
        lambda: bathyal.clean_cloud(cloud),
        lambda: bathyal.Scene(mesh),
        lambda: bathyal.Scene([mesh]),
        lambda: bathyal.mesh_report(mesh),
    ):
        with pytest.raises(TypeError, match=r"expected .+, got one "):
            call()
