# SPDX-License-Identifier: BSD-3-Clause
"""The examples in the docstrings of every public name run as they stand."""

import doctest
import importlib

import pytest

import bathyal


@pytest.mark.parametrize("name", bathyal.__all__)
def test_examples_of_the_docstring_run(name: str) -> None:
    runner = doctest.DocTestRunner()
    for examples in doctest.DocTestFinder().find(getattr(bathyal, name), name, False, {}):
        runner.run(examples)
    assert runner.summarize(verbose=False).failed == 0


@pytest.mark.parametrize("name", ["arm_files", "arm_views", "urdf", "urdf_writer"])
def test_examples_behind_the_methods_of_arm_run(name: str) -> None:
    results = doctest.testmod(importlib.import_module(f"bathyal.{name}"))
    assert results.attempted > 0
    assert results.failed == 0
