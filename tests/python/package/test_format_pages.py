# SPDX-License-Identifier: BSD-3-Clause
"""The examples on the pages about file formats do what they show."""

from __future__ import annotations

import doctest
import re
from pathlib import Path

import pytest

PAGES = sorted((Path(__file__).resolve().parents[3] / "docs" / "formats").glob("*.md"))


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.stem)
def test_examples_on_the_page(page, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    if page.stem in ("las", "geotiff"):
        pytest.importorskip({"las": "lazrs", "geotiff": "rasterio"}[page.stem])
    blocks = re.findall(r"```python\n(.*?)```", page.read_text(encoding="utf-8"), re.DOTALL)
    test = doctest.DocTestParser().get_doctest("\n".join(blocks), {}, page.name, str(page), 0)
    results = doctest.DocTestRunner().run(test)
    assert results.failed == 0
    assert results.attempted > 0 or page.stem in ("bag", "index")
