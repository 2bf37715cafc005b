# SPDX-License-Identifier: BSD-3-Clause
"""Where the mesh of a shape lies: found when asked for, and only where the caller lets it be."""

from __future__ import annotations

import os
from collections.abc import Mapping
from pathlib import Path
from urllib.parse import unquote

from bathyal._core import Error, Shape
from bathyal.errors import argument_error
from bathyal.io.files import PathLike

_PACKAGE = "package://"
_FILE = "file://"


def mesh_path(
    shape: Shape,
    *,
    folder: PathLike | None = None,
    packages: Mapping[str, PathLike] | None = None,
    inside: PathLike | None = None,
) -> Path:
    """The file of a shape's mesh.

    A robot's file may name any file of the machine, so that a name is followed only into `folder`
    and the folders of `packages`, links resolved; what lies elsewhere must be asked for by
    `inside`.

    Parameters
    ----------
    shape : Shape
        Of kind "mesh".
    folder : path, optional
        Where relative names start: that of the URDF unless given.
    packages : dict of paths, optional
        By the name of a ROS package, its folder: what ``package://name/…`` starts from.
    inside : path, optional
        A folder in which meshes may lie; that and all below it, in place of `folder`.

    Returns
    -------
    pathlib.Path
        Absolute, of a file that is there. Nothing of it has been read.

    Raises
    ------
    ValueError
        For a shape that is no mesh, a package that is not in `packages`, a relative name where no
        folder is known.
    FileNotFoundError
        Where there is no such file.
    Error
        For a name that leads out of the folders above, or to an address in a network.

    Examples
    --------
    >>> import bathyal, pathlib, tempfile
    >>> folder = pathlib.Path(tempfile.mkdtemp())
    >>> _ = (folder / "hand.stl").write_bytes(bytes(84))
    >>> shape = bathyal.Shape("mesh", file="package://gripper/hand.stl")
    >>> bathyal.mesh_path(shape, packages={"gripper": folder}).name
    'hand.stl'
    """
    if shape.kind != "mesh":
        raise argument_error("shape", "a mesh", f"a {shape.kind}")
    path, allowed = _named(str(shape.file), shape.folder if folder is None else folder, packages)
    found = Path(os.path.realpath(path))
    within = Path(os.path.realpath(allowed if inside is None else inside))
    if not found.is_relative_to(within):
        raise Error(
            f"mesh {shape.file}: it lies outside {within}; where that is meant, name a folder "
            "that holds it: inside=…"
        )
    if not found.is_file():
        raise FileNotFoundError(2, "no such mesh", os.fspath(found))
    return found


def _named(
    name: str, folder: PathLike, packages: Mapping[str, PathLike] | None
) -> tuple[Path, Path]:
    """The path that a name gives, and the folder in which it may lie."""
    if name.startswith(_PACKAGE):
        package, _, rest = unquote(name[len(_PACKAGE) :]).partition("/")
        if package not in (packages or {}):
            known = ", ".join(packages or {}) or "none"
            raise argument_error("packages", f"the folder of {package!r}, for {name}", known)
        start = Path(dict(packages or {})[package])
        return start / rest.lstrip("/"), start
    if name.startswith(_FILE):
        name = unquote(name[len(_FILE) :])
    elif "://" in name:
        raise Error(f"mesh {name}: expected a file or {_PACKAGE}…, which this is not")
    if not os.fspath(folder):
        raise argument_error("folder", f"where {name!r} starts from", "none")
    return Path(folder) / name, Path(folder)
