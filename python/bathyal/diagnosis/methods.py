# SPDX-License-Identifier: BSD-3-Clause
"""What a diagnosis does in Python: its text, its files. Attached when the package is imported."""

from __future__ import annotations

import os

from bathyal._core import Diagnosis
from bathyal.attach import methods_of


@methods_of(Diagnosis)
class _Diagnosis(Diagnosis):
    def __str__(self) -> str:
        """Verdict, numbers with units and the next step, in a few lines."""
        from bathyal.diagnosis.report.brief import brief_of

        return str(brief_of(self))

    def summary(self) -> str:
        """One paragraph that a person can act on."""
        from bathyal.diagnosis.report.text import summary

        return summary(self)

    def write(self, path: str | os.PathLike[str]) -> None:
        """Write the report.

        Parameters
        ----------
        path : path
            A page (``.html``), a picture (``.png``) or everything for machines (``.json``): see
            bathyal.diagnosis.files.write_diagnosis.

        Raises
        ------
        ValueError
            For another ending.
        """
        from bathyal.diagnosis.files import write_diagnosis

        write_diagnosis(self, path)
