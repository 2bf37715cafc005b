# SPDX-License-Identifier: BSD-3-Clause
"""What a result was made from, and the steps in which a job reports its progress."""

from __future__ import annotations

import hashlib
from collections.abc import Callable
from contextlib import AbstractContextManager
from pathlib import Path
from typing import Any

from bathyal.io.files import PathLike, opened, shown

Step = Callable[[str], AbstractContextManager[Any]]


def file_facts(path: PathLike) -> dict[str, Any]:
    digest = hashlib.sha256()
    with opened(path) as (stream, _):
        while block := stream.read(1 << 20):
            digest.update(block)
        size = stream.tell()
    return {"file": shown(Path(path).name), "bytes": size, "sha256": digest.hexdigest()}
