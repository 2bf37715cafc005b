# SPDX-License-Identifier: BSD-3-Clause
"""A folder of results changes as one set, whenever the process that writes it is killed."""

from __future__ import annotations

import json
import os
import signal
import subprocess
import sys

import pytest

import bathyal
from bathyal.io.asides import aside_in
from bathyal.io.files import replacing
from bathyal.io.formats.vtp.reader import read_vtp
from bathyal.io.formats.vtp.writer import write_vtp
from bathyal.io.manifest import NAME
from bathyal.io.result_sets import filling

OLD, NEW, NEXT = 0.3, 0.5, 0.7
FILES = ("arm.json", "arm.urdf", "seabed.vtp", "table.csv")


def lever(length):
    return bathyal.Arm.from_dh(a=[length], alpha=[0], d=[0], theta=[0], name="lever")


def write_set(folder, length, job="identify", more=()):
    with filling(folder, job) as aside:
        lever(length).save(aside / "arm.json")
        lever(length).write(aside / "arm.urdf")
        write_vtp(aside / "seabed.vtp", [[length, 0, 0]], vertices=[0])
        (aside / "table.csv").write_text(f"length_m\n{length}\n")
        for name in more:
            (aside / name).write_text(f"# {length}\n")


def read_length(file):
    if file.suffix == ".vtp":
        return read_vtp(file).points[0, 0]
    return round(float(bathyal.read_arm(file).forward([0.0])[0, 3]), 9)


def what_is_read(folder):
    """Of each file that we read: its arm's length, "refused" or "missing"."""
    found = set()
    for name in FILES[:3]:
        try:
            found.add(read_length(folder / name))
        except FileNotFoundError:
            found.add("missing")
        except bathyal.Error as error:
            said = str(error)
            named = said.startswith(f"{folder / name}: ")
            remedy = "run bathyal identify into this folder again" in said
            found.add("refused" if named and remedy else said)
    return found


def hidden(folder):
    return [name for name in os.listdir(folder) if name.startswith(".")]


def count_renames(folder):
    calls = []
    real = os.replace

    def counted(*names):
        calls.append(names)
        return real(*names)

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(os, "replace", counted)
        write_set(folder, NEW)
    return len(calls)


def killed_at(folder, rename):
    """Writes a set in a process of its own, which is killed before that rename."""
    child = os.fork()
    if child == 0:
        try:
            real, left = os.replace, [rename]

            def lethal(*names):
                if left[0] == 0:
                    os.kill(os.getpid(), signal.SIGKILL)
                left[0] -= 1
                return real(*names)

            os.replace = lethal
            write_set(folder, NEW)
        finally:
            os._exit(0)
    return os.waitstatus_to_exitcode(os.waitpid(child, 0)[1])


@pytest.mark.parametrize("before", [None, OLD])
def test_killed_at_any_rename_the_set_is_whole_or_refused(tmp_path, before):
    renames = count_renames(tmp_path / "count")
    seen = set()
    for rename in range(renames + 1):
        folder = tmp_path / f"{rename}"
        if before is not None:
            write_set(folder, before)
        status = killed_at(folder, rename)
        assert status == (-signal.SIGKILL if rename < renames else 0)
        found = what_is_read(folder)
        assert found in ({before or "missing"}, {NEW}, {"refused"}, {"refused", "missing"}), rename
        assert bool(hidden(folder)) == (rename < renames)
        seen |= found
        write_set(folder, NEXT)
        assert what_is_read(folder) == {NEXT}
        assert sorted(os.listdir(folder)) == sorted([*FILES, NAME])
    assert {before or "missing", NEW, "refused"} <= seen


def test_killed_again_and_again_in_earnest(tmp_path):
    """kill -9 wherever it happens to be."""
    program = (
        "import itertools, sys; sys.path.insert(0, sys.argv[2])\n"
        "from pathlib import Path\n"
        "from test_result_sets import write_set, OLD, NEW\n"
        "for n in itertools.count():\n"
        "    print(flush=True); write_set(Path(sys.argv[1]), (OLD, NEW)[n % 2])\n"
    )
    folder = tmp_path / "out"
    for lines in (1, 2, 3, 5, 8):
        child = subprocess.Popen(
            [sys.executable, "-c", program, folder, os.path.dirname(__file__)],
            stdout=subprocess.PIPE,
        )
        for _ in range(lines):
            child.stdout.readline()
        child.kill()
        child.communicate()
        if folder.exists():
            found = what_is_read(folder)
            assert found in ({OLD}, {NEW}, {"missing"}, {"refused"}, {"refused", "missing"})
    write_set(folder, NEXT)
    assert what_is_read(folder) == {NEXT}
    assert not hidden(folder)


@pytest.mark.parametrize("fault", [OSError, KeyboardInterrupt])
def test_when_moving_fails_all_is_as_it_was(tmp_path, monkeypatch, fault):
    renames = count_renames(tmp_path / "count")
    write_set(tmp_path / "out", OLD, more=["notes.yaml"])
    before = {p.name: p.read_bytes() for p in (tmp_path / "out").iterdir()}
    real = os.replace
    for rename in range(renames):
        left = [rename]

        def failing(*names, left=left):
            left[0] -= 1
            if left[0] == -1:
                raise fault
            return real(*names)

        monkeypatch.setattr(os, "replace", failing)
        for name in ("out", "fresh"):
            left[0] = rename
            with pytest.raises(fault):
                write_set(tmp_path / name, NEW)
        monkeypatch.setattr(os, "replace", real)
        assert {p.name: p.read_bytes() for p in (tmp_path / "out").iterdir()} == before, rename
        assert not (tmp_path / "fresh").exists()


def test_a_folder_in_the_place_of_a_file_is_refused_and_kept(tmp_path):
    (tmp_path / "arm.urdf").mkdir()
    (tmp_path / "arm.urdf" / "own").touch()
    with pytest.raises(IsADirectoryError, match=r"arm\.urdf"):
        write_set(tmp_path, NEW)
    assert os.listdir(tmp_path) == ["arm.urdf"]
    assert (tmp_path / "arm.urdf" / "own").exists()


def test_what_the_dead_left_goes_and_what_the_living_hold_stays(tmp_path):
    for write in (
        lambda folder: write_set(folder, NEW),
        lambda folder: lever(NEW).save(folder / "arm.json"),
    ):
        folder = tmp_path / f"{len(os.listdir(tmp_path))}"
        folder.mkdir()
        (folder / ".own").mkdir()
        (folder / ".bathyal-dead").mkdir()
        (folder / ".bathyal-dead" / "arm.json").touch()
        with aside_in(folder) as living:
            write(folder)
            assert sorted(hidden(folder)) == sorted([".own", living.name])
        assert hidden(folder) == [".own"]


def test_what_a_run_does_not_write_again_goes_unless_it_was_changed(tmp_path):
    write_set(tmp_path, OLD, more=["kinematics.yaml", "calibration.conf"])
    (tmp_path / "calibration.conf").write_text("# my own\n")
    (tmp_path / "notes.txt").touch()
    write_set(tmp_path, NEW)
    assert sorted(os.listdir(tmp_path)) == sorted([*FILES, NAME, "calibration.conf", "notes.txt"])


def test_jobs_that_share_a_folder_keep_their_sets(tmp_path):
    write_set(tmp_path, OLD)
    with filling(tmp_path, "diagnose") as aside:
        lever(NEW).save(aside / "model.json")
        lever(NEW).write(aside / "arm.urdf")
    jobs = {one["job"]: one for one in json.loads((tmp_path / NAME).read_text())["sets"]}
    assert set(jobs["identify"]["files"]) == {"arm.json", "seabed.vtp", "table.csv"}
    assert set(jobs["diagnose"]["files"]) == {"arm.urdf", "model.json"}
    assert [read_length(tmp_path / name) for name in ("arm.json", "model.json", "arm.urdf")] == [
        OLD, NEW, NEW,
    ]  # fmt: skip


def test_a_changed_file_is_refused_by_name_and_the_rest_is_not(tmp_path):
    write_set(tmp_path, OLD)
    (tmp_path / "arm.json").write_text((tmp_path / "arm.json").read_text().replace("0.3", "0.4"))
    (tmp_path / "mine.json").write_bytes((tmp_path / "arm.json").read_bytes())
    said = (
        r"arm\.json: expected the file as written by bathyal identify, run [0-9a-f]{16}, got "
        "another: run .* or delete bathyal-manifest"
    )
    with pytest.raises(bathyal.Error, match=said):
        bathyal.read_arm(tmp_path / "arm.json")
    (tmp_path / "link.json").symlink_to(tmp_path / "arm.json")
    with pytest.raises(bathyal.Error, match="got another"):
        bathyal.read_arm(tmp_path / "link.json")
    assert read_length(tmp_path / "mine.json") == 0.4
    assert read_length(tmp_path / "arm.urdf") == OLD
    lever(NEW).save(tmp_path / "arm.json")  # on purpose, and whole
    assert read_length(tmp_path / "arm.json") == NEW
    (tmp_path / NAME).unlink()
    assert read_length(tmp_path / "arm.urdf") == OLD


@pytest.mark.parametrize("content", [b"", b"\xff", b"[]", b'{"format": "bathyal results"}',
    b'{"format": "bathyal results", "version": 1, "sets": [{"job": 1}]}',
    b'{"format": "bathyal results", "version": 1, "sets": [{"job": "a", "run": "b", '
    b'"complete": true, "files": ["arm.json"]}]}'])  # fmt: skip
def test_a_broken_manifest_is_named_and_replaced_by_the_next_run(tmp_path, content):
    write_set(tmp_path, OLD)
    (tmp_path / NAME).write_bytes(content)
    with pytest.raises(bathyal.Error, match=f"{NAME}: not a manifest .* delete it"):
        bathyal.read_arm(tmp_path / "arm.json")
    write_set(tmp_path, NEW)
    assert what_is_read(tmp_path) == {NEW}


def test_every_file_that_has_a_place_bears_the_run(tmp_path):
    vtk = pytest.importorskip("vtk", reason="vtk is not installed")
    from matplotlib.figure import Figure
    from matplotlib.image import imread

    from bathyal.view.figure import write_png

    def write(folder):
        with filling(folder, "plan") as aside:
            write_vtp(aside / "seabed.vtp", [[1, 2, 3]], vertices=[0])
            write_png(Figure((1, 1)), aside / "plan.png")
            (aside / "plan.html").write_text("<!DOCTYPE html>\n<html>\n<head>\n</head>\n</html>\n")
            (aside / "path.csv").write_text("# tool path\nx_m\n1\n")
            (aside / "plain.csv").write_text("x_m\n1\n")

    write(tmp_path / "a")
    write(tmp_path / "b")
    first, again = ({p.name: p.read_bytes() for p in (tmp_path / n).iterdir()} for n in "ab")
    assert first == again, "the same results are the same bytes"
    run = json.loads(first[NAME])["sets"][0]["run"]
    for name, content in first.items():
        assert (run.encode() in content) == (name != "plain.csv"), name
    assert imread(tmp_path / "a" / "plan.png").ndim == 3
    reader = vtk.vtkXMLPolyDataReader()
    reader.SetFileName(str(tmp_path / "a" / "seabed.vtp"))
    reader.Update()
    assert reader.GetOutput().GetPoint(0) == (1, 2, 3)


def test_a_single_file_is_written_through_a_folder_that_goes(tmp_path):
    with replacing(tmp_path / "depths.txt") as aside:
        aside.write_text("-51.2")
        assert aside.parent.parent == tmp_path
    assert os.listdir(tmp_path) == ["depths.txt"]
