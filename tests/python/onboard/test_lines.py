# SPDX-License-Identifier: BSD-3-Clause
"""Lines as instruments have them: read by gpsd, too slow, with bits turned, PD6; bad peers."""

from __future__ import annotations

import json
import math
import os
import shutil
import socket
import subprocess
import time

import numpy as np
import pytest

import bathyal
from bathyal._core import NmeaReader, SerialLine, nmea_sentence
from bathyal.navigation.local_frame import local_place, local_position
from bathyal.onboard.nmea import reading_body, reading_of
from bathyal.onboard.place import compass_degrees
from tests.support.onboard import MISSION, free_port, keep_down, run_with

AT_THE_SURFACE = MISSION.replace(
    "mission:",
    "sensors: [{kind: gps, rate: 5, pose: {position: [0, 0, 0.6]}}]\nmission:",
).replace("position: [3, 4, -0.5]", "position: [3, 4, 0]")


def written(tmp_path, text):
    path = tmp_path / "mission.yaml"
    path.write_text(text)
    return path


def listen(port):
    """All bytes of a pseudo-terminal, to the end of the run."""
    handle = os.open(port, os.O_RDWR | os.O_NOCTTY)
    heard = b""
    while port.is_symlink():
        try:
            os.set_blocking(handle, False)
            heard += os.read(handle, 65536)
        except BlockingIOError:
            time.sleep(0.002)
    os.close(handle)
    return heard


def test_gpsd_reads_positions_within_its_last_decimal(tmp_path):
    daemon = shutil.which("gpsd") or "/usr/sbin/gpsd"
    if not os.path.exists(daemon):
        pytest.skip("gpsd is not installed")
    text = AT_THE_SURFACE.replace(
        "name: port", "name: gps, lockstep: false, sentences: standard"
    ).replace("20 s", "40 s")
    heard = []

    def watch(port):
        number = free_port()
        command = [daemon, "-N", "-n", "-b", "-S", str(number), os.readlink(port)]
        with subprocess.Popen(command, stderr=subprocess.DEVNULL) as process:
            try:
                for _ in range(200):
                    try:
                        line = socket.create_connection(("127.0.0.1", number), timeout=10)
                        break
                    except ConnectionRefusedError:
                        time.sleep(0.02)
                line.sendall(b'?WATCH={"enable":true,"json":true};\n')
                with line, line.makefile() as rows:
                    while len(heard) < 20:
                        row = json.loads(rows.readline())
                        if row["class"] == "TPV" and "lat" in row and "time" in row:
                            heard.append(row)
            finally:
                process.terminate()

    ended = run_with(written(tmp_path, text), tmp_path / "run", watch, name="gps", speed=5.0)
    told = ended.result.log.messages("/sensors/gps")
    origin = (math.radians(43.1), math.radians(131.9))
    assert len(heard) == 20
    for row in heard:
        at = (
            np.datetime64(row["time"].rstrip("Z")) - np.datetime64("2026-01-01")
        ) / np.timedelta64(1, "s")
        x, y, z = told["values"][np.argmin(np.abs(told["time"] - at))]
        places, _ = local_position(
            np.degrees([origin[0], math.radians(row["lat"])]),
            np.degrees([origin[1], math.radians(row["lon"])]),
        )
        assert np.abs(places[1] - (x, y)).max() < 0.019
        assert row["altMSL"] == pytest.approx(z, abs=0.001)


def test_places_on_earth_come_back():
    origin = (math.radians(-43.1), math.radians(179.99))
    for east, north in [(0.0, 0.0), (3.0, 4.0), (-5000.0, 8000.0), (20000.0, -20000.0)]:
        latitude, longitude = local_place(east, north, origin)
        places, _ = local_position(
            np.degrees([origin[0], latitude]), np.degrees([origin[1], longitude])
        )
        assert places[1] == pytest.approx((east, north), abs=1e-6)


def test_headings_count_from_north_to_east():
    assert compass_degrees(0.0) == pytest.approx(90.0)  # along x, east
    assert compass_degrees(0.5 * math.pi) == pytest.approx(0.0)
    assert compass_degrees(-0.5 * math.pi) == pytest.approx(180.0)
    assert compass_degrees(math.pi) == pytest.approx(270.0)


def test_a_slow_line_overruns_and_says_so(tmp_path):
    text = MISSION.replace("name: port", "name: port, lockstep: false, baud: 4800, buffer: 2048")
    ended = run_with(written(tmp_path, text), tmp_path / "run", listen, speed=20.0)
    (found,) = json.loads((tmp_path / "run" / "links.json").read_text())["links"]
    assert found["overrun_bytes"] > 10_000
    assert found["unread_bytes"] == 0
    reader = NmeaReader()
    bodies = reader.feed(ended.program)
    ends = sum(len(body) + 6 for body in bodies if body.startswith(("PBTHX", "PBTHE")))
    assert 0.95 * 480 * 20 < len(ended.program) - ends <= 480 * 20.1
    assert reader.counts["wrong_checksum"] + reader.counts["broken"] > 5


def test_bits_turn_on_a_bad_line_and_are_found(tmp_path):
    text = MISSION.replace(
        "name: port", "name: port, lockstep: false, baud: 921600, bit_error_rate: 1.0e-5"
    ).replace("20 s", "10 s")
    ended = run_with(written(tmp_path, text), tmp_path / "run", listen, speed=5.0)
    (found,) = json.loads((tmp_path / "run" / "links.json").read_text())["links"]
    assert found["unread_bytes"] == found["overrun_bytes"] == 0
    reader = NmeaReader()
    bodies = reader.feed(ended.program)
    assert 0 < reader.counts["wrong_checksum"] + reader.counts["broken"] <= found["turned_bits"]
    readings = [reading_of(body) for body in bodies if body.startswith("PBTHR")]
    told = ended.result.log.messages("/sensors/dvl")
    mine = {r.number: r for r in readings if r.device == "dvl"}
    assert len(mine) > 0.9 * len(told["time"])
    for row, index in enumerate(told["index"].astype(int)):
        if index in mine:
            assert mine[index].values == tuple(told["values"][row])


def test_a_program_on_a_slow_line_in_lock_step(tmp_path):
    text = MISSION.replace("name: port", "name: port, baud: 4800, devices: [depth]")
    one = run_with(written(tmp_path, text), tmp_path / "one", lambda p: keep_down(serial(p)))
    two = run_with(tmp_path / "mission.yaml", tmp_path / "two", lambda p: keep_down(serial(p)))
    assert one.result.metrics == two.result.metrics
    assert (tmp_path / "one/log.mcap").read_bytes() == (tmp_path / "two/log.mcap").read_bytes()


def serial(port):
    return bathyal.SerialVehicle(port)


def test_a_velocity_log_speaks_pd6(tmp_path):
    text = MISSION.replace("protocol: nmea", "protocol: pd6").replace(
        "[wait: {time: 20 s}]", "[leg: {to: [13, 4], depth: 2 m}]"
    )
    ended = run_with(written(tmp_path, text), tmp_path / "run", listen, speed=20.0)
    lines = ended.program.decode().splitlines()
    assert {line[:4] for line in lines} == {":SA,", ":TS,", ":BS,", ":BD,"}
    told = ended.result.log.messages("/sensors/dvl")
    ahead = [int(line.split(",")[2]) for line in lines if line.startswith(":BS") and "A" in line]
    valid = told["values"][told["valid"]][:, 0]
    assert len(ahead) == len(valid)
    assert np.abs(np.array(ahead) - 1e3 * valid).max() <= 0.5 + 1e-9
    headings = [float(line.split(",")[3]) for line in lines if line.startswith(":SA")]
    assert np.median(headings) == pytest.approx(90.0, abs=5.0)  # along x, east
    altitudes = [float(line.split(",")[4]) for line in lines if line.startswith(":BD")]
    assert np.median(altitudes) == pytest.approx(8.0, abs=0.5)


@pytest.mark.parametrize("values", [(), (1.0,), (0.1, -2.5e-17, math.nan)])
def test_readings_come_back_from_their_sentences(values):
    reading = bathyal.Reading("dvl", "dvl", 0.1 + 0.2, 1 / 3, 7, False, values)
    found = reading_of(reading_body(reading))
    assert repr(found) == repr(reading)
    nmea_sentence(reading_body(reading))


# bad peers and files


def failing(tmp_path, text, program=lambda port: None, match=""):
    with pytest.raises(bathyal.Error, match=match):
        run_with(written(tmp_path, text), tmp_path / "run", program)


def test_a_peer_that_hangs_is_an_error_and_the_run_is_kept(tmp_path):
    text = MISSION.replace("timeout: 20", "timeout: 0.3")
    failing(tmp_path, text, match=r"port: no answer to tick 0 within 0\.3 s")
    assert not (tmp_path / "run" / "port").exists()
    assert not (tmp_path / "run" / "run.json").exists()


def test_a_program_that_gives_up_can_go_on_with_the_same_bytes(tmp_path):
    path = written(tmp_path, MISSION.replace("timeout: 20", "timeout: 0.5"))
    run_with(path, tmp_path / "whole", lambda port: keep_down(serial(port)))

    def short(port):
        vehicle = serial(port)
        for moment in vehicle:
            depth = moment.latest("depth").values[0]
            push = max(-1.0, min(1.0, 0.5 * (depth - 2.0)))
            vehicle.command([0, 0, 0, 0, push, push, push, push])
            if moment.number == 77:
                return

    with pytest.raises(bathyal.Error, match="no answer to tick 77"):
        run_with(path, tmp_path / "run", short)
    run_with(path, tmp_path / "run", lambda port: keep_down(serial(port)), resume=True)
    assert (tmp_path / "run/log.mcap").read_bytes() == (tmp_path / "whole/log.mcap").read_bytes()


def test_nobody_connects(tmp_path):
    text = MISSION.replace("port: pty, name: port, timeout: 20", "port: 'tcp:0', timeout: 0.2")
    failing(tmp_path, text, match=r"tcp:\d+: no program has connected within 0\.2 s")


def test_a_port_that_is_taken(tmp_path):
    with socket.create_server(("127.0.0.1", 0)) as server:
        number = server.getsockname()[1]
        text = MISSION.replace("port: pty, name: port", f"port: 'tcp:{number}'")
        failing(tmp_path, text, match=rf"links\[0\]: port: tcp:{number} cannot be opened")


def test_a_file_in_the_place_of_the_port_is_not_touched(tmp_path):
    (tmp_path / "run").mkdir()
    (tmp_path / "run" / "port").write_text("mine")
    with pytest.raises(bathyal.Error, match="is there already"):
        bathyal.run(written(tmp_path, MISSION), out=tmp_path / "run")
    assert (tmp_path / "run" / "port").read_text() == "mine"


def test_a_link_that_another_run_has_left_is_replaced(tmp_path):
    (tmp_path / "run").mkdir()
    (tmp_path / "run" / "port").symlink_to("/dev/pts/99999")
    ended = run_with(
        written(tmp_path, MISSION.replace("20 s", "1 s")),
        tmp_path / "run",
        lambda port: keep_down(serial(port)),
    )
    assert ended.result.status == "done"


@pytest.mark.parametrize(
    ("answer", "match"),
    [
        ("PBTHC,0,0.1", "expected 8 commands, got 1"),
        ("PBTHC,0,2,0,0,0,0,0,0,0", r"expected commands from -1 to 1, got 2\.0"),
        ("PBTHC,0,nan,0,0,0,0,0,0,0", "expected commands from -1 to 1, got nan"),
        ("PBTHC,x", "invalid literal"),
        ("PBTHC,12", "expected tick 0, got 12"),
    ],
)
def test_answers_that_are_not_understood(tmp_path, answer, match):
    def program(port):
        handle = os.open(port, os.O_RDWR | os.O_NOCTTY)
        os.write(handle, nmea_sentence(answer))
        time.sleep(0.5)
        os.close(handle)

    failing(tmp_path, MISSION, program, match=match)


def test_half_frames_and_noise_are_skipped(tmp_path):
    def program(port):
        handle = os.open(port, os.O_RDWR | os.O_NOCTTY)
        for junk in (b"\x00\xff" * 50, b"$PBTHC,0,1", b"$PBTHC,0,1,1,1,1,1,1,1,1*00\r\n"):
            os.write(handle, junk)
        os.close(handle)
        return keep_down(serial(port))

    ended = run_with(written(tmp_path, MISSION.replace("20 s", "1 s")), tmp_path / "run", program)
    (found,) = json.loads((tmp_path / "run" / "links.json").read_text())["links"]
    assert ended.result.status == "done"
    assert found["broken"] == 1
    assert found["wrong_checksum"] == 1


@pytest.mark.parametrize(
    ("old", "new", "match"),
    [
        ("port: pty", "port: 'tcp:99999'", "expected a number below 65536"),
        ("port: pty", "port: 'udp:9002'", "expected pty or tcp for nmea"),
        ("port: pty", "port: /dev/ttyS0", "port"),
        ("name: port", "name: ../port", "name"),
        ("name: port", "name: port, devices: [sonar]", "expected some of .*, got 'sonar'"),
        ("name: port", "name: port, bit_error_rate: 0.1", "expected a baud with it"),
        ("name: port", "name: port, baud: 0", "baud"),
        ("protocol: nmea", "protocol: modbus", "protocol"),
        ("latitude: 43.1", "latitude: 95", "latitude"),
    ],
)
def test_mistakes_in_the_file(tmp_path, old, new, match):
    with pytest.raises(bathyal.Error, match=match):
        bathyal.run(written(tmp_path, MISSION.replace(old, new)), out=tmp_path / "run")


def test_positions_need_an_origin(tmp_path):
    text = "\n".join(row for row in AT_THE_SURFACE.splitlines() if "origin" not in row)
    text = text.replace("name: port", "name: port, sentences: standard")
    with pytest.raises(bathyal.Error, match=r"need the mission's origin: \{latitude"):
        bathyal.run(written(tmp_path, text), out=tmp_path / "run")


def test_a_line_counts_what_it_carries():
    line = SerialLine(baud=9600.0, buffer=100)
    assert line.carry(b"a" * 150 + b"\n", 0.0) == b""
    assert line.counts["lost"] == 51
    assert line.counts["waiting"] == 100
