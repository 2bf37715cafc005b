# SPDX-License-Identifier: BSD-3-Clause
"""A call that does not fit ends in one short sentence that names the argument at fault."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator
from typing import Any

import numpy as np
import pytest

import bathyal
from bathyal import _core

GRID = np.array([[x, y, 0.01 * x * y] for x in range(6) for y in range(5)], dtype=float)
SENTENCE = re.compile(r"`[^`\n]+`: expected [^\n]+, got [^\n]+")
ARM = bathyal.arms.ur10e()
TRACKED = bathyal.Tracked(np.zeros((3, 6)) + np.arange(3)[:, None], np.zeros((3, 3)))


class Nothing:
    """Converts to nothing."""

    __slots__ = ()


def functions() -> Iterator[tuple[str, Callable[..., object], str]]:
    """Every bound function, constructor and static method: name, itself, its signature."""
    for name, member in vars(_core).items():
        if isinstance(member, type) and type(member).__name__ == "pybind11_type":
            init = vars(member).get("__init__")
            if init is not None and "(self: " in (init.__doc__ or ""):
                yield name, member, init.__doc__
            for inner, method in vars(member).items():
                if isinstance(method, staticmethod) and "-> " in (method.__doc__ or ""):
                    yield f"{name}.{inner}", getattr(member, inner), method.__doc__
        elif type(member).__name__ == "builtin_function_or_method":
            yield name, member, member.__doc__ or ""


FUNCTIONS = list(functions())


def test_there_are_functions_to_look_at():
    assert len(FUNCTIONS) > 30
    assert "triangulate" in [name for name, _, _ in FUNCTIONS]
    assert "PointCloud" in [name for name, _, _ in FUNCTIONS]


@pytest.mark.parametrize(("name", "function", "doc"), FUNCTIONS, ids=[f[0] for f in FUNCTIONS])
def test_no_call_is_answered_with_a_signature(name, function, doc):
    parameters = set(re.findall(r"[(,] (?:self: )?(\w+): ", f" {doc.splitlines()[0]}"))
    calls: list[Callable[[], Any]] = [
        lambda: function(*[Nothing()] * 60),
        lambda: function(no_such_argument=1),
    ]
    calls += [lambda p=p: function(**{p: Nothing()}) for p in parameters]
    calls += [lambda p=p: function(**{p: 2**70}) for p in parameters]
    for call in calls:
        try:
            call()
        except (TypeError, ValueError, OverflowError) as error:
            text = str(error)
            assert "incompatible" not in text, text
            assert SENTENCE.match(text), text
            assert len(text) < 250, text
        except bathyal.Error:
            pass  # a file that is not there


REFUSED = {
    "an int": (lambda: bathyal.fit_plane(GRID, num_threads="two"), TypeError,
               "`num_threads`: expected a whole number, got str"),
    "an int, a float": (lambda: bathyal.fit_plane(GRID, trials=5.5), TypeError,
                        "`trials`: expected a whole number, got float"),
    "threads": (lambda: bathyal.fit_plane(GRID, num_threads=2**31), ValueError,
                "`num_threads`: expected a whole number up to 2147483647, got 2147483648"),
    "a seed": (lambda: bathyal.fit_plane(GRID, seed=-1), ValueError,
               "`seed`: expected a whole number of 0 or more, got -1"),
    "a large seed": (lambda: bathyal.fit_plane(GRID, seed=10**30), ValueError,
                     f"`seed`: expected a whole number of 64 bits, got {10**30}"),
    "a float": (lambda: bathyal.fit_plane(GRID, tolerance="1"), TypeError,
                "`tolerance`: expected a number, got str"),
    "no float": (lambda: bathyal.fit_plane(GRID, tolerance=None), TypeError,
                 "`tolerance`: expected a number, got None"),
    "a huge float": (lambda: bathyal.fit_plane(GRID, tolerance=10**400), ValueError,
                     "`tolerance`: expected a number within the range of float, got 1000"),
    "an optional float": (lambda: bathyal.find_sheets(GRID, min_separation=GRID), TypeError,
                          "`min_separation`: expected a number, got ndarray"),
    "a text": (lambda: bathyal.clean_cloud(GRID, same_place=3), TypeError,
               "`same_place`: expected text, got int"),
    "no unicode": (lambda: bathyal.clean_cloud(GRID, same_place="\ud800"), TypeError,
                   "`same_place`: expected text, got text that is no Unicode"),
    "an unknown argument": (lambda: bathyal.fit_plane(GRID, tolerence=1), TypeError,
                            "`tolerence`: expected an argument of fit_plane, got one that it does"),
    "too many": (lambda: bathyal.fit_plane(GRID, 1, 2), TypeError,
                 "`fit_plane`: expected at most 1 arguments without a name, got 3"),
    "none": (lambda: bathyal.fit_plane(), TypeError,
             "`cloud`: expected a PointCloud or an object, got no such argument"),
    "a class": (lambda: bathyal.mesh_report(GRID), TypeError,
                "`mesh`: expected a TriangleMesh, got ndarray"),
    "overloads": (lambda: bathyal.Scene("mesh"), TypeError,
                  "`mesh`: expected a TriangleMesh or a sequence, each item a TriangleMesh, "
                  "got str"),
    "an item": (lambda: bathyal.Scene([bathyal.triangulate(GRID), 3]), TypeError,
                "`mesh`: expected a TriangleMesh or a sequence, each item a TriangleMesh, "
                "got int in item 1"),
    "a sequence": (lambda: bathyal.identify_arm(ARM, TRACKED, fixed=[1]), TypeError,
                   "`fixed`: expected a sequence, each item text, got int in item 0"),
    "a dict": (lambda: bathyal.identify_arm(ARM, TRACKED, priors={"a": "b"}), TypeError,
               "`priors`: expected a dict of text to a number, got dict"),
    "a constructor": (lambda: bathyal.PointCloud(GRID, crs=5), TypeError,
                      "`crs`: expected text, got int"),
    "a method": (lambda: bathyal.Scene(bathyal.triangulate(GRID)).nearest(GRID, num_threads="x"),
                 TypeError, "`num_threads`: expected a whole number, got str"),
    "self": (lambda: bathyal.Scene.nearest(3, GRID), TypeError,
             "`self`: expected a Scene, got int"),
}  # fmt: skip


@pytest.mark.parametrize(("call", "kind", "says"), REFUSED.values(), ids=REFUSED.keys())
def test_the_argument_at_fault_is_named(call, kind, says):
    with pytest.raises(kind) as error:
        call()
    assert type(error.value) is kind
    assert str(error.value).startswith(says)


def test_a_type_error_of_the_callers_own_function_is_handed_on():
    def feasible(q: object) -> object:
        raise TypeError("plan_touches(): of my own")

    with pytest.raises(TypeError, match=r"^plan_touches\(\): of my own$"):
        bathyal.plan_touches(ARM, 4, feasible=feasible)


LIMITS = {
    "altitude": lambda: bathyal.generate_survey(altitude=1e12),
    "trench_depth": lambda: bathyal.generate_survey(trench_depth=1e12),
    "wave_height": lambda: bathyal.generate_survey(wave_height=1e12),
    "trials": lambda: bathyal.fit_plane(GRID, trials=10**9),
    "steps": lambda: ARM.inverse(np.eye(4), method="pseudo_inverse", steps=10**9),
    "max_starts": lambda: ARM.inverse(np.eye(4), max_starts=10**9),
    "candidates": lambda: bathyal.plan_touches(ARM, 4, candidates=10**9),
    "passes": lambda: bathyal.plan_touches(ARM, 4, passes=10**9),
    "num_points": lambda: bathyal.plan_touches(ARM, 4, num_points=10**9),
    "workspace_poses": lambda: bathyal.plan_touches(ARM, 4, workspace_poses=10**9),
    "count": lambda: bathyal.plan_touches(ARM, 10**9),
}


@pytest.mark.parametrize("name", LIMITS)
def test_a_number_too_large_to_come_back_from_is_refused(name):
    with pytest.raises(ValueError, match=f"^`{name}`: expected a number from .+, got 1e"):
        LIMITS[name]()


@pytest.mark.parametrize("bad", [np.nan, np.inf])
def test_survey_height_refuses_places_that_are_not_finite(bad):
    for name, places in (("x", ([0.0, bad], [0.0, 1.0])), ("y", ([0.0, 1.0], [0.0, bad]))):
        with pytest.raises(ValueError, match=f"`{name}`: expected finite numbers, got .* in row 1"):
            bathyal.survey_height(*places)
