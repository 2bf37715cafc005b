# SPDX-License-Identifier: BSD-3-Clause
"""Logs of runs as another reader sees them: PyPI's mcap, with checksums, index and schemas."""

from __future__ import annotations

import hashlib
import json
import shutil
import subprocess
from collections import Counter, defaultdict
from typing import Any

import numpy as np
import pytest

import bathyal
from bathyal._core import mcap_messages, write_mcap

SHORT = """\
world: {water: {surface: 0}, terrain: {seabed: {size: [60, 60], spacing: 1, depth: 10}}}
vehicle: {preset: bluerov2_heavy}
mission: [dive: {depth: 2 m}, wait: {time: 5 s}]
"""


@pytest.fixture(scope="module")
def run(tmp_path_factory):
    folder = tmp_path_factory.mktemp("run")
    (folder / "mission.yaml").write_text(SHORT)
    bathyal.run(folder / "mission.yaml", seed=2, out=folder / "out")
    return folder / "out"


def test_another_reader_finds_the_same_messages(run):
    reader = pytest.importorskip("mcap.reader")
    ours = bathyal.read_run(run).log
    with (run / "log.mcap").open("rb") as stream:
        other = reader.make_reader(stream, validate_crcs=True)
        counts: dict[str, int] = {}
        for schema, channel, message in other.iter_messages():
            counts[channel.topic] = counts.get(channel.topic, 0) + 1
            properties = json.loads(schema.data)["properties"]
            assert set(json.loads(message.data)) <= set(properties), channel.topic
        summary = other.get_summary()
        position = [
            json.loads(message.data)["pose"]["position"]["z"]
            for _, _, message in other.iter_messages(topics=["/truth"])
        ]
    assert summary.statistics.message_count == sum(counts.values())
    assert sorted(counts) == ours.topics
    assert ours.broken_off == ""
    np.testing.assert_array_equal(ours.messages("/truth")["pose.position.z"], position)


NODE = """
const { createHash } = require("node:crypto");
const { readFileSync } = require("node:fs");
const { McapIndexedReader, McapStreamReader } = require("@mcap/core");
const bytes = readFileSync(process.argv[2]);

function streamed() {
  const reader = new McapStreamReader({ validateCrcs: true });
  const topics = new Map(), hashes = {};
  reader.append(bytes);
  for (let record; (record = reader.nextRecord()); ) {
    if (record.type === "Channel") topics.set(record.id, record.topic);
    if (record.type !== "Message") continue;
    const topic = topics.get(record.channelId);
    (hashes[topic] ??= createHash("sha256")).update(record.data);
  }
  if (!reader.done()) throw new Error("the file breaks off");
  return Object.fromEntries(Object.entries(hashes).map(([topic, h]) => [topic, h.digest("hex")]));
}

async function indexed() {
  const readable = {
    size: async () => BigInt(bytes.length),
    read: async (from, size) => bytes.subarray(Number(from), Number(from + size)),
  };
  const reader = await McapIndexedReader.Initialize({ readable });
  const counts = {};
  for await (const message of reader.readMessages()) {
    const topic = reader.channelsById.get(message.channelId).topic;
    counts[topic] = (counts[topic] ?? 0) + 1;
  }
  return counts;
}

indexed().then((counts) => console.log(JSON.stringify({ hashes: streamed(), counts })));
"""


@pytest.fixture(scope="module")
def node(tmp_path_factory):
    """A folder with npm's @mcap/core and the program above."""
    if not (shutil.which("node") and shutil.which("npm")):
        pytest.skip("node and npm are not installed")
    folder = tmp_path_factory.mktemp("node")
    command = ["npm", "install", "--prefix", str(folder), "--no-audit", "--no-fund"]
    try:
        done = subprocess.run([*command, "@mcap/core@2.2.2"], capture_output=True, timeout=60)
    except subprocess.TimeoutExpired:
        pytest.skip("npm's registry does not answer")
    if done.returncode != 0:
        pytest.skip(f"npm cannot install @mcap/core: {done.stderr.decode()[-200:]}")
    (folder / "read.js").write_text(NODE)
    return folder


def test_npms_reader_finds_the_same_messages(run, node):
    command = ["node", str(node / "read.js"), str(run / "log.mcap")]
    found = json.loads(subprocess.run(command, capture_output=True, check=True).stdout)
    hashes: dict[str, Any] = defaultdict(hashlib.sha256)
    counts: Counter[str] = Counter()
    for topic, data in mcap_messages((run / "log.mcap").read_bytes()):
        hashes[topic].update(data)
        counts[topic] += 1
    assert found["counts"] == counts
    assert found["hashes"] == {topic: one.hexdigest() for topic, one in hashes.items()}


def test_messages_of_a_time_are_found_by_the_index(run):
    reader = pytest.importorskip("mcap.reader")
    with (run / "log.mcap").open("rb") as stream:
        found = list(
            reader.make_reader(stream).iter_messages(
                topics=["/state"], start_time=int(2e9), end_time=int(3e9)
            )
        )
    assert len(found) == 10


def test_a_cut_log_gives_what_is_whole(run, tmp_path):
    whole = (run / "log.mcap").read_bytes()
    path = tmp_path / "log.mcap"
    path.write_bytes(whole[: len(whole) // 2])
    log = bathyal.RunLog(path)
    assert log.broken_off != ""
    rows = log.messages("/truth")["time"]
    assert 5 < len(rows) < len(bathyal.read_run(run).log.messages("/truth")["time"])


def test_bytes_that_are_no_log_are_refused(tmp_path):
    path = tmp_path / "log.mcap"
    path.write_bytes(b"no log")
    with pytest.raises(bathyal.Error, match="MCAP"):
        _ = bathyal.RunLog(path).topics


def test_poses_are_those_of_the_log(run):
    log = bathyal.read_run(run).log
    poses = log.poses("/truth")
    rotation = poses[:, :3, :3]
    product = rotation @ rotation.transpose(0, 2, 1)
    np.testing.assert_allclose(product, np.broadcast_to(np.eye(3), product.shape), atol=1e-12)
    np.testing.assert_array_equal(poses[:, 2, 3], log.messages("/truth")["pose.position.z"])
    assert bathyal.Trajectory(log.messages("/truth")["time"], poses)


def test_topics_are_written_as_tables(run, tmp_path):
    parquet = pytest.importorskip("pyarrow.parquet")
    log = bathyal.read_run(run).log
    paths = log.to_parquet(tmp_path / "tables")
    assert "sensors_dvl" in {path.stem for path in paths}
    for topic, path in zip(log.topics, paths, strict=True):
        table, wanted = parquet.read_table(path), log.messages(topic)
        assert table.column_names == list(wanted)
        for name, values in wanted.items():
            found = table[name].to_pylist()
            if values.dtype.kind == "f":
                np.testing.assert_array_equal(np.array(found, dtype=float), values)
            else:
                assert found == values.tolist()


def test_messages_are_written_as_another_reader_reads_them(tmp_path):
    reader = pytest.importorskip("mcap.reader")
    messages = [(f"/t{row % 3}", 2**63 + row, b"x" * (row % 700)) for row in range(5000)]
    path = tmp_path / "log.mcap"
    write_mcap(str(path), messages)
    with path.open("rb") as stream:
        other = reader.make_reader(stream, validate_crcs=True)
        found = [
            (channel.topic, message.log_time, message.data)
            for _, channel, message in other.iter_messages(log_time_order=False)
        ]
    assert found == messages


@pytest.mark.parametrize(
    ("message", "error"),
    [
        (("/a", 1), ValueError),
        (["/a", 1, b""], ValueError),
        ((b"/a", 1, b""), TypeError),
        (("/a", 1.5, b""), TypeError),
        (("/a", -1, b""), OverflowError),
        (("/a", 1 << 64, b""), OverflowError),
        (("/a", 1, "text"), TypeError),
    ],
)
def test_messages_that_are_none_are_refused(tmp_path, message, error):
    with pytest.raises(error):
        write_mcap(str(tmp_path / "log.mcap"), [("/a", 0, b"{}"), message])
