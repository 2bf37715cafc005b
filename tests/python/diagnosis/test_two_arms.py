# SPDX-License-Identifier: BSD-3-Clause
"""What `docs/two_arms.md` shows: two chains on one base, each of which bears the other's load."""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any

import pytest

_PAGE = Path(__file__).parents[3] / "docs" / "two_arms.md"


def test_the_page_about_two_arms_says_what_happens() -> None:
    text = _PAGE.read_text(encoding="utf-8")
    names: dict[str, Any] = {}
    for block in re.findall(r"```python\n(.*?)```", text, re.DOTALL):
        exec(compile(block, str(_PAGE), "exec"), names)
    alone, both, data = names["alone"], names["both"], names["data"]
    assert alone.verdict == "unknown"
    assert "other_q" in alone.leftover.against
    assert both.verdict == "named"
    [found] = both.effects
    assert found.name == "shared_tilt"
    assert float(found.parameters["compliance_x"]) == pytest.approx(8e-6, rel=0.05)
    assert float(found.parameters["compliance_y"]) == pytest.approx(5e-6, rel=0.05)
    tips = both.model.forward(data.q, covariates={"other_q": data.covariates["other_q"]})
    assert ((tips[:, :3, 3] - data.position) ** 2).mean() ** 0.5 < 3.3e-5
