# SPDX-License-Identifier: BSD-3-Clause
"""GSF files: the measured one against the format's own library, our own, and what is none."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

import bathyal

pytest.importorskip("GSFU", reason="gsfu is not installed")
DATA = Path(__file__).parents[4] / "shared" / "data" / "soundings"
REAL = DATA / "GSF3_08_test_file.gsf"
real = pytest.mark.skipif(not REAL.exists(), reason=f"the measured soundings are not at {REAL}")


@pytest.fixture(scope="module")
def pings() -> bathyal.MultibeamPings:
    return bathyal.read_gsf(REAL)


@real
def test_the_measured_file_is_read_as_the_formats_library_reads_it(pings) -> None:
    gsfpy = pytest.importorskip("gsfpy3_08", reason="gsfpy is not installed")
    kind = gsfpy.enums.RecordType.GSF_RECORD_SWATH_BATHYMETRY_PING
    assert len(pings) == 8
    with gsfpy.open_gsf(str(REAL)) as file:
        for row in range(len(pings)):
            _, record = file.read(kind)
            other = record.mb_ping
            beams = other.number_beams
            assert beams == pings.depth.shape[1] == 432
            for name, field in (
                ("depth", "depth"), ("across", "across_track"), ("along", "along_track"),
                ("travel_time", "travel_time"), ("beam_angle", "beam_angle"),
            ):  # fmt: skip
                theirs = np.array([getattr(other, field)[i] for i in range(beams)])
                ours = getattr(pings, name)[row]
                ours = np.degrees(ours) if name == "beam_angle" else ours
                assert ours == pytest.approx(theirs, abs=1e-9), (row, name)
            flags = np.array([other.beam_flags[i] for i in range(beams)])
            flags = np.array([ord(f) if isinstance(f, bytes) else f for f in flags])
            assert np.array_equal(pings.rejected[row], flags & 1 != 0)
            # gsfpy 2.0 has the names of these two exchanged
            assert np.degrees(pings.latitude[row]) == pytest.approx(other.longitude, abs=1e-9)
            assert np.degrees(pings.longitude[row]) == pytest.approx(other.latitude, abs=1e-9)
            assert np.degrees(pings.heading[row]) == pytest.approx(other.heading, abs=1e-9)
            assert np.degrees(pings.pitch[row]) == pytest.approx(other.pitch, abs=1e-9)
            assert np.degrees(pings.roll[row]) == pytest.approx(other.roll, abs=1e-9)
    assert np.isnan(pings.depth_corrector).all()  # 99.99: nothing is known of it
    assert pings.records == {
        "header": 1, "swath_bathy_summary": 1, "comment": 2, "processing_parameters": 1,
        "sound_velocity_profile": 1, "swath_bathymetry_ping": 8, "attitude": 111, "history": 1,
    }  # fmt: skip
    assert str(pings.start) == "2016-03-23T18:55:53.856000"
    assert len(pings.profile) == 591


@real
def test_travel_times_follow_from_the_files_own_profile(pings) -> None:
    """4 km deep: by the bent ray within 1.5 per mille, by the surface's sound speed 29 off."""
    ratio, straight = [], []
    for row in range(len(pings)):
        for beam in np.flatnonzero(~pings.rejected[row])[::20]:
            distance = np.hypot(pings.across[row, beam], pings.along[row, beam])
            depth = pings.depth[row, beam]
            ray = bathyal.eigenrays(pings.profile, 7.0, depth, distance, angles=300)[0]
            ratio.append(pings.travel_time[row, beam] / (2 * ray.time))
            surface = pings.profile.sound_speed[0]
            straight.append(
                pings.travel_time[row, beam] / (2 * np.hypot(distance, depth - 7.0) / surface)
            )
    off = 1e3 * (np.array(ratio) - 1.0)
    assert len(off) > 100
    assert np.abs(off).max() < 1.5
    assert 1e3 * (np.median(straight) - 1.0) > 28.0


@real
def test_soundings_in_utm_become_a_seabed(pings) -> None:
    cloud = bathyal.read_cloud(REAL)
    assert cloud.crs == "EPSG:32658"
    assert len(cloud.points) == np.sum(~pings.rejected) == 2369
    # the file's own summary
    assert -cloud.points[:, 2].max() == pytest.approx(3862.43, abs=0.01)
    assert -cloud.points[:, 2].min() == pytest.approx(4145.0, abs=0.01)
    ping, beam = (int(cloud.attributes[name][0]) for name in ("ping", "beam"))
    assert cloud.points[0, 2] == -pings.depth[ping, beam]
    across = np.linalg.norm(cloud.points[:, :2] - cloud.points[:, :2].mean(axis=0), axis=1)
    assert 1500 < across.max() < 4500
    assert len(bathyal.triangulate(cloud).triangles) > 4000


def make(path: Path, count: int = 3) -> Path:
    """A file of a ship that goes north from 45° N, 9° E: a bottom 100 m below, 5 beams."""
    from GSFU.gsfu import gsf, new_swath_bathymetry_ping

    file = gsf(str(path), auto_scale=True)
    file.write_header()
    for k in range(count):
        ping = new_swath_bathymetry_ping()
        ping.update(
            PingTime=1.7e9 + k, Longitude_deg=9.0, Latitude_deg=45.0 + 1e-4 * k, NumberBeams=5,
            Heading_deg=0.0, Pitch_deg=0.0, Roll_deg=0.0,
        )  # fmt: skip
        ping["Beams"] = {
            "Depth_m": [100.0, 100.0, 100.0, 100.0, 0.0],
            "AcrossTrack_m": [-100.0, -50.0, 0.0, 50.0, 100.0], "AlongTrack_m": [0.0] * 5,
            "BeamFlags": [0, 0, 1, 0, 0],
        }  # fmt: skip
        file.write_swath_bathymetry_ping(ping)
    file.closeFile()
    return path


def test_starboard_is_east_of_a_ship_that_goes_north(tmp_path) -> None:
    path = make(tmp_path / "north.gsf")
    pings = bathyal.read_gsf(path)
    assert np.array_equal(pings.rejected[0], [False, False, True, False, True])
    assert pings.profile is None
    assert np.isnan(pings.travel_time).all()
    assert pings.time.tolist() == [0, 1, 2]
    cloud = bathyal.read_cloud(path)  # 9° E is the meridian of zone 32
    assert cloud.crs == "EPSG:32632"
    assert cloud.points[:3, 0] == pytest.approx(500_000 + np.array([-100.0, -50.0, 50.0]), abs=0.05)
    assert np.diff(cloud.points[:, 1])[2] == pytest.approx(11.11, abs=0.05)
    assert np.all(cloud.points[:, 2] == -100.0)


def read_or_none(path: Path) -> bathyal.MultibeamPings | None:
    """None for an Error, the only one that a broken file may raise."""
    try:
        return bathyal.read_gsf(path)
    except bathyal.Error:
        return None


def test_cut_at_every_byte(tmp_path) -> None:
    whole = make(tmp_path / "whole.gsf").read_bytes()
    counts = set()
    for end in range(len(whole)):
        path = tmp_path / "cut.gsf"
        path.write_bytes(whole[:end])
        found = read_or_none(path)
        counts.add(0 if found is None else len(found))
        if found is not None:
            assert found.depth[0, :2].tolist() == [100.0, 100.0]
    assert counts == {0, 1, 2}


def test_bytes_at_random(tmp_path) -> None:
    whole = make(tmp_path / "whole.gsf").read_bytes()
    random = np.random.default_rng(3)
    path = tmp_path / "broken.gsf"
    for _ in range(400):
        data = bytearray(whole)
        for at in random.integers(0, len(data), 3):
            data[at] = random.integers(0, 256)
        path.write_bytes(bytes(data))
        found = read_or_none(path)
        assert found is None or 1 <= len(found) <= 3


@pytest.mark.parametrize("data", [b"", b"no GSF", bytes(1000), b"\xff" * 1000])
def test_another_format(data, tmp_path) -> None:
    path = tmp_path / "other.gsf"
    path.write_bytes(data)
    with pytest.raises(bathyal.Error, match=r"other\.gsf"):
        bathyal.read_gsf(path)
    with pytest.raises(OSError, match="none"):
        bathyal.read_gsf(tmp_path / "none.gsf")
