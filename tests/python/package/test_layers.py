# SPDX-License-Identifier: BSD-3-Clause
"""The rooms lie as ARCHITECTURE.md says: an include may only point down."""

import re
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[3]
MODULES = ROOT / "cpp" / "bathyal"


def floors() -> dict[str, int]:
    """Room → floor, as the table of ARCHITECTURE.md gives them."""
    text = (ROOT / "ARCHITECTURE.md").read_text(encoding="utf-8")
    rows = re.findall(r"^\| (\d) \| ([`\w, ]+) \|", text, re.M)
    return {name: int(floor) for floor, names in rows for name in re.findall(r"\w+", names)}


def sources() -> list[Path]:
    return sorted([*MODULES.rglob("*.hpp"), *MODULES.rglob("*.cpp"), *MODULES.rglob("*.inl")])


def wrong_includes(room: str, text: str) -> list[str]:
    """Rooms that `text`, standing in `room`, includes though they are not below it."""
    floor = floors()
    included = re.findall(r'^\s*#\s*include\s*[<"]bathyal/(\w+)/', text, re.M)
    return [other for other in included if other != room and floor[other] >= floor[room]]


def test_every_room_has_a_floor() -> None:
    rooms = {path.name for path in MODULES.iterdir() if path.is_dir()}
    assert rooms <= set(floors())


@pytest.mark.parametrize("path", sources(), ids=lambda p: str(p.relative_to(MODULES)))
def test_includes_point_down(path: Path) -> None:
    assert wrong_includes(path.relative_to(MODULES).parts[0], path.read_text("utf-8")) == []


def test_an_include_that_points_up_or_sideways_is_found() -> None:
    assert wrong_includes("terrain", '#include "bathyal/scene/scene.hpp"\n') == ["scene"]
    assert wrong_includes("base", "#include <bathyal/geometry/plane.hpp>\n") == ["geometry"]


def test_link_targets_point_down() -> None:
    floor = floors()
    for path in sorted(MODULES.glob("*/CMakeLists.txt")):
        room = path.parent.name
        for other in re.findall(r"bathyal::(\w+)", path.read_text("utf-8")):
            if other in floor and other != room:
                assert floor[other] < floor[room], f"{room} links {other}"


HEAVY = {
    "pcl": {"terrain/greedy.cpp", "identify/registration.cpp"},
    "ceres": {"estimation"},
    "vtk": set(),
    "CGAL": set(),
}


@pytest.mark.parametrize("library", HEAVY)
def test_heavy_dependencies_stay_in_their_room(library: str) -> None:
    for path in sources():
        if re.search(rf'#\s*include\s*[<"]{library}/', path.read_text("utf-8")):
            place = path.relative_to(MODULES).as_posix()
            assert path.suffix == ".cpp", f"{place}: {library} in a header"
            assert any(place == p or place.startswith(p + "/") for p in HEAVY[library]), place


def test_only_base_starts_threads() -> None:
    for path in sources():
        if path.relative_to(MODULES).parts[0] != "base":
            assert not re.search(r"#\s*include\s*<(thread|future|omp\.h)>", path.read_text("utf-8"))


def test_selection_knows_no_subject() -> None:
    """Arms, sonars and vehicles are models that it is given."""
    for path in sorted((MODULES / "selection").rglob("*.[hc]pp")):
        text = path.read_text("utf-8")
        rooms = set(re.findall(r'#\s*include\s*[<"]bathyal/(\w+)/', text))
        assert rooms <= {"base", "estimation", "selection"}, path.name
