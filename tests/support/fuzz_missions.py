# SPDX-License-Identifier: BSD-3-Clause
"""Mission files that somebody, or something, has damaged.

    python -m tests.support.fuzz_missions 100000

Each is read and checked against its schema; what comes is a mission or `bathyal.Error`.
"""

from __future__ import annotations

import random
import sys
import tempfile
import warnings
from pathlib import Path

import bathyal
from bathyal.io.yaml_documents import read_yaml
from bathyal.io.yaml_schema import validated
from bathyal.mission.example import write_mission_example
from bathyal.mission.sections import MissionSections

TOKENS = [
    "{", "}", "[", "]", ":", "- ", "&a ", "*a", "!!python/object ", "null", "~", "nan", ".inf",
    "-1", "1e999", "0x10", "true", "'", '"', "|\n", ">\n", "\t", "\0", "\u2028", "\ufeff", "#",
    "%YAML 9\n", "---\n", "<<: ", "7 min", "depth > 3 m", "dive", "surface", "../../etc/passwd",
    "9" * 400,
]  # fmt: skip


def damaged(text: str, source: random.Random) -> bytes:
    """With one to six changes: tokens put in, parts cut, doubled or moved, bytes turned."""
    for _ in range(source.randint(1, 6)):
        i, j = sorted(source.randrange(len(text) + 1) for _ in range(2))
        j = min(j, i + source.choice([1, 5, 40]))
        kind = source.randrange(5)
        if kind == 0:
            text = text[:i] + source.choice(TOKENS) + text[i:]
        elif kind == 1:
            text = text[:i] + text[j:]
        elif kind == 2:
            text = text[:j] + text[i:j] + text[j:]
        elif kind == 3:
            lines = text.splitlines(keepends=True)
            a, b = source.randrange(len(lines)), source.randrange(len(lines))
            lines[a], lines[b] = lines[b], lines[a]
            text = "".join(lines)
        else:
            text = text[:i] + source.choice(TOKENS) + text[j:]
        text = text or "a"
    data = bytearray(text.encode("utf-8", "surrogatepass"))
    if source.random() < 0.2:
        data[source.randrange(len(data))] = source.randrange(256)
    return bytes(data)


def read_damaged(count: int, seed: int) -> int:
    """How many were missions all the same. Raises what is not `bathyal.Error`."""
    source, taken = random.Random(seed), 0
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "mission.yaml"
        write_mission_example(path)
        text = path.read_text()
        for number in range(count):
            data = damaged(text, source)
            path.write_bytes(data)
            try:
                validated(MissionSections, read_yaml(path))
                taken += 1
            except bathyal.Error:
                pass
            except Exception as error:
                raise AssertionError(f"number {number} of seed {seed}: {data!r}") from error
    return taken


if __name__ == "__main__":
    warnings.simplefilter("ignore")
    total = int(sys.argv[1])
    print(read_damaged(total, seed=1), "of", total, "were missions all the same")
