# SPDX-License-Identifier: BSD-3-Clause
"""The files that a YAML document names, found within one folder; mistakes by their place."""

from __future__ import annotations

import os
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from bathyal._core import Error
from bathyal.io.files import PathLike, shown
from bathyal.io.yaml_documents import Document, Place
from bathyal.io.yaml_schema import at


class DocumentFiles:
    """One document, its files found within one folder: its own, or `inside`."""

    def __init__(self, document: Document, inside: PathLike | None) -> None:
        self.document = document
        self.within = Path(os.path.realpath(document.folder if inside is None else inside))
        self.warnings: list[str] = []

    @contextmanager
    def placed(self, place: Place) -> Iterator[None]:
        """What goes wrong inside is reported with the place it came from."""
        try:
            yield
        except (ValueError, OSError, Error) as error:
            raise at(self.document, place, error) from error

    def file(self, name: str, place: Place) -> Path:
        """A file by its name, which may not lead out of the folder."""
        with self.placed(place):
            path = Path(os.path.realpath(self.document.folder / name))
        if not path.is_relative_to(self.within):
            raise at(
                self.document,
                place,
                Error(
                    f"{shown(name)} lies outside {shown(self.within)}; where that is meant, name a "
                    "folder that holds it: inside=…, on the command line --inside"
                ),
            )
        if not path.is_file():
            raise at(self.document, place, FileNotFoundError(2, "no such file", name))
        return path
