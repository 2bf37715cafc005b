# SPDX-License-Identifier: BSD-3-Clause
"""What the README and the pages of the documentation tell a reader to type works as it is.

Each page is followed from top to bottom in a folder of its own: shell lines that begin with
`bathyal` must end well, Python is executed and, where it is
a session, says what is shown, tables of aims and of touches are the file that the
page names, and what is shown of the program's words must have been said. The pages on file formats
are doctests (test_format_pages.py).
"""

from __future__ import annotations

import doctest
import re
import shlex
from pathlib import Path

import pytest

from tests.support.command import bathyal_run

ROOT = Path(__file__).resolve().parents[3]
PAGES = [ROOT / "README.md", *sorted((ROOT / "docs").glob("*.md"))]
CONSUMER = ROOT / "tests" / "cpp" / "consumer"
# What a reader types that needs a machine of its own; `make test` and CI do it there.
NOT_RUN_HERE = ("make ", "pip install ", "sudo apt-get install ", "cmake ")
AIMS_HEADER = "px_m,py_m,pz_m,dx,dy,dz\n"
TABLES = {AIMS_HEADER: "aims.csv", "point,q1_deg,": "touches.csv"}  # by how they begin


def fragments(page: Path) -> list[tuple[str, str]]:
    """Language and text of every fenced block."""
    text = page.read_text(encoding="utf-8")
    return re.findall(r"^```(\w+)\n(.*?)^```$", text, re.MULTILINE | re.DOTALL)


def shell_lines(text: str) -> list[list[str]]:
    """What is typed after each prompt, with `bathyal` wherever it is installed."""
    lines = re.findall(r"^\$ (.*)$", text, re.MULTILINE)
    return [
        shlex.split(line.replace(".venv/bin/bathyal", "bathyal"), comments=True) for line in lines
    ]


def run(words: list[str], folder: Path) -> str:
    """What `bathyal …` says in addition to its results."""
    done = bathyal_run(*words[1:], cwd=folder)
    assert done.returncode == 0, (words, done.stderr)
    return done.stderr


def write_shown_aims(blocks: list[tuple[str, str]], folder: Path) -> None:
    """The reader's own aims.csv: the table that the page shows, unless it has the program make one
    (then the table shown must be the one made)."""
    if not any(kind == "console" and "--aims-out" in text for kind, text in blocks):
        for _, text in blocks:
            if text.startswith(AIMS_HEADER):
                (folder / "aims.csv").write_text(text)


def follow(blocks: list[tuple[str, str]], folder: Path) -> None:
    said = ""
    names: dict[str, object] = {}
    for kind, text in blocks:
        if kind == "console":
            for words in shell_lines(text):
                if words[0] == "bathyal":
                    said = run(words, folder)
                else:
                    assert " ".join(words).startswith(NOT_RUN_HERE), words
        elif kind == "python" and text.startswith(">>>"):
            session = doctest.DocTestParser().get_doctest(text, names, folder.name, None, None)
            assert doctest.DocTestRunner().run(session, clear_globs=False).failed == 0
            names.update(session.globs)
        elif kind == "python":
            exec(compile(text, f"python of {folder.name}", "exec"), names)
        elif kind == "text" and text.startswith(tuple(TABLES)):
            name = next(name for header, name in TABLES.items() if text.startswith(header))
            kept = (folder / name).read_text().splitlines()
            assert set(text.splitlines()) <= set(kept)
        elif kind == "text":
            assert text == said
        elif kind == "yaml":
            assert text in [file.read_text() for file in folder.rglob("*.yaml")]
        else:
            assert kind in ("cpp", "cmake")


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.stem)
def test_page_does_what_it_says(
    page: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    blocks = fragments(page)
    monkeypatch.chdir(tmp_path)
    write_shown_aims(blocks, tmp_path)
    follow(blocks, tmp_path)


def test_there_are_fragments_of_each_kind() -> None:
    kinds = {kind for page in PAGES for kind, _ in fragments(page)}
    assert kinds == {"cmake", "console", "cpp", "python", "text", "yaml"}


@pytest.mark.parametrize(
    ("page", "kind", "file"),
    [("README.md", "cpp", "main.cpp"), ("docs/install.md", "cmake", "CMakeLists.txt")],
)
def test_shown_cpp_and_cmake_are_those_that_are_built(page: str, kind: str, file: str) -> None:
    """Against an install tree, by the C++ test install_tree."""
    shown = [text for block, text in fragments(ROOT / page) if block == kind]
    licence, built = (CONSUMER / file).read_text(encoding="utf-8").split("\n", 1)
    assert "SPDX" in licence
    assert shown == [built]
