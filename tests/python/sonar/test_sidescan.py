# SPDX-License-Identifier: BSD-3-Clause
"""First returns, ground ranges and mosaics of the measured side-scan and of simulated ones."""

from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

import bathyal
from bathyal.sonar.describe import fit_altitude
from tests.support.command import run

REAL = Path(__file__).parents[4] / "shared" / "data" / "sidescan" / "scotsman-iver2.xtf"
real = pytest.mark.skipif(not REAL.exists(), reason=f"the measured side-scan is not at {REAL}")


@pytest.fixture(scope="module")
def measured() -> bathyal.SonarRecord:
    return bathyal.read_sonar(REAL)


@pytest.fixture(scope="module")
def simulated() -> bathyal.SonarRecord:
    """Over sand 8 m below, a steel block to starboard; towards the north-east."""
    world = bathyal.World()
    corners = [[-99, -99, 0], [99, -99, 0], [99, 99, 0], [-99, 99, 0]]
    world.add(bathyal.TriangleMesh(corners, [[0, 1, 2], [0, 2, 3]]), material="sand")
    mine = bathyal.make_mine("cylinder")
    pose = np.eye(4)
    pose[:3, 3] = 10.0, -10.0, 0.0
    world.add(mine, pose=pose, material="steel", name="mine")
    turn = np.eye(4)
    c = np.sqrt(0.5)
    turn[:2, :2] = [[c, -c], [c, c]]
    track = np.stack([turn, turn])
    track[:, :3, 3] = [[-15, -15, 8], [15, 15, 8]]
    sonar = bathyal.sonars.side_scan(physics="real").replace(
        range=40.0, samples=1000, rays_along_fan=3000
    )
    return sonar.survey(world, bathyal.Trajectory([0.0, 20.0], track), seed=3, count=120)


@real
@pytest.mark.parametrize("method", ["likelihood", "threshold"])
def test_the_measured_first_return_follows_the_reported_altitude(measured, method) -> None:
    bottom = measured.track_bottom(method=method)
    assert np.isfinite(bottom.range).all()
    altitude = measured.navigation.altitude
    for side in (0, 1):
        fit = fit_altitude(bottom.range[:, side], altitude)
        assert fit.pings == 460
        assert fit.correlation > 0.997
        assert fit.slope == pytest.approx(1.215, abs=0.01)
        assert fit.offset == pytest.approx(-0.29, abs=0.05)
    # the vehicle dives with its bow up to 23° down, and its fans with it
    slant = altitude / np.cos(measured.navigation.pitch)
    explained = fit_altitude(bottom.altitude, slant)
    assert explained.slope == pytest.approx(1.095, abs=0.01)
    assert explained.correlation > 0.998


@real
def test_two_pickers_agree_on_the_measured_bottom(measured) -> None:
    one, two = (measured.track_bottom(method=m).range for m in ("likelihood", "threshold"))
    samples = np.abs(one - two) / (2 * measured.range[0])
    assert np.median(samples) <= 1.01
    assert (samples <= 2.01).mean() > 0.94
    assert samples.max() < 8


@pytest.mark.parametrize("method", ["likelihood", "threshold"])
def test_the_simulated_first_return_is_the_height(simulated, method) -> None:
    bottom = simulated.track_bottom(method=method)
    off = (bottom.range - 8.0) / (2 * simulated.range[0])
    assert np.abs(np.median(off)) <= 2
    assert (np.abs(off) <= 4).mean() > 0.95
    assert bottom.altitude == pytest.approx(bottom.range.min(axis=1))


def test_a_mine_is_where_it_lies(simulated) -> None:
    mosaic = simulated.mosaic(spacing=0.2)
    assert mosaic.crs is None
    assert mosaic.left_out == 0
    place = np.unravel_index(np.nanargmax(mosaic.intensity), mosaic.intensity.shape)
    assert mosaic.x[place[1]] == pytest.approx(10.0, abs=1.2)
    assert mosaic.y[place[0]] == pytest.approx(-10.0, abs=1.2)
    ground = simulated.to_ground(spacing=0.2)
    ping, beam, bin_ = np.unravel_index(np.nanargmax(ground.intensity), ground.intensity.shape)
    assert ground.beam_names[beam] == "starboard"
    assert ground.range[bin_] == pytest.approx(np.hypot(10, 10), abs=1.0)
    beside = ground.intensity[ping - 30 : ping - 20, 1, bin_ : bin_ + 10].mean()
    here = ground.intensity[:, 1, bin_ - 3 : bin_ + 10]
    middle = int(np.median(np.flatnonzero(here.max(axis=1) > 8 * beside)))
    behind = here[middle - 1 : middle + 2, 3:].mean(axis=0)
    assert behind.min() < 0.1 * beside


def test_first_returns_that_were_not_found_leave_no_stripes(simulated) -> None:
    bottom = simulated.track_bottom()
    ranges = bottom.range.copy()
    ranges[20:30, 0] = np.nan
    ranges[0] = np.nan
    holes = bathyal.BottomTrack(ranges, "likelihood")
    whole, patched = (simulated.mosaic(bottom=b, spacing=0.3) for b in (bottom, holes))
    known = np.isfinite(patched.intensity).sum()
    assert known == pytest.approx(np.isfinite(whole.intensity).sum(), rel=0.002)
    nothing = bathyal.BottomTrack(np.full_like(ranges, np.nan), "likelihood")
    assert simulated.to_ground(bottom=nothing).intensity.shape[2] == 0


@real
def test_the_mosaic_opens_as_geotiff_in_utm(measured, tmp_path) -> None:
    rasterio = pytest.importorskip("rasterio", reason="rasterio is not installed")
    mosaic = measured.mosaic(spacing=0.2)
    assert mosaic.crs == "EPSG:32619"
    assert mosaic.left_out == 1
    mosaic.write(tmp_path / "m.tif")
    with rasterio.open(tmp_path / "m.tif") as file:
        assert file.crs.to_epsg() == 32619
        level = file.read(1)
        place = rasterio.warp.transform("EPSG:4326", file.crs, [-68.827994], [48.445588])
        row, column = file.index(place[0][0], place[1][0])  # the label of the file's wreck
    assert level.shape == mosaic.intensity.shape
    known = np.isfinite(level)
    assert np.allclose(level[known], 10 * np.log10(mosaic.intensity[known]), atol=1e-4)
    around = level[row - 25 : row + 25, column - 25 : column + 25]
    assert np.nanmax(around) > np.nanmedian(level) + 10.0
    with pytest.raises(ValueError, match="`path`: expected a name that ends in"):
        mosaic.write(tmp_path / "m.jpg")


@real
def test_command(measured, tmp_path, capsys) -> None:
    code, out, err = run(capsys, "xtf", REAL, "--json")
    assert code == 0, err
    assert json.loads(out)["pings"].startswith("461")
    assert json.loads(out)["files"] == []
    code, out, err = run(capsys, "xtf", REAL, "--out", tmp_path, "--spacing", 0.5, "--json")
    assert code == 0, err
    assert "1 of 461 pings" in json.loads(out)["warnings"][0]
    names = {Path(name).name for name in json.loads(out)["files"]}
    assert names == {"waterfall.png", "ground.png", "bottom.csv", "mosaic.tif", "mosaic.png"}
    table = np.genfromtxt(tmp_path / "bottom.csv", delimiter=",", names=True)
    assert np.allclose(table["first_return_port"], measured.track_bottom().range[:, 0], atol=1e-4)


def test_bad_input(simulated, tmp_path, capsys) -> None:
    with pytest.raises(ValueError, match='`method`: expected "likelihood" or "threshold"'):
        simulated.track_bottom(method="guess")
    with pytest.raises(ValueError, match="`nearest`: expected"):
        simulated.track_bottom(nearest=float("nan"))
    with pytest.raises(ValueError, match="`threshold_db`: expected"):
        simulated.track_bottom(threshold_db=0.0)
    with pytest.raises(ValueError, match="`spacing`: expected"):
        simulated.mosaic(spacing=0.0)
    with pytest.raises(ValueError, match="`record`: expected pings of a side-scan"):
        replace(simulated, beam_names=("1", "2")).track_bottom()
    lost = replace(
        simulated,
        navigation=replace(simulated.navigation, heading=np.full(len(simulated), np.nan)),
    )
    with pytest.raises(bathyal.Error, match="no ping has a position"):
        lost.mosaic()
    (tmp_path / "no.xtf").write_bytes(b"no")
    code, _, err = run(capsys, "xtf", tmp_path / "no.xtf")
    assert code == 1
    assert "not a sonar file" in err
