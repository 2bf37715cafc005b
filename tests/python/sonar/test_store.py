# SPDX-License-Identifier: BSD-3-Clause
"""Surveys in folders: halves that join, interruption, full disks, other readers, broken files."""

from __future__ import annotations

import hashlib
import json
import shutil
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

import bathyal
from bathyal.io.formats.zarr_arrays import StoredArray
from bathyal.sonar import store as stores
from tests.support import seas

SONAR = seas.small_side_scan(
    spreading=True, speckle=True, noise=True, dropout_rate=0.1, bits=12, full_scale=-70.0,
    ping_rate=10.0, samples=200, rays_along_fan=400,
)  # fmt: skip
ERRORS = bathyal.NavigationErrors.preset("usbl")
PINGS = 101  # of 20 m at 2 m/s


@pytest.fixture(autouse=True)
def small_chunks(monkeypatch) -> None:
    monkeypatch.setattr(stores, "_MOST_ROWS", 16)


def fly(**options) -> bathyal.SonarRecord:
    options = {"seed": 3, "navigation": ERRORS, **options}
    return SONAR.survey(seas.flat_world(), seas.line(20.0), **options)


def digest(folder: Path) -> str:
    """Of all files and their names."""
    total = hashlib.sha256()
    for file in sorted(folder.rglob("*")):
        if file.is_file():
            total.update(str(file.relative_to(folder)).encode() + file.read_bytes())
    return total.hexdigest()


def same(one: bathyal.SonarRecord, other: bathyal.SonarRecord) -> bool:
    """All columns, bit by bit."""
    pairs = [(one.time, other.time), (one.intensity, other.intensity), (one.range, other.range)]
    for name in ("position", "heading", "pitch", "roll", "depth", "altitude", "speed"):
        pairs.append((getattr(one.navigation, name), getattr(other.navigation, name)))
    if one.truth is not None:
        for name in ("range", "incidence", "material", "point", "pose"):
            pairs.append((getattr(one.truth, name), getattr(other.truth, name)))
    equal = all(np.array_equal(np.asarray(a), np.asarray(b), equal_nan=True) for a, b in pairs)
    return equal and all(
        getattr(one, name) == getattr(other, name) for name in ("beam_names", "sonar", "warnings")
    )


@pytest.mark.parametrize("truth", [False, True])
def test_a_folder_holds_what_memory_holds(truth: bool, tmp_path) -> None:
    kept = fly(truth=truth, out=tmp_path / "a.zarr")
    assert len(kept) == PINGS
    assert same(kept, fly(truth=truth))
    assert same(bathyal.read_sonar(tmp_path / "a.zarr"), kept)
    assert any("dropped out" in text for text in kept.warnings)
    assert any("full scale" in text for text in kept.warnings)
    assert isinstance(kept.intensity, StoredArray)
    assert kept.plot().axes


def test_two_processes_write_halves_that_join_to_the_bytes_of_the_whole(tmp_path) -> None:
    fly(out=tmp_path / "whole.zarr")
    code = """
import sys
from bathyal.sonar import store
store._MOST_ROWS = 16
from tests.python.sonar.test_store import fly
fly(out=sys.argv[1], first=int(sys.argv[2]), count=int(sys.argv[3]))
"""
    halves = tmp_path / "halves.zarr"
    root = Path(__file__).parents[3]
    running = [
        subprocess.Popen([sys.executable, "-c", code, str(halves), *part], cwd=root)
        for part in (("0", "45"), ("45", "-1"))
    ]
    assert [one.wait(timeout=120) for one in running] == [0, 0]
    assert digest(halves) == digest(tmp_path / "whole.zarr")


def test_an_interrupted_survey_is_read_and_continued(tmp_path) -> None:
    fly(out=tmp_path / "whole.zarr")
    part = tmp_path / "part.zarr"
    record = fly(out=part, progress=lambda done, total: done < 23)
    assert len(record) == 23
    assert "of 101 pings 23 are there" in record.warnings[0]

    def interrupt(done: int, total: int) -> bool:
        if done == 60:
            raise KeyboardInterrupt
        return True

    with pytest.raises(KeyboardInterrupt):
        fly(out=part, progress=interrupt)
    read = bathyal.read_sonar(part)
    assert len(read) == 60
    assert np.array_equal(read.intensity, fly(count=60).intensity)
    seen = []
    fly(out=part, progress=lambda done, total: seen.append((done, total)))
    assert seen[0] == (61, 101)
    assert seen[-1] == (101, 101)
    assert digest(part) == digest(tmp_path / "whole.zarr")


@pytest.mark.parametrize("num_threads", [1, 3])
def test_a_part_is_that_of_the_whole(num_threads: int, tmp_path) -> None:
    part = fly(first=37, count=20, num_threads=num_threads, out=tmp_path / "part.zarr")
    whole = fly()
    assert np.array_equal(part.time, whole.time[37:57])
    assert np.array_equal(part.intensity, whole.intensity[37:57])
    assert np.array_equal(part.navigation.position, whole.navigation.position[37:57])
    assert np.array_equal(part.navigation.altitude, whole.navigation.altitude[37:57])
    in_memory = fly(first=37, count=20)
    assert np.array_equal(in_memory.intensity, part.intensity)
    assert np.array_equal(in_memory.navigation.heading, part.navigation.heading)


def test_on_a_full_disk_what_was_written_stays(tmp_path) -> None:
    code = """
import resource, sys
from bathyal.sonar import store
store._MOST_ROWS = 16
from bathyal.io.formats import zarr_arrays
from tests.python.sonar.test_store import fly
def progress(done, total):
    if done == 40:  # 200 bytes a file from here on: as on a full disk, writing fails
        resource.setrlimit(resource.RLIMIT_FSIZE, (200, resource.RLIM_INFINITY))
fly(out=sys.argv[1], progress=progress)
"""
    out = tmp_path / "full.zarr"
    root = Path(__file__).parents[3]
    done = subprocess.run(
        [sys.executable, "-c", code, str(out)], cwd=root, capture_output=True, text=True
    )
    assert done.returncode != 0
    assert "OSError" in done.stderr
    assert "full.zarr/" in done.stderr
    assert not [file for file in out.rglob(".*.*") if file.name.count(".") > 1]
    record = bathyal.read_sonar(out)
    assert len(record) == 32
    assert np.array_equal(record.intensity, fly(count=32).intensity)
    assert len(fly(out=out)) == PINGS


@pytest.mark.parametrize(
    ("change", "message"),
    [
        (lambda: {"seed": 4}, "survey.seed"),
        (lambda: {"truth": True}, "survey.truth"),
        (lambda: {"navigation": bathyal.NavigationErrors()}, "survey.navigation.depth_bias"),
    ],
)
def test_surveys_are_not_mixed(change, message: str, tmp_path) -> None:
    out = tmp_path / "a.zarr"
    fly(out=out, count=10)
    before = digest(out)
    with pytest.raises(ValueError, match=message):
        fly(out=out, **change())
    louder = SONAR.replace(source_level=220.0)
    with pytest.raises(ValueError, match=r"sonar\.source_level"):
        louder.survey(seas.flat_world(), seas.line(20.0), seed=3, navigation=ERRORS, out=out)
    with pytest.raises(ValueError, match=r"survey\.trajectory"):
        SONAR.survey(seas.flat_world(), seas.line(20.0, z=9), seed=3, navigation=ERRORS, out=out)
    with pytest.raises(ValueError, match=r"survey\.world"):
        SONAR.survey(
            seas.flat_world(material="mud"), seas.line(20.0), seed=3, navigation=ERRORS, out=out
        )
    assert digest(out) == before


def test_a_folder_of_anything_else_is_refused(tmp_path) -> None:
    (tmp_path / "notes.txt").write_text("mine")
    with pytest.raises(ValueError, match="`out`: expected a new folder"):
        fly(out=tmp_path)
    with pytest.raises(bathyal.Error, match="no sonar record"):
        bathyal.read_sonar(tmp_path)
    assert (tmp_path / "notes.txt").read_text() == "mine"
    (tmp_path / "empty").mkdir()
    assert len(fly(out=tmp_path / "empty", count=3)) == 3
    for first, count in ((-1, 3), (0, 102), (102, -1), (0, -2)):
        with pytest.raises(ValueError, match=r"`(first|count)`: expected"):
            fly(first=first, count=count)


def test_indexing_reads_as_numpy_does(tmp_path) -> None:
    stored = fly(truth=True, out=tmp_path / "a.zarr").truth.point
    array = np.asarray(stored)
    assert (stored.shape, stored.ndim, stored.size) == (array.shape, array.ndim, array.size)
    mask = np.zeros(PINGS, bool)
    mask[[3, 50, 51]] = True
    keys = [
        0, -1, np.int64(40), slice(None), slice(10, 40, 7), slice(None, None, -3), slice(5, 5),
        [5, 90, 5], mask, (5, 1), (slice(20, 40), 0, slice(3)), ([1, 2], [0, 1], [5, 6]),
        (slice(3), [0, 1], [5, 6]), ..., (..., 2), (3, ..., 0), (mask, ..., 1), (None, 4),
        np.array([[1, 2], [60, 4]]), (),
    ]  # fmt: skip
    for key in keys:
        assert np.array_equal(stored[key], array[key], equal_nan=True), key
    with pytest.raises(IndexError):
        stored[PINGS]
    assert np.array_equal(stored + 1.0, array + 1.0, equal_nan=True)
    assert np.array_equal(np.isnan(stored), np.isnan(array))
    assert "StoredArray((101, 2, 200, 3)" in repr(stored)


def test_a_record_of_any_file_is_written_as_a_folder(tmp_path) -> None:
    record = fly(truth=True)
    record.write(tmp_path / "copy.zarr")
    assert same(bathyal.read_sonar(tmp_path / "copy.zarr"), record)
    with pytest.raises(ValueError, match="not there yet"):
        record.write(tmp_path / "copy.zarr")
    record.write(tmp_path / "copy.xtf")
    read = bathyal.read_sonar(tmp_path / "copy.xtf")
    read.write(tmp_path / "again.zarr")
    again = bathyal.read_sonar(tmp_path / "again.zarr")
    assert np.array_equal(again.intensity, read.intensity)
    assert again.start == read.start
    multibeam = bathyal.sonars.multibeam().replace(beams=4, samples=50)
    record = multibeam.survey(seas.flat_world(), seas.line(1.0))
    record.write(tmp_path / "multibeam.zarr")
    assert same(bathyal.read_sonar(tmp_path / "multibeam.zarr"), record)


def test_other_programs_open_a_folder(tmp_path) -> None:
    zarr = pytest.importorskip("zarr", reason="zarr is not installed")
    record = fly(truth=True, out=tmp_path / "a.zarr")
    group = zarr.open_group(tmp_path / "a.zarr", mode="r")
    assert np.array_equal(group["intensity"][:], record.intensity)
    assert np.array_equal(group["truth_point"][:], record.truth.point, equal_nan=True)
    assert group["intensity"].attrs["_ARRAY_DIMENSIONS"] == ["ping", "beam", "sample"]
    assert group["truth_range"].attrs["units"] == "m"
    assert group.attrs["sonar"]["frequency"] == 600e3


def broken(folder: Path, name: str, change) -> None:
    content = json.loads((folder / name).read_text())
    change(content)
    (folder / name).write_text(json.dumps(content))


@pytest.mark.parametrize(
    ("name", "change"),
    [
        (".zattrs", lambda c: c.update(version=2)),
        (".zattrs", lambda c: c.update(beam_names=["port"])),
        (".zattrs", lambda c: c.update(beam_names=7)),
        (".zattrs", lambda c: c.pop("spacing")),
        (".zattrs", lambda c: c["sonar"].update(frequency=-1.0)),
        (".zattrs", lambda c: c.update(sonar=[1])),
        ("intensity/.zarray", lambda c: c.update(shape=[10**15, 2, 200])),
        ("intensity/.zarray", lambda c: c.update(shape=[101, 2, 10**12], chunks=[16, 2, 10**12])),
        ("intensity/.zarray", lambda c: c.update(shape=[101, 2], chunks=[16, 2])),
        ("intensity/.zarray", lambda c: c.update(chunks=[0, 2, 200])),
        ("intensity/.zarray", lambda c: c.update(chunks=[16, 1, 200])),
        ("intensity/.zarray", lambda c: c.update(dtype="|O")),
        ("intensity/.zarray", lambda c: c.update(compressor={"id": "blosc"})),
        ("intensity/.zarray", lambda c: c.update(zarr_format=3)),
        ("time/.zarray", lambda c: c.update(shape=[-1])),
        ("time/.zarray", lambda c: c.update(shape=[5])),
    ],
)  # fmt: skip
def test_a_broken_folder_is_refused(name: str, change, tmp_path) -> None:
    folder = tmp_path / "a.zarr"
    fly(out=folder, count=5)
    broken(folder, name, change)
    with pytest.raises(bathyal.Error, match=r"a\.zarr"):
        bathyal.read_sonar(folder)


def test_broken_chunks_are_named_and_written_anew(tmp_path) -> None:
    folder = tmp_path / "a.zarr"
    fly(truth=True, out=folder)
    whole = digest(folder)
    for name, data in (("intensity/1.0.0", b"short"), ("truth_range/2.0.0", b"not deflated")):
        kept = (folder / name).read_bytes()
        (folder / name).write_bytes(data)
        record = bathyal.read_sonar(folder)
        column = record.intensity if "intensity" in name else record.truth.range
        with pytest.raises(bathyal.Error, match=name):
            np.asarray(column)
        assert column[0].shape == (2, 200)
        (folder / name).write_bytes(kept)
    (folder / "time" / "3").write_bytes(b"")
    assert len(bathyal.read_sonar(folder)) == PINGS - 16
    fly(truth=True, out=folder)
    assert digest(folder) == whole
    shutil.rmtree(folder / "intensity")
    with pytest.raises(bathyal.Error, match="no intensity"):
        bathyal.read_sonar(folder)


def test_a_chunk_that_is_lost_is_reported(tmp_path) -> None:
    fly(out=tmp_path / "survey")
    chunks = sorted((tmp_path / "survey" / "intensity").glob("[0-9]*"))
    chunks[1].unlink()
    record = bathyal.read_sonar(tmp_path / "survey")
    assert [text for text in record.warnings if "intensity: 1 of" in text]
    assert np.isnan(np.asarray(record.intensity)).any()


def test_a_record_is_named_in_one_line() -> None:
    record = fly()
    assert repr(record) == f"SonarRecord({len(record)} pings × 2 beams × 200 samples, 10.0 s)"
