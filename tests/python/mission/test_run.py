# SPDX-License-Identifier: BSD-3-Clause
"""Runs of missions: end to end, pure, resumed after a kill, by hand, read again, bad input."""

from __future__ import annotations

import json
import os
import random
import signal
import subprocess
import sys
import time

import numpy as np
import pytest

import bathyal
from bathyal.mission.example import write_mission_example

SHORT = """\
world: {water: {surface: 0}, terrain: {seabed: {size: [60, 60], spacing: 1, depth: 10}}}
vehicle: {preset: bluerov2_heavy}
start: {position: [0, 0, -0.5]}
faults: [{device: thruster_1, kind: dead, at: 8 s}]
mission:
  - dive: {depth: 3 m}
  - leg: {to: [6, 0], depth: 3 m, speed: 0.5 m/s}
  - photo
  - surface
"""


@pytest.fixture
def short(tmp_path):
    path = tmp_path / "mission.yaml"
    path.write_text(SHORT)
    return path


def test_the_example_is_run_to_its_end(tmp_path):
    path = tmp_path / "dive" / "mission.yaml"
    write_mission_example(path)
    run = bathyal.run(path, seed=1, out=tmp_path / "run")
    assert run.status == "done"
    assert run.metrics["position_rms"] < 1.0
    assert run.metrics["least_altitude"] > 1.0
    texts = [f"{event.kind} {event.text}" for event in run.events]
    assert "fault thruster_2 dead begins" in texts
    assert "report thruster_2 dead" in texts
    truth = run.log.messages("/truth")
    assert truth["time"][-1] == pytest.approx(run.metrics["duration"])
    assert truth["pose.position.z"][-1] > -1.0  # surfaced
    state = run.log.messages("/state")
    surveyed = (state["time"] > 60) & (state["time"] < 260)
    assert np.abs(state["altitude"][surveyed] - 3.0).max() < 1.0
    figure = run.plot(tmp_path / "run.png")
    assert len(figure.axes) == 5
    assert (tmp_path / "run.png").stat().st_size > 20_000


def files_of(folder):
    return {name: (folder / name).read_bytes() for name in ("log.mcap", "run.json")}


def test_the_same_mission_and_seed_give_the_same_bytes(short, tmp_path):
    bathyal.run(short, seed=3, out=tmp_path / "one")
    bathyal.run(short, seed=3, out=tmp_path / "two", save_every=5.0)
    bathyal.run(short, seed=4, out=tmp_path / "three")
    assert files_of(tmp_path / "one") == files_of(tmp_path / "two")
    assert files_of(tmp_path / "one") != files_of(tmp_path / "three")


def test_neither_locale_nor_environment_nor_folder_changes_a_byte(short, tmp_path):
    bathyal.run(short, seed=3, out=tmp_path / "one")
    code = f"import bathyal; bathyal.run({str(short)!r}, seed=3, out='two')"
    environment = {
        **os.environ,
        "LC_ALL": "de_DE.UTF-8",
        "TZ": "Asia/Tokyo",
        "OMP_NUM_THREADS": "1",
    }
    subprocess.run([sys.executable, "-c", code], cwd=tmp_path, env=environment, check=True)
    assert files_of(tmp_path / "one") == files_of(tmp_path / "two")


RESUMED = """\
import sys, bathyal
bathyal.run(sys.argv[1], seed=3, out=sys.argv[2], resume=True, save_every=2.0)
"""


def test_a_run_that_is_killed_is_resumed_to_the_same_bytes(short, tmp_path):
    bathyal.run(short, seed=3, out=tmp_path / "whole")
    draw = random.Random(1)
    command = [sys.executable, "-c", RESUMED, str(short), str(tmp_path / "killed")]
    kills = 0
    for _ in range(12):
        process = subprocess.Popen(command)
        time.sleep(0.25 + 0.6 * draw.random())
        process.send_signal(signal.SIGKILL)
        process.wait()
        kills += 1
        if (tmp_path / "killed" / "run.json").exists():
            break
    subprocess.run(command, check=True)
    assert kills >= 1
    assert files_of(tmp_path / "whole") == files_of(tmp_path / "killed")


def test_saved_states_at_any_tick_go_on_with_the_same_bytes(short, tmp_path):
    whole = bathyal.Run(short, seed=5, log=tmp_path / "whole.mcap")
    while whole.step():
        pass
    whole.close()
    expected = (tmp_path / "whole.mcap").read_bytes()
    going = bathyal.Run(short, seed=5, log=tmp_path / "going.mcap")
    states = []
    while going.step():
        states.append((going.save(), (tmp_path / "going.mcap").read_bytes()))
    assert len(states) >= 200
    for state, written in states[::10]:
        path = tmp_path / "resumed.mcap"
        path.write_bytes(written + b"what a crash left")
        resumed = bathyal.Run(short, seed=5, log=path, state=state)
        while resumed.step(count=50):
            pass
        resumed.close()
        assert path.read_bytes() == expected


def test_by_hand_with_inputs(short):
    run, pushed = bathyal.Run(short, seed=1), bathyal.Run(short, seed=1)
    aside = 0.0
    for _ in range(100):
        run.step()
        pushed.step({"wrench": [0, 20, 0, 0, 0, 0]})
        aside = max(aside, pushed.signals["y"] - run.signals["y"])
    assert run.signals["depth"] > 1.0
    assert 0.03 < aside < 0.5  # pushed to port, and held
    assert not run.step({"stop": True})
    assert run.status == "stopped"
    with pytest.raises(ValueError, match="inputs"):
        pushed.step({"speed": 3})
    with pytest.raises(ValueError, match="thrusters"):
        pushed.step({"thrusters": [1.0]})
    with pytest.raises(ValueError, match="wrench"):
        pushed.step({"wrench": [np.nan] * 6})


def test_read_run(short, tmp_path):
    run = bathyal.run(short, seed=3, out=tmp_path / "run")
    again = bathyal.read_run(tmp_path / "run")
    assert again.metrics == run.metrics
    assert again.events == run.events
    assert (again.seed, again.status, again.name) == (3, "done", "mission")
    assert again.log.topics == run.log.topics
    assert [event.text for event in again.faults] == ["thruster_1 dead begins"]
    with pytest.raises(KeyError, match="topic"):
        again.log.messages("/nothing")
    with pytest.raises(FileNotFoundError):
        bathyal.read_run(tmp_path / "nowhere")
    (tmp_path / "run" / "run.json").write_text(json.dumps({"name": 3}))
    with pytest.raises(bathyal.Error, match=r"run\.json"):
        bathyal.read_run(tmp_path / "run")
    (tmp_path / "run" / "run.json").unlink()
    with pytest.raises(bathyal.Error, match="resume"):
        bathyal.read_run(tmp_path / "run")


def test_remus_runs_a_survey_near_the_bottom(tmp_path):
    path = tmp_path / "mission.yaml"
    path.write_text(
        "world: {water: {surface: 0},"
        " terrain: {seabed: {size: [500, 200], spacing: 2, depth: 25, relief_rms: 0.5}}}\n"
        "vehicle: {preset: remus100}\n"
        "start: {position: [-150, 0, -2]}\n"
        "mission:\n"
        "  - leg: {to: [-60, 0], depth: 10 m, speed: 1.5 m/s, tolerance: 5 m}\n"
        "  - follow: {points: [[100, 0], [100, 40], [-60, 40]], altitude: 8 m, speed: 1.5 m/s,"
        " tolerance: 8 m}\n"
    )
    run = bathyal.run(path, seed=1)
    assert run.status == "done"
    assert run.metrics["least_altitude"] > 4.0
    assert run.metrics["distance"] > 400.0


@pytest.mark.parametrize("seed", [1, 2, 3])
def test_remus_keeps_three_metres_over_an_uneven_bottom(tmp_path, seed):
    path = tmp_path / "mission.yaml"
    path.write_text(
        "world: {water: {surface: 0},"
        " terrain: {seabed: {size: [500, 200], spacing: 2, depth: 25, relief_rms: 0.5}}}\n"
        "vehicle: {preset: remus100}\n"
        "start: {position: [-200, 0, -2]}\n"
        "mission:\n"
        "  - leg: {to: [-110, 0], depth: 10 m, speed: 1.5 m/s, tolerance: 5 m}\n"
        "  - follow: {points: [[150, 0], [150, 40], [-110, 40]], altitude: 3 m, speed: 1.5 m/s,"
        " tolerance: 8 m}\n"
    )
    run = bathyal.run(path, seed=seed)
    assert run.status == "done"
    assert run.metrics["least_altitude"] > 2.0
    altitude = run.log.messages("/state")["altitude"]
    assert np.median(altitude[len(altitude) // 3 :]) < 4.5


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ("dive: {depth: 3 m}", "dive: {depth: 3 kg}", r":6:12: .*expected a number and one of m"),
        ("dive: {depth: 3 m}", "dive: {depth: 3 m, altitude: 1}", "depth, altitude"),
        ("dive: {depth: 3 m}", "dive: {}", "depth, altitude"),
        ("dive: {depth: 3 m}", "fly: {height: 3}", r"this key is not known"),
        ("- photo", "- photos", r"not known"),
        ("- photo", "- check: depth > import os", "condition"),
        ("- photo", "- {photo: {}, ping: {}}", "expected one of"),
        ("- photo", "- {retry: {times: 0, do: photo}}", "times"),
        ("- photo", "- {timeout: {do: photo}}", "after"),
        ("- photo", "- {sample: {scenario: none.yaml}}", "no such file"),
        ("- photo", "- {sample: {scenario: /etc/passwd}}", "lies outside"),
        ("thruster_1", "thruster_9", "a device of the vehicle, got thruster_9"),
        ("kind: dead", "kind: sag", "fault kind"),
        ("at: 8 s", "at: .nan", r":4:"),
        ("at: 8 s", "size: 1", "expected one of at, when, rate"),
        ("bluerov2_heavy", "nautilus", "preset"),
        ("vehicle: {preset: bluerov2_heavy}", "vehicle: {mass: 3}", "expected"),
        ("speed: 0.5 m/s", "speed: 0", "speed"),
        ("mission:\n", "sensors: [{kind: sonar}]\nmission:\n", "kind"),
        ("mission:\n", "sensors: [{kind: dvl}, {kind: dvl}]\nmission:\n", "names that differ"),
        ("mission:\n", "mission: !!python/object:os.system\n", "tags"),
        ("mission:\n", "name: a\nname: b\nmission:\n", "comes twice"),
    ],
)
def test_mistakes_of_a_mission_are_reported_by_line(tmp_path, old, new, message):
    path = tmp_path / "mission.yaml"
    assert old in SHORT
    path.write_text(SHORT.replace(old, new))
    with pytest.raises(bathyal.Error, match=message):
        bathyal.read_mission(path)


def test_a_saved_state_of_another_run_is_refused(short):
    run = bathyal.Run(short, seed=1)
    run.step(count=10)
    state = run.save()
    with pytest.raises(bathyal.Error, match="seed 1"):
        bathyal.Run(short, seed=2, state=state)
    with pytest.raises(bathyal.Error):
        bathyal.Run(short, seed=1, state=state[:-5])
    with pytest.raises(bathyal.Error):
        bathyal.Run(short, seed=1, state=b"")


def test_a_log_that_cannot_be_written_is_named(short, tmp_path):
    with pytest.raises(bathyal.Error, match="no/such"):
        bathyal.Run(short, seed=1, log=tmp_path / "no" / "such" / "log.mcap")


def test_two_programs_do_not_run_in_one_folder(short, tmp_path):
    out = tmp_path / "run"

    def another(_time):
        with pytest.raises(bathyal.Error, match="another program runs a mission"):
            bathyal.run(short, seed=1, out=out, resume=True)

    assert bathyal.run(short, seed=1, out=out, save_every=5.0, progress=another).status == "done"
    assert bathyal.run(short, seed=1, out=out).status == "done"  # free again


@pytest.mark.skipif(not os.path.exists("/dev/full"), reason="this system has no /dev/full")
def test_a_full_disk_is_an_error(short, tmp_path):
    (tmp_path / "run").mkdir()
    (tmp_path / "run" / "log.mcap").symlink_to("/dev/full")
    with pytest.raises(bathyal.Error, match=r"log\.mcap: No space left on device"):
        bathyal.run(short, seed=1, out=tmp_path / "run")


LIMITED = """\
import resource, sys, bathyal
if sys.argv[3]:
    resource.setrlimit(resource.RLIMIT_FSIZE, (int(sys.argv[3]),) * 2)
bathyal.run(sys.argv[1], seed=3, out=sys.argv[2], resume=True, save_every=2.0)
"""


def limited(mission, out, size):
    """What a program says that may write files of `size` bytes, None: of any."""
    command = [sys.executable, "-c", LIMITED, str(mission), str(out), str(size or "")]
    return subprocess.run(command, capture_output=True, text=True).stderr


def test_a_run_whose_disk_was_full_is_resumed_to_the_same_bytes(short, tmp_path):
    bathyal.run(short, seed=3, out=tmp_path / "whole")
    end = (tmp_path / "whole" / "log.mcap").stat().st_size
    for size in (end // 5, end // 2, end - 1):
        assert "bathyal._core.Error: " + str(tmp_path / "full" / "log.mcap") in limited(
            short, tmp_path / "full", size
        )
        assert not (tmp_path / "full" / "run.json").exists()
    assert limited(short, tmp_path / "full", None) == ""
    assert files_of(tmp_path / "whole") == files_of(tmp_path / "full")


def test_a_disk_that_is_full_when_the_state_is_saved_is_named(tmp_path):
    path = tmp_path / "mission.yaml"
    path.write_text(
        "world: {water: {surface: 0}, terrain: {seabed: {size: [60, 60], spacing: 1, depth: 10}}}\n"
        "vehicle: {preset: bluerov2_heavy}\n"
        "sensors: [{kind: depth, rate: 1}, {kind: imu, rate: 10}, {kind: dvl, rate: 1},"
        " {kind: compass, rate: 1}]\nmission: [wait: {time: 15 s}]\n"
    )
    assert "bathyal._core.Error: " + str(tmp_path / "full" / "state.bin") in limited(
        path, tmp_path / "full", 30_000
    )


def test_a_log_that_was_not_written_is_not_gone_on_with(short, tmp_path):
    (tmp_path / "log.mcap").symlink_to("/dev/full")
    going = bathyal.Run(short, seed=1, log=tmp_path / "log.mcap")
    with pytest.raises(bathyal.Error, match="No space left"):
        going.step(count=10_000)
    with pytest.raises(bathyal.Error, match=r"log\.mcap: the log is closed"):
        going.save()


def test_of_two_programs_that_resume_a_run_one_is_refused(short, tmp_path):
    out, said = tmp_path / "run", []

    def another(_time):
        said.append(limited(short, out, None))

    result = bathyal.run(short, seed=3, out=out, save_every=5.0, progress=another)
    assert result.status == "done"
    assert said
    assert all(f"Error: {out}: another program runs a mission in it" in text for text in said)
    whole = bathyal.run(short, seed=3, out=tmp_path / "whole")
    assert whole.status == "done"
    assert files_of(out) == files_of(tmp_path / "whole")


def with_sampler(tmp_path, fault):
    """A light arm that takes a sample of 40 N for 20 s, on a mission that goes on without it."""
    text = SHORT.replace(
        "- photo", "- fallback: [{sequence: [{sample: {scenario: s.yaml}}, photo]}, photo]"
    ).replace("faults: [", "faults: [" + fault + ", " if fault else "faults: [")
    path = tmp_path / "mission.yaml"
    path.write_text(text)
    return path


@pytest.fixture
def light_sample(monkeypatch):
    """In place of a scenario's plan."""
    from bathyal.mission.build import MissionBuilder

    time_ = np.array([0.0, 5.0, 10.0, 15.0, 20.0])
    wrench = np.zeros((5, 6))
    wrench[1:, 2], wrench[1:4, 4] = [-2.0, -2.0, -6.0, -6.0], 1.5
    empty = wrench.copy()
    empty[3:, 2] = -2.0
    made = {"wrench_time": time_, "wrench": wrench, "empty_wrench": empty, "tolerance": 1.0}
    monkeypatch.setattr(MissionBuilder, "sample", lambda *_: made)


def ended(path):
    run = bathyal.run(path, seed=1)
    return run, [f"{event.kind} {event.text}" for event in run.events]


def test_a_sample_is_taken_or_lost(light_sample, tmp_path):
    run, _ = ended(with_sampler(tmp_path, ""))
    assert run.status == "done"
    assert run.metrics["samples"] == 1
    lost, texts = ended(with_sampler(tmp_path, "{device: arm, kind: lost, at: 25 s}"))
    assert "command sample succeeds" in texts  # nothing on board shows it
    assert lost.metrics["samples"] == 0
    height = [one.log.messages("/truth")["pose.position.z"] for one in (run, lost)]
    count = min(map(len, height))
    assert np.abs(height[0][:count] - height[1][:count]).max() > 0.005  # it weighs less


def test_a_joint_that_is_stuck_is_reported_and_the_arm_stays_there(light_sample, tmp_path):
    path = with_sampler(tmp_path, "{device: arm, kind: stuck, at: 28 s}")
    run, texts = ended(path)
    assert "report arm stuck" in texts
    assert "command sample fails" in texts
    assert run.status == "done"
    assert run.metrics["samples"] == 0
    when = next(event.time for event in run.events if event.text == "arm stuck")
    assert 28.9 < when < 29.3
    going = bathyal.Run(path, seed=1)
    going.step(count=int(when * 10) + 20)
    assert going.signals["fault.arm"] == 1.0
    state = going.save()
    other = bathyal.Run(path, seed=1, state=state)
    going.step(count=50)
    other.step(count=50)
    np.testing.assert_array_equal(going.pose, other.pose)


def test_arm_faults_need_an_arm(short):
    short.write_text(SHORT.replace("faults: [", "faults: [{device: arm, kind: stuck, at: 1 s}, "))
    with pytest.raises(bathyal.Error, match="expected a device of the vehicle, got arm"):
        bathyal.read_mission(short)


def test_units():
    from bathyal.mission.quantities import parsed

    assert parsed("7 min", "s") == 420.0
    assert parsed("2 kn", "m/s") == pytest.approx(1.0289, abs=1e-4)
    assert parsed("90 deg", "rad") == pytest.approx(np.pi / 2)
    for text in ("7", "m", "7 m 3", "1e999 q", "--3 m"):
        with pytest.raises(ValueError, match="expected a number"):
            parsed(text, "m")


def test_the_schema_is_json():
    from bathyal.mission.files import mission_schema

    assert "mission" in json.loads(json.dumps(mission_schema()))["required"]


def test_a_sample_takes_the_wrench_of_its_scenario(tmp_path):
    from bathyal.workspace.example import write_example

    write_example(tmp_path / "scene")
    path = tmp_path / "mission.yaml"
    path.write_text(SHORT.replace("- photo", "- sample: {scenario: scene/scenario.yaml}"))
    commands = bathyal.read_mission(path).commands
    sample = next(command for command in commands if command["kind"] == "sample")
    assert np.abs(sample["wrench"][0]).max() == 0.0
    assert np.abs(sample["wrench"][:, 4]).max() > 1.0
    assert (np.diff(sample["wrench_time"]) >= 0).all()
    assert np.abs(sample["wrench"] - sample["empty_wrench"])[-1].max() > 0.1  # the sample
    np.testing.assert_array_equal(sample["wrench"][:50], sample["empty_wrench"][:50])
    # That example's arm is too heavy for this vehicle: the mission says so by failing.
    run = bathyal.run(path, seed=1)
    assert run.status == "failed"
    assert "sample fails" in [event.text for event in run.events]
