# SPDX-License-Identifier: BSD-3-Clause
"""The committed stub of the engine is the one its bindings give, and the package type-checks."""

import ast
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[3]


def run(*command: str) -> str:
    done = subprocess.run(
        [sys.executable, "-m", *command], cwd=ROOT, capture_output=True, text=True, check=False
    )
    assert done.returncode == 0, done.stdout + done.stderr
    return done.stdout


def test_stub_is_current(tmp_path: Path) -> None:
    pytest.importorskip("pybind11_stubgen")
    run("pybind11_stubgen", "bathyal._core", "-o", str(tmp_path))
    made = (tmp_path / "bathyal" / "_core.pyi").read_text(encoding="utf-8")
    kept = (ROOT / "python" / "bathyal" / "_core.pyi").read_text(encoding="utf-8")
    assert made == kept, "make format writes the stub anew"


def test_signatures_say_what_they_take_and_return() -> None:
    tree = ast.parse((ROOT / "python" / "bathyal" / "_core.pyi").read_text(encoding="utf-8"))
    unknown = [
        f"{function.name}, line {function.lineno}"
        for function in ast.walk(tree)
        if isinstance(function, ast.FunctionDef)
        for node in (function.args, function.returns)
        if node is not None and "Any" in ast.unparse(node)
    ]
    assert unknown == []


def test_package_type_checks() -> None:
    pytest.importorskip("mypy")
    run("mypy")


def test_documentation_builds_without_a_warning(tmp_path: Path) -> None:
    pytest.importorskip("furo")
    run("sphinx", "-W", "--keep-going", "-q", "-b", "html", "docs", str(tmp_path))
