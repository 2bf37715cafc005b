# SPDX-License-Identifier: BSD-3-Clause
"""Logs of runs as another reader sees them: PyPI's mcap, with checksums, index and schemas."""

from __future__ import annotations

import json

import numpy as np
import pytest

import bathyal

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
