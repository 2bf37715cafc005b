# SPDX-License-Identifier: BSD-3-Clause
"""XTF files: the real one, our own, and what is none."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

import bathyal
from bathyal._core import parse_xtf

DATA = Path(__file__).parents[4] / "shared" / "data" / "sidescan"
REAL = DATA / "scotsman-iver2.xtf"
real = pytest.mark.skipif(not REAL.exists(), reason=f"the measured side-scan is not at {DATA}")


@pytest.fixture(scope="module")
def record() -> bathyal.SonarRecord:
    return bathyal.read_sonar(REAL)


@real
def test_the_real_file_is_read_as_others_decoded_it(record) -> None:
    others = np.load(DATA / "scotsman-iver2_derived.npz")
    amplitude = np.sqrt(record.intensity)
    assert record.beam_names == ("port", "starboard")
    assert np.array_equal(amplitude[:, 1], others["starboard"])
    assert np.array_equal(amplitude[:, 0, ::-1], others["port"])  # stored far to near
    assert str(record.start) == "2013-09-10T21:13:08.000"
    known = others["lat_deg"] != 0
    assert (~known).sum() == 1
    assert np.isnan(record.navigation.latitude[~known]).all()
    for name, column in (("latitude", "lat_deg"), ("longitude", "lon_deg"),
                         ("heading", "heading_deg")):  # fmt: skip
        found = np.degrees(getattr(record.navigation, name)[known])
        assert np.allclose(found, others[column][known], atol=1e-9)
    assert np.allclose(record.navigation.altitude[known], others["altitude_m"][known])
    assert np.isnan(record.navigation.altitude[~known]).all()
    end = record.range[-1] + 0.5 * np.diff(record.range[:2])[0]
    assert end == pytest.approx(float(others["slant_range_m"]))


@real
def test_the_real_file_written_again_is_the_same() -> None:
    data = REAL.read_bytes()
    file = parse_xtf(data)
    assert (file.ping_count, file.damaged, file.lost_bytes, file.other_packets) == (461, 0, 0, {})
    assert file.to_bytes() == data


@real
def test_our_file_of_it_is_read_by_another_program(record, tmp_path) -> None:
    pyxtf = pytest.importorskip("pyxtf", reason="pyxtf is not installed")
    record.write(tmp_path / "ours.xtf")
    _, packets = pyxtf.xtf_read(str(tmp_path / "ours.xtf"))
    pings = packets[pyxtf.XTFHeaderType.sonar]
    assert len(pings) == len(record)
    amplitude = np.sqrt(record.intensity)
    step = amplitude.max() / 65535
    for k in (0, 137, 460):
        port, starboard = pings[k].data
        assert np.allclose(port[::-1] * step, amplitude[k, 0], atol=0.51 * step)
        assert np.allclose(starboard * step, amplitude[k, 1], atol=0.51 * step)


@real
def test_its_waterfall_has_metres(record) -> None:
    axes = record.plot().axes[0]
    assert axes.get_xlim() == pytest.approx((-29.98, 29.98), abs=0.01)
    assert 40 < axes.get_ylim()[0] < 80  # a track of some 55 m


@pytest.mark.parametrize("data", [b"", b"{", b"{" + bytes(500), b"RIFF" + bytes(2000)])
def test_what_is_no_xtf_is_refused(data: bytes, tmp_path) -> None:
    with pytest.raises(bathyal.Error):
        parse_xtf(data)
    path = tmp_path / "file.xtf"
    path.write_bytes(data)
    with pytest.raises(bathyal.Error):
        bathyal.read_sonar(path)


def test_a_missing_file_is_the_systems_error(tmp_path) -> None:
    with pytest.raises(FileNotFoundError):
        bathyal.read_sonar(tmp_path / "none.xtf")
