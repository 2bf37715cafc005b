# SPDX-License-Identifier: BSD-3-Clause
"""The examples in docstrings run as they are: of every public name, and of every module."""

import doctest
import importlib
import pkgutil

import pytest

import bathyal

MODULES = sorted(
    found.name
    for found in pkgutil.walk_packages(bathyal.__path__, "bathyal.")
    if not found.name.startswith(("bathyal._core", "bathyal._pcl"))
)


def run(tests: list[doctest.DocTest]) -> int:
    """How many examples there were, all of them right."""
    runner = doctest.DocTestRunner()
    for examples in tests:
        runner.run(examples)
    assert runner.summarize(verbose=False).failed == 0
    return runner.tries


@pytest.mark.parametrize("name", bathyal.__all__)
def test_examples_of_the_docstring_run(name: str) -> None:
    run(doctest.DocTestFinder().find(getattr(bathyal, name), name, False, {}))


@pytest.mark.parametrize("name", MODULES)
def test_examples_of_the_module_run(name: str) -> None:
    run(doctest.DocTestFinder().find(importlib.import_module(name)))


def test_examples_are_found() -> None:
    assert run(doctest.DocTestFinder().find(importlib.import_module("bathyal.cli.groups"))) > 3
