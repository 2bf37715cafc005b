# SPDX-License-Identifier: BSD-3-Clause
"""What a person sees of a result first: a verdict, a few numbers with units, the next step."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

MOST_NUMBERS = 5
_LONGEST = 160  # characters of a warning on the screen


@dataclass(frozen=True)
class Brief:
    """The first sight of a result; ``str()`` gives its lines.

    Attributes
    ----------
    verdict : str
        One sentence.
    numbers : mapping of str to str
        What each number is, and the number with its unit; `MOST_NUMBERS` or fewer.
    next : str
        One sentence: what to do.

    Examples
    --------
    >>> print(Brief("Clean: nothing beyond noise.", {"noise": "0.085 mm", "poses": "63"}, "Go on."))
    Clean: nothing beyond noise.
      noise  0.085 mm
      poses  63
    Next: go on.
    """

    verdict: str
    numbers: Mapping[str, str]
    next: str

    def __str__(self) -> str:
        width = max(map(len, self.numbers), default=0)
        rows = [f"  {name:<{width}}  {value}" for name, value in self.numbers.items()]
        return "\n".join([self.verdict, *rows, f"Next: {self.next[:1].lower()}{self.next[1:]}"])


def short_warnings(warnings: list[str], most: int = 2) -> list[str]:
    """The first warnings, each by its first sentence, and the number of the others."""
    shown = [_first_sentence(warning) for warning in warnings[:most]]
    rest = len(warnings) - len(shown)
    return shown + ([f"{rest} more, in report.html"] if rest else [])


def _first_sentence(text: str) -> str:
    end = text.find(". ")
    text = text if end < 0 else text[: end + 1]
    return text if len(text) <= _LONGEST else f"{text[: _LONGEST - 1].rstrip()}…"
