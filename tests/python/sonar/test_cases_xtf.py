# SPDX-License-Identifier: BSD-3-Clause
"""Cases of XTF: pyxtf reads what we write and writes what we read, and files that mean harm."""

from __future__ import annotations

import ctypes
import struct
from pathlib import Path

import numpy as np
import pytest

import bathyal
from bathyal import _core
from tests.support import alone
from tests.support.sea_cases import at, ball, flat_world, plate, world_of

pyxtf = pytest.importorskip("pyxtf", reason="pyxtf is not installed")

SPEED = 1480.0


@pytest.fixture(scope="module")
def survey():
    """301 pings along x; a ball 15 m to port at x = 6 m, another 20 m to starboard at x = 9 m."""
    world = world_of(
        plate((-90, -90), (90, 90)),
        (ball(1.0, 30), at(6, 15, 0.5)),
        (ball(0.8, 30), at(9, -20, 0.5)),
    )
    world.water = bathyal.Water(sound_speed=SPEED, surface=30.0)
    track = bathyal.Trajectory([0, 12.0], np.stack([at(0, 0, 9), at(12, 0, 10)]))
    sonar = bathyal.sonars.side_scan().replace(
        range=30.0, samples=300, ping_rate=25.0, rays_along_fan=600
    )
    return sonar.survey(world, track)


@pytest.fixture(scope="module")
def written(survey, tmp_path_factory):
    path = tmp_path_factory.mktemp("xtf") / "survey.xtf"
    survey.write(path)
    return path


def packets(path):
    header, found = pyxtf.xtf_read(str(path))
    return header, found[pyxtf.XTFHeaderType.sonar]


def test_pyxtf_reads_every_ping(survey, written):
    header, pings = packets(written)
    assert len(pings) == len(survey) == 301
    assert [ping.PingNumber for ping in pings] == list(range(301))
    assert [chan.TypeOfChannel for chan in header.ChanInfo[:2]] == [1, 2]
    ping = pings[299]
    channel = ping.ping_chan_headers[1]
    assert (channel.NumSamples, channel.SlantRange) == (300, 30.0)
    assert ping.SoundVelocity == SPEED / 2
    assert ping.SensorPrimaryAltitude == pytest.approx(9 + 299 / 300, abs=1e-5)
    assert ping.SensorDepth == pytest.approx(30 - 9 - 299 / 300, abs=1e-5)
    assert ping.SensorHeading == pytest.approx(90.0)
    assert ping.SensorXcoordinate == pytest.approx(299 * 0.04)
    assert ping.SensorSpeed == pytest.approx(np.sqrt(145) / 12 / 0.514444, rel=5e-3)


def test_port_is_on_the_left_in_pyxtf(survey, written):
    """Side by side as software draws them, nadir in the middle, targets on their own side."""
    _, pings = packets(written)
    image = np.array([np.concatenate(ping.data) for ping in pings], dtype=float)
    assert np.all(image[:, 300 - 85 : 300 + 85] == 0)
    assert np.all(image[:, [0, -1]] > 0)
    middle = np.median(image, axis=0)
    bright = image - middle
    bright[:, 300 - 120 : 300 + 120] = 0.0  # where the bottom begins as the altitude grows
    port, starboard = bright[:, :300], bright[:, 300:]
    row, column = np.unravel_index(port.argmax(), port.shape)
    assert row * 0.04 == pytest.approx(6.0, abs=1.2)
    assert (299.5 - column) * 0.1 == pytest.approx(np.hypot(15, 9) - 1.0, abs=0.4)
    row, column = np.unravel_index(starboard.argmax(), starboard.shape)
    assert row * 0.04 == pytest.approx(9.0, abs=1.2)
    assert (column + 0.5) * 0.1 == pytest.approx(np.hypot(20, 9.2) - 0.8, abs=0.4)
    for row, near_to_far in enumerate((image[:, 299::-1], image[:, 300:])):
        heard = survey.intensity[:, row].ravel()
        assert np.corrcoef(near_to_far.ravel() ** 2, heard)[0, 1] > 0.9999


def test_a_record_comes_back(survey, written):
    found = bathyal.read_sonar(written)
    root = np.sqrt(survey.intensity.astype(float))
    assert np.abs(np.sqrt(found.intensity) - root).max() < root.max() / 32_767
    assert found.range == pytest.approx(survey.range)
    assert found.time == pytest.approx(survey.time, abs=0.0101)
    assert found.beam_names == ("port", "starboard")
    for name in ("heading", "pitch", "roll", "depth", "altitude", "speed"):
        there, back = getattr(survey.navigation, name), getattr(found.navigation, name)
        assert back == pytest.approx(there, abs=1e-5), name
    assert found.navigation.position[:, :2] == pytest.approx(survey.navigation.position[:, :2])


def test_the_sound_speed_comes_back(survey, written):
    assert survey.sound_speed == SPEED
    assert bathyal.read_sonar(written).sound_speed == pytest.approx(SPEED)


def test_write_read_write_is_identical(written, tmp_path):
    again = tmp_path / "again.xtf"
    bathyal.read_sonar(written).write(again)
    assert _core.parse_xtf(written.read_bytes()).to_bytes() == written.read_bytes()
    first, second = (packets(path)[1] for path in (written, again))
    assert all(
        np.array_equal(x, y)
        for one, two in zip(first, second, strict=True)
        for x, y in zip(one.data, two.data, strict=True)
    )


def made(types=(1, 2), pings=270, samples=64, dtype=np.uint16, extra=b""):
    """A file by pyxtf; each channel's samples, near to far, are those of `ramp`."""
    header = pyxtf.XTFFileHeader()
    header.NavUnits, header.NumberOfSonarChannels = 0, len(types)
    for i, kind in enumerate(types):
        header.ChanInfo[i].TypeOfChannel = kind
        header.ChanInfo[i].SubChannelNumber = i
        header.ChanInfo[i].BytesPerSample = np.dtype(dtype).itemsize
        header.ChanInfo[i].UniPolar = 1
    body = [header.to_bytes()]
    for number in range(pings):
        ping = pyxtf.XTFPingHeader()
        ping.PingNumber, ping.NumChansToFollow, ping.SoundVelocity = number, len(types), 750.0
        ping.Year, ping.Month, ping.Day, ping.Minute = 2026, 11, 23, number // 60
        ping.Second = number % 60
        ping.SensorPrimaryAltitude, ping.SensorDepth = 8.0, 3.0
        ping.data, ping.ping_chan_headers = [], []
        for i, kind in enumerate(types):
            channel = pyxtf.XTFPingChanHeader()
            channel.ChannelNumber, channel.SlantRange, channel.NumSamples = i, 32.0, samples
            ping.ping_chan_headers.append(channel)
            values = ramp(kind, number, samples).astype(dtype)
            ping.data.append(values[::-1].copy() if kind == 1 else values)
        ping.NumBytesThisRecord = len(ping.to_bytes())
        body += [ping.to_bytes(), extra]
    return b"".join(body)


def ramp(kind, number, samples):
    return np.arange(samples) * (1 + kind) + number % 50


@pytest.mark.parametrize("types", [(1, 2), (2, 1)])
@pytest.mark.parametrize("dtype", [np.uint8, np.uint16])
def test_files_by_pyxtf(types, dtype, tmp_path):
    path = tmp_path / "made.xtf"
    path.write_bytes(made(types, dtype=dtype))
    record = bathyal.read_sonar(path)
    assert len(record) == 270
    assert record.beam_names == ("port", "starboard")
    root = np.sqrt(record.intensity.astype(float))
    for row, kind in enumerate((1, 2)):
        paper = np.array([ramp(kind, number, 64) for number in range(270)])
        assert root[:, row] / root[100, row, 9] == pytest.approx(paper / paper[100, 9], rel=1e-5)
    assert record.range == pytest.approx((np.arange(64) + 0.5) / 2)
    assert np.diff(record.time) == pytest.approx(np.ones(269))
    assert record.navigation.altitude == pytest.approx(np.full(270, 8.0))


def test_unknown_packets_are_skipped_and_counted():
    unknown = struct.pack("<HBBHHHI", 0xFACE, 177, 0, 0, 0, 0, 64) + bytes(50)
    assert len(unknown) == 64
    found = _core.parse_xtf(made(pings=20, extra=unknown))
    assert (found.ping_count, found.lost_bytes) == (20, 0)
    assert sum(dict(found.other_packets).values()) == 20


def test_cuts_anywhere():
    """What is whole stays; nothing but `Error` where no header is left."""
    data = made(pings=6, samples=16)
    head = ctypes.sizeof(pyxtf.XTFFileHeader)
    size = (len(data) - head) // 6
    for length in range(len(data)):
        if length < head:
            with pytest.raises(bathyal.Error):
                _core.parse_xtf(data[:length])
            continue
        found = _core.parse_xtf(data[:length])
        assert found.ping_count == (length - head) // size
        assert found.lost_bytes == (length - head) % size


def test_rubbish_between_pings_loses_only_itself():
    data = made(pings=6, samples=16)
    head = ctypes.sizeof(pyxtf.XTFFileHeader)
    size = (len(data) - head) // 6
    middle = head + 3 * size
    found = _core.parse_xtf(data[:middle] + b"\x55" * 37 + data[middle:])
    assert (found.ping_count, found.lost_bytes) == (6, 37)


@pytest.mark.parametrize("count", [0, 1, 15, 17, 10**9, 2**32 - 1])
def test_samples_that_the_header_makes_up(count, tmp_path):
    """One ping of four claims another count: no memory is taken, and the rest is whole."""
    data = bytearray(made(pings=4, samples=16))
    head = ctypes.sizeof(pyxtf.XTFFileHeader)
    size = (len(data) - head) // 4
    field = (
        head + size + ctypes.sizeof(pyxtf.XTFPingHeader) + pyxtf.XTFPingChanHeader.NumSamples.offset
    )
    struct.pack_into("<I", data, field, count)
    path = tmp_path / "bad.xtf"
    path.write_bytes(data)
    record = bathyal.read_sonar(path)
    whole = np.sqrt(record.intensity.astype(float))
    assert whole.shape[2] <= 17
    assert len(record) in (3, 4)
    assert record.warnings
    if count == 17:  # two bytes more could be padding
        assert any("in ping 1 with 17" in text for text in record.warnings)
    assert record.range[15] == pytest.approx(32.0 * 15.5 / 16)
    last = whole[-1, 1] / whole[-1, 1, 1]
    assert last[:16] == pytest.approx(ramp(2, 3, 16) / ramp(2, 3, 16)[1], rel=1e-5)


@pytest.mark.parametrize("size", [0, 1, 13, 14, 255, 2**31, 2**32 - 1])
def test_records_of_another_size_than_they_say(size):
    data = bytearray(made(pings=4, samples=16))
    head = ctypes.sizeof(pyxtf.XTFFileHeader)
    record = (len(data) - head) // 4
    struct.pack_into("<I", data, head + record + 10, size)
    found = _core.parse_xtf(bytes(data))
    assert found.ping_count == 3
    assert found.lost_bytes + found.damaged > 0


def own_of_no_pings():
    sonar = bathyal.sonars.side_scan().replace(samples=50, rays_along_fan=50)
    track = bathyal.Trajectory([0, 1.0], np.stack([at(0, 0, 9), at(1, 0, 9)]))
    sonar.survey(flat_world(), track, count=0).write("own.xtf")
    return Path("own.xtf").read_bytes()


EMPTY = {
    "own": own_of_no_pings,
    "no pings": lambda: made(pings=0),
    "no samples": lambda: made(pings=3, samples=0),
    "every ping damaged": lambda: made(pings=3).replace(struct.pack("<I", 64), bytes(4)),
}


@pytest.mark.parametrize("name", EMPTY)
def test_files_without_a_ping(name, tmp_path):
    """An `Error` or an empty record, but no end of the process."""

    def read():
        (tmp_path / "empty.xtf").write_bytes(EMPTY[name]())
        try:
            record = bathyal.read_sonar(tmp_path / "empty.xtf")
        except bathyal.Error:
            return
        assert record.intensity.size == 0

    alone.check(alone.works(name, read), tmp_path)


def test_random_damage_is_an_error_or_a_record(tmp_path):
    """2 000 files with bytes turned over: an `Error`, or arrays that fit each other."""

    def read_all():
        data, rng = made(pings=4, samples=16), np.random.default_rng(0)
        head = ctypes.sizeof(pyxtf.XTFFileHeader)
        path, read = tmp_path / "bad.xtf", 0
        for _ in range(2000):
            bad = bytearray(data)
            end = len(data) if rng.random() < 0.5 else head
            for place in rng.integers(0, end, rng.integers(1, 12)):
                bad[place] = rng.choice([0, 1, 127, 128, 255, rng.integers(256)])
            path.write_bytes(bad)
            try:
                record = bathyal.read_sonar(path)
            except bathyal.Error:
                continue
            read += 1
            shape = (len(record), len(record.beam_names), len(record.range))
            assert record.intensity.shape == shape
            assert np.all(np.isnan(record.intensity) | (record.intensity >= 0))
        assert read > 100

    alone.check(alone.works("damage", read_all), tmp_path)
