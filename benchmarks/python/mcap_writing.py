# SPDX-License-Identifier: BSD-3-Clause
"""Writing a log: our MCAP writer and that of PyPI's ``mcap``, without compression.

    python -m benchmarks.python.mcap_writing

The messages of a survey of ten minutes. Both files are read by PyPI's reader with checksums and
must hold the same messages before any time is printed.
"""

from __future__ import annotations

import statistics
import tempfile
import time
from pathlib import Path

from mcap.reader import make_reader
from mcap.writer import CompressionType, Writer

import bathyal
from bathyal._core import mcap_messages, write_mcap
from benchmarks.python.mission_speed import SURVEY

ROUNDS = 21
PEER = "PyPI's mcap"
Messages = list[tuple[str, int, bytes]]


def ours(path: Path, messages: Messages) -> None:
    write_mcap(str(path), messages)


def theirs(path: Path, messages: Messages) -> None:
    with path.open("wb") as stream:
        writer = Writer(stream, chunk_size=1 << 18, compression=CompressionType.NONE)
        writer.start()
        channels: dict[str, int] = {}
        for topic, at, data in messages:
            if topic not in channels:
                channels[topic] = writer.register_channel(topic, "json", 0)
            writer.add_message(channels[topic], log_time=at, publish_time=at, data=data)
        writer.finish()


def read(path: Path) -> Messages:
    with path.open("rb") as stream:
        reader = make_reader(stream, validate_crcs=True)
        found = reader.iter_messages(log_time_order=False)
        return [(channel.topic, message.log_time, message.data) for _, channel, message in found]


def main() -> None:
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        (folder / "mission.yaml").write_text(SURVEY.replace("1 h", "10 min"))
        log = bathyal.run(folder / "mission.yaml", seed=1).log.path
        rows = mcap_messages(log.read_bytes())
        messages = [(topic, row * 1_000_000, data) for row, (topic, data) in enumerate(rows)]
        size = sum(len(data) for _, _, data in messages)
        times: dict[str, list[float]] = {"ours": [], PEER: []}
        for _ in range(ROUNDS):
            for who, write in (("ours", ours), (PEER, theirs)):
                path = folder / f"{who}.mcap"
                path.unlink(missing_ok=True)  # else the time counts that of cutting the last one
                begun = time.perf_counter()
                write(path, messages)
                times[who].append(time.perf_counter() - begun)
        assert read(folder / "ours.mcap") == read(folder / f"{PEER}.mcap") == messages
        print(f"{len(messages):,} messages, {size / 1e6:.0f} MB")
        medians = {who: statistics.median(found) for who, found in times.items()}
        for who, median in medians.items():
            rate = len(messages) / median
            print(f"| {who} | {1e3 * median:.0f} ms | {rate / 1e3:,.0f} thousand messages/s |")
        print(f"ratio {medians[PEER] / medians['ours']:.1f}")


if __name__ == "__main__":
    main()
