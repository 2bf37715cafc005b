# SPDX-License-Identifier: BSD-3-Clause
"""The reference pages name all that is public: classes, functions, commands and options."""

from __future__ import annotations

import ast
import importlib
import importlib.util
import re
from pathlib import Path
from types import ModuleType

import pytest

import bathyal
from tests.support.command import run

ROOT = Path(__file__).resolve().parents[3]
DOCUMENTED = re.findall(
    r"^\.\. auto(?:class|exception|function|module):: (\S+)$",
    (ROOT / "docs" / "api.md").read_text(encoding="utf-8"),
    re.MULTILINE,
)


def names_documented() -> set[str]:
    return {name.rpartition(".")[2] for name in DOCUMENTED}


def test_every_public_name_is_on_the_page() -> None:
    assert set(bathyal.__all__) <= names_documented()


def test_every_class_of_the_engine_is_on_the_page() -> None:
    stub = (ROOT / "python" / "bathyal" / "_core.pyi").read_text(encoding="utf-8")
    classes = {node.name for node in ast.parse(stub).body if isinstance(node, ast.ClassDef)}
    assert {name for name in classes if not name.startswith("_")} <= names_documented()


@pytest.mark.parametrize("name", DOCUMENTED)
def test_documented_names_exist(name: str) -> None:
    parts = name.split(".")
    for length in range(len(parts), 0, -1):
        try:
            found: object = importlib.import_module(".".join(parts[:length]))
        except ModuleNotFoundError:
            continue
        for part in parts[length:]:
            found = getattr(found, part)
        assert isinstance(found, ModuleType) or found.__doc__
        return
    pytest.fail(f"{name} is not importable")


def test_every_page_is_in_a_table_of_contents() -> None:
    docs = ROOT / "docs"
    listed = set()
    for page in docs.rglob("*.md"):
        for body in re.findall(r"```\{toctree\}\n(.*?)```", page.read_text("utf-8"), re.DOTALL):
            entries = [line.split("<")[-1].rstrip(">") for line in body.splitlines()]
            listed |= {(page.parent / f"{entry}.md").resolve() for entry in entries if entry}
    pages = {page.resolve() for page in docs.rglob("*.md") if "_build" not in page.parts}
    assert pages - listed == {(docs / "index.md").resolve()}


def test_files_that_define_constants_exist() -> None:
    rooms = ROOT / "cpp" / "bathyal"
    named = set()
    for page in (ROOT / "docs" / "how_it_diagnoses").glob("*.md"):
        named |= set(re.findall(r"`([a-z_/]+\.[ch]pp)` \|$", page.read_text("utf-8"), re.MULTILINE))
    assert len(named) > 10
    assert {name for name in named if not (rooms / name).is_file()} == set()


@pytest.fixture(scope="module")
def sections() -> dict[str, str]:
    """The command-line reference, by command."""
    pytest.importorskip("sphinx")
    path = ROOT / "docs" / "extensions" / "command_line.py"
    spec = importlib.util.spec_from_file_location("command_line", path)
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    parts = re.split(r"^## (.*)$", module.page(), flags=re.MULTILINE)
    return dict(zip(parts[1::2], parts[2::2], strict=True))


def test_every_command_is_in_the_reference(sections: dict[str, str]) -> None:
    verbs = [
        "plan",
        "triangulate",
        "info",
        "soundings",
        "identify",
        "diagnose",
        "check",
        "reach",
        "sample",
        "profile",
        "world",
        "survey",
        "xtf",
        "mission",
        "run",
    ]
    expected = [*verbs, "touches example", "touches plan", "scenario example"]
    expected += [f"runs {verb}" for verb in ("add", "list", "show", "compare", "query")]
    assert set(sections) == {f"bathyal {verb}" for verb in expected}


@pytest.mark.parametrize(
    "command", ["plan", "triangulate", "info", "survey", "identify", "diagnose",
                "touches example", "touches plan", "check", "reach", "sample", "profile",
                "mission", "run",
                "scenario example"],
)  # fmt: skip
def test_every_option_of_a_command_is_in_the_reference(
    command: str, sections: dict[str, str], capsys: pytest.CaptureFixture[str],
    monkeypatch: pytest.MonkeyPatch,
) -> None:  # fmt: skip
    monkeypatch.setenv("COLUMNS", "100")
    _, helped, _ = run(capsys, *command.split(), "--help")
    options = set(re.findall(r"^[│|] +(?:\* +)?(--[a-z][a-z-]*)", helped, re.MULTILINE))
    assert len(options) >= 3
    assert {
        option for option in options if f"`{option}`" not in sections[f"bathyal {command}"]
    } <= {"--help"}
