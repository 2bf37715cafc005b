# SPDX-License-Identifier: BSD-3-Clause
"""Methods that Python gives to the engine's classes read like any other."""

import inspect
import subprocess
import sys

import pytest

import bathyal
from bathyal.attach import methods_of

ATTACHED = [
    bathyal.PointCloud.write, bathyal.PointCloud.show, bathyal.TriangleMesh.write,
    bathyal.TriangleMesh.show, bathyal.ToolPath.write, bathyal.ToolPath.show,
    bathyal.Arm.from_urdf, bathyal.Arm.to_urdf, bathyal.Arm.save, bathyal.Arm.write,
    bathyal.Arm.show, bathyal.Arm.plot, bathyal.CorrectedArm.save, bathyal.CorrectedArm.write,
    bathyal.TouchPlan.write, bathyal.TouchPlan.plot, bathyal.Diagnosis.write,
    bathyal.Diagnosis.summary, bathyal.Workspace.show,
    bathyal.SamplingPlan.show, bathyal.SamplingPlan.write,
]  # fmt: skip


@pytest.mark.parametrize("method", ATTACHED, ids=lambda method: method.__qualname__)
def test_help_shows_signature_and_text(method) -> None:
    assert "_" not in method.__qualname__.split(".")[0]
    assert method.__doc__
    signature = inspect.signature(method)
    named = [known for name, known in signature.parameters.items() if name != "self"]
    annotations = [signature.return_annotation, *(known.annotation for known in named)]
    assert inspect.Signature.empty not in annotations
    assert all("Any" not in str(annotation) for annotation in annotations)


def test_attaching_keeps_what_the_class_has() -> None:
    class Engine:
        size = 3

    @methods_of(Engine)
    class _Engine(Engine):
        @property
        def double(self) -> int:
            "Twice."
            return 2 * self.size

        @staticmethod
        def make() -> Engine:
            return Engine()

    assert (Engine.make().double, Engine.size) == (6, 3)
    assert Engine.__name__ == "Engine"


def test_importing_draws_nothing_heavy() -> None:
    code = (
        "import bathyal, sys; "
        "heavy = {'matplotlib', 'plotly', 'h5py', 'rasterio', 'laspy', 'pydantic', 'yaml'}; "
        "print(sorted(heavy & set(sys.modules)))"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout == "[]\n"
