# SPDX-License-Identifier: BSD-3-Clause
"""`make wheel`: a wheel that imports and plans where PCL, VTK and Ceres are not installed."""

import os
import re
import shutil
import subprocess
import sys
import zipfile
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[3]
SYSTEM_LIBRARIES = {
    "libc.so.6",
    "libm.so.6",
    "libstdc++.so.6",
    "libgcc_s.so.1",
    "ld-linux-x86-64.so.2",
}

# Hides every library of PCL, VTK and Ceres behind an empty file, in a mount namespace of its own.
HIDE = """
for library in $(find /usr/lib /usr/local/lib -name 'libpcl_*' -o -name 'libvtk*' \\
                 -o -name 'libceres*'); do
  mount --bind /dev/null "$library"
done
exec "$@"
"""


def run(*command: str | Path, **kwargs: object) -> subprocess.CompletedProcess[str]:
    done = subprocess.run([str(c) for c in command], capture_output=True, text=True, **kwargs)  # type: ignore[call-overload]
    assert done.returncode == 0, f"{command}\n{done.stdout}\n{done.stderr}"
    return done


@pytest.fixture(scope="module")
def wheel() -> Path:
    run("make", "wheel", cwd=ROOT)
    wheels = list((ROOT / "dist").glob("*.whl"))
    assert len(wheels) == 1
    return wheels[0]


@pytest.fixture(scope="module")
def bare(wheel: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The bin folder of a virtual environment that holds the wheel and its dependencies only."""
    folder = tmp_path_factory.mktemp("bare")
    run(sys.executable, "-m", "venv", folder)
    run(folder / "bin/pip", "install", "-q", "-c", ROOT / "constraints.txt", wheel)
    return folder / "bin"


@pytest.fixture(scope="module")
def hidden() -> list[str]:
    """The start of a command that runs with the heavy libraries hidden."""
    start = ["unshare", "--user", "--map-root-user", "--mount", "sh", "-c", HIDE, "sh"]
    if shutil.which("unshare") is None or subprocess.run([*start, "true"]).returncode != 0:
        pytest.skip("unshare is not allowed to hide libraries on this machine")
    return start


def test_is_repaired_and_links_the_system_only(wheel: Path, tmp_path: Path) -> None:
    assert "manylinux" in wheel.name
    with zipfile.ZipFile(wheel) as archive:
        libraries = [name for name in archive.namelist() if ".so" in name]
        archive.extractall(tmp_path)
    assert len(libraries) == 1, libraries
    needed = run("readelf", "-d", tmp_path / libraries[0]).stdout
    assert set(re.findall(r"NEEDED.*\[(.*)\]", needed)) <= SYSTEM_LIBRARIES
    assert wheel.stat().st_size < 8_000_000


def test_an_install_is_light_and_reads_what_needs_no_extra(bare: Path, tmp_path: Path) -> None:
    code = (
        "import bathyal, pathlib, sysconfig\n"
        "arm = bathyal.arms.ur10e()\n"
        "arm.write('arm.urdf')\n"
        "assert bathyal.read_arm('arm.urdf').size == 6\n"
        "for name, package in (('a.bag', 'h5py'), ('a.tif', 'rasterio')):\n"
        "    pathlib.Path(name).write_bytes(bytes(100))\n"
        "    try: bathyal.read_cloud(name)\n"
        "    except bathyal.Error as error: text = str(error)\n"
        "    assert package in text and '[geo]' in text, text\n"
        "own = ('pip', 'setuptools', 'pkg_resources')  # the environment's, not the wheel's\n"
        "folder = pathlib.Path(sysconfig.get_paths()['purelib'])\n"
        "parts = [part for part in folder.iterdir() if not part.name.startswith(own)]\n"
        "files = [file for part in parts for file in part.rglob('*')]\n"
        "print(sum(file.stat().st_size for file in files if file.is_file()))\n"
    )
    done = run(bare / "python", "-c", code, cwd=tmp_path)
    assert int(done.stdout) < 300e6


def test_plans_with_the_heavy_libraries_hidden(
    bare: Path, hidden: list[str], tmp_path: Path
) -> None:
    environment = {k: v for k, v in os.environ.items() if not k.startswith("PYTHON")}
    survey, aims = tmp_path / "survey.xyz", tmp_path / "aims.csv"
    bathyal = [*hidden, bare / "bathyal"]
    run(*bathyal, "soundings", survey, "--aims-out", aims, env=environment, cwd=tmp_path)
    out = tmp_path / "plan"
    run(*bathyal, "plan", survey, "--aims", aims, "--out", out, env=environment, cwd=tmp_path)
    names = {"path.csv", "path.json", "path.vtp", "seabed.vtp", "plan.png", "plan.html"}
    assert names <= {path.name for path in out.iterdir()}


def test_greedy_names_the_remedy(bare: Path, hidden: list[str], tmp_path: Path) -> None:
    code = (
        "import bathyal, numpy as np\n"
        "points = np.random.default_rng(1).random((50, 3))\n"
        "try: bathyal.triangulate(points, method='greedy')\n"
        "except bathyal.Error as error: print(error)\n"
    )
    done = run(*hidden, bare / "python", "-c", code, cwd=tmp_path)
    assert "libpcl-dev" in done.stdout
