# SPDX-License-Identifier: BSD-3-Clause
"""What tests of more than one file ask for."""

from __future__ import annotations

from pathlib import Path

import pytest


@pytest.fixture
def write(tmp_path: Path):
    def write_file(content: str | bytes, name: str = "f.xyz") -> Path:
        path = tmp_path / name
        path.write_bytes(content.encode() if isinstance(content, str) else content)
        return path

    return write_file
