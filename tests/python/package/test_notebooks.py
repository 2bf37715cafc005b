# SPDX-License-Identifier: BSD-3-Clause
"""Every notebook runs from beginning to end, and is kept without its outputs."""

from __future__ import annotations

import pathlib
import shutil

import pytest

nbformat = pytest.importorskip("nbformat")
nbclient = pytest.importorskip("nbclient")

ROOT = pathlib.Path(__file__).parents[3]
NOTEBOOKS = sorted((ROOT / "notebooks").glob("*.ipynb"))
SECONDS_A_CELL = 300


def test_there_are_notebooks():
    assert NOTEBOOKS


@pytest.mark.parametrize("file", NOTEBOOKS, ids=lambda file: file.stem)
def test_notebook_runs(file, tmp_path):
    """In a folder of its own, from which ../../shared/data is where it is from the notebooks."""
    folder = tmp_path / "project" / "notebooks"
    folder.mkdir(parents=True)
    if (ROOT / "../shared").exists():
        (tmp_path / "shared").symlink_to((ROOT / "../shared").resolve())
    shutil.copy(file, folder)
    notebook = nbformat.read(file, as_version=4)
    client = nbclient.NotebookClient(
        notebook,
        timeout=SECONDS_A_CELL,
        kernel_name="python3",
        resources={"metadata": {"path": str(folder)}},
    )
    client.execute()
    assert sorted(path.name for path in folder.iterdir()) == [file.name]


@pytest.mark.parametrize("file", NOTEBOOKS, ids=lambda file: file.stem)
def test_notebook_is_kept_without_outputs(file):
    notebook = nbformat.read(file, as_version=4)
    for cell in notebook.cells:
        assert not cell.get("outputs")
        assert cell.get("execution_count") is None
