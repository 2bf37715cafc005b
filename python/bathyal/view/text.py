# SPDX-License-Identifier: BSD-3-Clause
"""Numbers as they are printed, and the grammar of sentences that are put together."""

from __future__ import annotations

from collections.abc import Sequence


def listed(texts: Sequence[str], between: str = ", ", last: str = " and ") -> str:
    """Texts in a row, with "and" before the last."""
    if len(texts) < 2:
        return "".join(texts)
    last = f"{between.rstrip()}{last}" if between != ", " else last
    return f"{between.join(texts[:-1])}{last}{texts[-1]}"


def counted(count: int, what: str) -> str:
    """A number of things: "1 block", "20 blocks"."""
    return f"{count:,} {what}{'' if count == 1 else 's'}"


def bare(text: str) -> str:
    """A sentence without its stop, to go on from."""
    return text.strip().rstrip(".")


def upper(text: str) -> str:
    """With a capital first letter."""
    return text[:1].upper() + text[1:]


def lower(text: str) -> str:
    """With a small first letter."""
    return text[:1].lower() + text[1:]


def sentence(text: str) -> str:
    """With a capital and a stop."""
    text = upper(text.strip())
    return text if text.endswith((".", "!", "?")) else f"{text}."


def number(value: float, digits: int = 3, sign: str = "") -> str:
    """A number as it is printed: with a true minus, and no minus before zeros."""
    text = f"{value:{sign}.{digits}f}"
    if not text.strip("+-0."):
        text = text.lstrip("+-")
    return text.replace("-", "−")
