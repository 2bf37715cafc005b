# SPDX-License-Identifier: BSD-3-Clause
"""Files are replaced whole or not at all, and refused in one way."""

from __future__ import annotations

import os
import stat
import struct

import pytest

import bathyal
from bathyal.io.files import need, opened, reading, replacing
from bathyal.io.formats.xml.safe import parse_xml


def test_a_file_appears_whole(tmp_path):
    target = tmp_path / "out.csv"
    with replacing(target) as aside:
        assert aside.parent.parent == tmp_path
        assert aside.suffix == ".csv"
        aside.write_text("1 2 3\n")
        assert not target.exists()
    assert target.read_text() == "1 2 3\n"
    assert list(tmp_path.iterdir()) == [target]


def write_half_and_raise(path, error):
    path.write_text("half")
    raise error


@pytest.mark.parametrize("interruption", [RuntimeError, KeyboardInterrupt, SystemExit])
def test_what_was_there_stays_when_writing_fails(tmp_path, interruption):
    target = tmp_path / "out.csv"
    target.write_text("old")
    with pytest.raises(interruption), replacing(target) as aside:
        write_half_and_raise(aside, interruption)
    assert target.read_text() == "old"
    assert list(tmp_path.iterdir()) == [target]


def test_rights_and_links_are_kept(tmp_path):
    target, link = tmp_path / "real.csv", tmp_path / "link.csv"
    target.write_text("old")
    target.chmod(0o640)
    link.symlink_to(target)
    with replacing(link) as aside:
        aside.write_text("new")
    assert link.is_symlink()
    assert target.read_text() == "new"
    assert stat.S_IMODE(target.stat().st_mode) == 0o640


def test_a_new_file_has_the_rights_any_new_file_gets(tmp_path):
    with replacing(tmp_path / "ours") as aside:
        aside.write_text("a")
    (tmp_path / "plain").write_text("a")
    assert (tmp_path / "ours").stat().st_mode == (tmp_path / "plain").stat().st_mode


def test_places_that_cannot_be_written_are_named(tmp_path):
    inside_nowhere = tmp_path / "no" / "out.csv"
    refused = pytest.raises(FileNotFoundError, match="cannot write")
    with refused as missing, replacing(inside_nowhere):
        pass
    assert missing.value.filename == str(inside_nowhere)
    with pytest.raises(IsADirectoryError), replacing(tmp_path):
        pass
    (tmp_path / "file").touch()
    with pytest.raises(NotADirectoryError), replacing(tmp_path / "file" / "out.csv"):
        pass


@pytest.mark.skipif(os.geteuid() == 0, reason="root may write anywhere")
def test_protected_places_are_named(tmp_path):
    target = tmp_path / "out.csv"
    target.write_text("old")
    target.chmod(0o444)
    with pytest.raises(PermissionError, match="write-protected"), replacing(target):
        pass
    tmp_path.chmod(0o555)
    with pytest.raises(PermissionError, match="cannot write"), replacing(tmp_path / "new.csv"):
        pass
    tmp_path.chmod(0o755)


def test_a_device_is_written_as_it_is():
    with replacing("/dev/null") as aside:
        aside.write_text("gone")
    assert stat.S_ISCHR(os.stat("/dev/null").st_mode)


def test_library_errors_become_ours_with_the_file_and_the_cause():
    refused = pytest.raises(bathyal.Error, match=r"^a\.las: not a readable LAS file: unpack")
    with refused as caught, reading("a.las", "LAS"):
        struct.unpack("<q", b"1")
    assert isinstance(caught.value.__cause__, struct.error)
    with pytest.raises(bathyal.Error, match=r"^a\.las: cut short$"), reading("a.las", "LAS"):
        raise bathyal.Error("cut short")
    with pytest.raises(bathyal.Error, match="'points' is missing"), reading("a.las", "LAS"):
        {}["points"]
    with pytest.raises(KeyboardInterrupt), reading("a.las", "LAS"):
        raise KeyboardInterrupt


def test_empty_and_missing_files(tmp_path):
    (tmp_path / "empty").touch()
    with pytest.raises(bathyal.Error, match="the file is empty"), opened(tmp_path / "empty"):
        pass
    with pytest.raises(FileNotFoundError), opened(tmp_path / "none"):
        pass
    with pytest.raises(bathyal.Error, match="a pipe or a device"), opened("/dev/null"):
        pass


def test_a_missing_library_names_its_remedy():
    with pytest.raises(bathyal.Error, match=r"reading moon dust needs .* pip install 'moondust'"):
        need("moondust", "moondust", "reading moon dust")


def test_xml_with_entities_is_refused():
    assert parse_xml(b"<a b='1'><c>text</c></a>")[0].text == "text"
    assert parse_xml(b"<a xmlns='urn:x'/>").tag == "{urn:x}a"
    for text in (b"<!DOCTYPE a><a/>", b"<!DOCTYPE a [<!ENTITY b 'c'>]><a>&b;</a>"):
        with pytest.raises(bathyal.Error, match="document type"):
            parse_xml(text)
    with pytest.raises(bathyal.Error, match="line 1"):
        parse_xml(b"<a><b></a>")
