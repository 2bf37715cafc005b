# SPDX-License-Identifier: BSD-3-Clause
"""The package's rooms lie on the floors of ARCHITECTURE.md: an import may only point down."""

import ast
import re
from graphlib import CycleError, TopologicalSorter
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[3]
PACKAGE = ROOT / "python" / "bathyal"
SOURCES = sorted(PACKAGE.rglob("*.py"))
FACE = "bathyal"


def floors() -> dict[str, int]:
    """Room → floor, as ARCHITECTURE.md gives them for Python."""
    text = (ROOT / "ARCHITECTURE.md").read_text(encoding="utf-8")
    rows = re.findall(r"^\| ((?:`\w+`,? ?)+) \| (\d) \|", text, re.M)
    return {name: int(floor) for names, floor in rows for name in re.findall(r"\w+", names)}


def module_of(path: Path) -> str:
    parts = path.relative_to(PACKAGE.parent).with_suffix("").parts
    return ".".join(parts[:-1] if parts[-1] == "__init__" else parts)


MODULES = {module_of(path) for path in SOURCES}


def room_of(module: str) -> str:
    """ "bathyal.io.files" → "io"; of the package's own __init__ "bathyal"."""
    parts = module.split(".")
    return parts[1] if len(parts) > 1 else FACE


def imported(text: str) -> list[tuple[str, bool]]:
    """Modules of the package that a source imports, and whether as soon as it is imported."""
    tree = ast.parse(text)
    late = {
        node
        for outer in ast.walk(tree)
        if isinstance(outer, (ast.FunctionDef, ast.If))
        for node in ast.walk(outer)
    }
    found = []
    for node in ast.walk(tree):
        names: list[str] = []
        if isinstance(node, ast.Import):
            names = [alias.name for alias in node.names]
        elif isinstance(node, ast.ImportFrom):
            assert node.level == 0, "imports name the whole path"
            whole = [f"{node.module}.{alias.name}" for alias in node.names]
            names = [name if name in MODULES else str(node.module) for name in whole]
            if node.module == FACE and "_core" in {alias.name for alias in node.names}:
                names = [name for name in names if name != FACE]
        found += [(name, node not in late) for name in names if name.split(".")[0] == FACE]
    return [(name, now) for name, now in found if name != "bathyal._core"]


def wrong_imports(room: str, text: str) -> list[str]:
    """Modules that a source of `room` imports though their room is not below it."""
    floor = floors()
    names = [name for name, _ in imported(text)]
    return [n for n in names if room_of(n) != room and floor[room_of(n)] >= floor[room]]


def test_every_room_has_a_floor() -> None:
    assert {room_of(module) for module in MODULES} == set(floors())


@pytest.mark.parametrize("path", SOURCES, ids=lambda p: str(p.relative_to(PACKAGE)))
def test_imports_point_down(path: Path) -> None:
    assert wrong_imports(room_of(module_of(path)), path.read_text("utf-8")) == []


def test_an_import_that_points_up_or_sideways_is_found() -> None:
    assert wrong_imports("io", "from bathyal.view.palette import INK") == ["bathyal.view.palette"]
    assert wrong_imports("arm", "def f():\n    from bathyal import cli") == ["bathyal.cli"]
    assert wrong_imports("arm", "from bathyal.seabed import clouds") == ["bathyal.seabed.clouds"]
    assert wrong_imports("diagnosis", "import bathyal") == ["bathyal"]
    assert wrong_imports("diagnosis", "from bathyal import diagnose") == ["bathyal"]
    assert wrong_imports("io", "from bathyal import _core, errors") == []
    assert wrong_imports("cli", "import bathyal") == []


def test_no_module_needs_itself() -> None:
    needs = {
        module_of(path): {name for name, now in imported(path.read_text("utf-8")) if now}
        for path in SOURCES
    }
    try:
        TopologicalSorter(needs).prepare()
    except CycleError as error:
        pytest.fail(" ← ".join(error.args[1]))


def test_the_engine_imports_nothing_of_the_package() -> None:
    for path in sorted((ROOT / "cpp").rglob("*.[hc]pp")):
        text = path.read_text("utf-8")
        assert not re.search(r'"bathyal\.[a-z]\w*[."]', text), path.name
        assert not re.search(r'module_::import\("bathyal', text), path.name
