# SPDX-License-Identifier: BSD-3-Clause
"""Prose uses the field's terms: no comment, docstring, page or report uses a word of
CONTRIBUTING.md's list of words no longer used."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

import bathyal
from bathyal.diagnosis.files import write_diagnosis
from bathyal.diagnosis.report.advice import next_steps
from bathyal.diagnosis.report.text import summary
from bathyal.identify.report.page import write_page
from bathyal.identify.report.text import next_touches, surely_text
from tests.support import diagnosis_cases, prose
from tests.support.touch_jobs import simulated, with_distance

ROOT = Path(__file__).parents[3]
LIST = "Words no longer used"
FOLDERS = ("cpp", "python", "tests", "benchmarks", "docs")
PAGES = ("README.md", "CHANGELOG.md", "CONTRIBUTING.md", "ARCHITECTURE.md")
SUFFIXES = (".py", ".hpp", ".cpp", ".md")
EXCEPTIONS = {
    "tests/python/package/test_words.py": "holds words of the list as examples",
}


def listed() -> dict[str, str]:
    """Word → term, from the table in CONTRIBUTING.md."""
    text = (ROOT / "CONTRIBUTING.md").read_text(encoding="utf-8")
    rows = re.findall(r"^\| ([^|]+) \| ([^|]+) \|$", text.split(LIST, 1)[1], re.M)[1:]
    return {word.strip(): term for words, term in rows for word in words.split(",")}


WORDS = listed()
PATTERN = re.compile(rf"\b({'|'.join(map(re.escape, WORDS))})\b", re.I)


def found(lines: prose.Lines, where: str) -> list[str]:
    """Each use of a listed word: where, the word, what to write."""
    return [
        f"{where}:{number}: {word!r}, write: {WORDS[word.lower()]}"
        for number, line in lines
        for word in PATTERN.findall(line)
    ]


def sources(folder: str) -> list[Path]:
    """Without rounds of hidden cases, which keep their hashes."""
    return sorted(
        path
        for path in (ROOT / folder).rglob("*")
        if path.suffix in SUFFIXES and not {"_build", "rounds"} & set(path.parts)
    )


def test_the_list_is_read() -> None:
    assert {"told", "foretold", "beside", "left over", "rivals"} <= WORDS.keys()
    assert all(word == word.lower() and WORDS[word] for word in WORDS)


@pytest.mark.parametrize(
    ("lines", "numbers"),
    [
        (prose.of_python('x = 1  # told\n"""A\nrival."""\ntold = "luck", "bad luck"\n'), [1, 3, 4]),
        (prose.of_python('f"{told.rival} of {n} is luck"\n'), [1]),
        (prose.of_python("def is_told():\n    pass\n", names=True), [1]),
        (prose.of_cpp('/// Told.\nint told;  /* a\nrival */ f("luck", "by luck");'), [1, 3, 3]),
        (prose.of_cpp('auto c = \'"\'; g(R"doc(One\ntwin)doc");'), [2]),
        (prose.of_markdown("A\n```\ntold\n```\nrivals, `told`, [luck](beside.md)\n"), [5, 5]),
        (prose.of_html("<style>.told {}</style><p title='luck'>x</p><b>Told</b>"), [1, 3]),
    ],
    ids=["python", "f_string", "names", "cpp", "raw_string", "markdown", "html"],
)
def test_prose_is_read_and_code_is_not(lines: prose.Lines, numbers: list[int]) -> None:
    assert [int(use.split(":")[1]) for use in found(lines, "f")] == numbers


@pytest.mark.parametrize("folder", FOLDERS)
def test_sources_use_the_fields_terms(folder: str) -> None:
    uses = []
    for path in sources(folder):
        name = path.relative_to(ROOT).as_posix()
        if name not in EXCEPTIONS:
            uses += found(prose.of_file(path, names=folder == "tests"), name)
    assert not uses, "\n".join(uses)


@pytest.mark.parametrize("page", PAGES)
def test_pages_use_the_fields_terms(page: str) -> None:
    text = (ROOT / page).read_text(encoding="utf-8")
    text = re.sub(rf"\*\*{LIST}.*?(?=\n\*\*|\Z)", "", text, flags=re.DOTALL)  # the list itself
    uses = found(prose.of_markdown(text), page)
    assert not uses, "\n".join(uses)


@pytest.mark.parametrize("case", diagnosis_cases.CASES)
def test_report_of_a_diagnosis_uses_the_fields_terms(case: str, tmp_path: Path) -> None:
    report = diagnosis_cases.CASES[case]()
    write_diagnosis(report, tmp_path / "report.html")
    uses = found(prose.of_html((tmp_path / "report.html").read_text("utf-8")), "report.html")
    uses += found(enumerate([summary(report), *next_steps(report)]), "summary")
    assert not uses, "\n".join(uses)


@pytest.mark.parametrize("known", [False, True], ids=["touches", "with_a_distance"])
def test_report_of_an_identification_uses_the_fields_terms(known: bool, tmp_path: Path) -> None:
    made = simulated()
    data = with_distance(made) if known else made.touches
    fit = bathyal.identify_arm(bathyal.arms.ur10e(), data)
    write_page(fit, data, tmp_path / "report.html")
    uses = found(prose.of_html((tmp_path / "report.html").read_text("utf-8")), "report.html")
    uses += found(enumerate([str(fit), surely_text(fit), *next_touches(fit, data)]), "summary")
    assert not uses, "\n".join(uses)
