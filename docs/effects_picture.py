# SPDX-License-Identifier: BSD-3-Clause
"""Draws what each effect of the library leaves beyond a refitted geometry: docs/images/effects.png.

Run as ``python docs/effects_picture.py docs/images/effects.png``.
"""

from __future__ import annotations

import sys
from dataclasses import dataclass, field

import matplotlib.pyplot as plt
import numpy as np
from numpy.typing import NDArray

import bathyal
from bathyal.effects import FoundEffect
from bathyal.identify.report.curves import AXIS_COLOURS
from bathyal.view.palette import INK

Floats = NDArray[np.floating]
ROWS = 360
NOISE = 2e-5  # [m], so that nothing looks perfect
TURN = np.pi / 2


def an_arm() -> bathyal.Arm:
    """A six-joint arm with masses, as large as a UR10e."""
    tool = np.eye(4)
    tool[:3, 3] = (0.05, 0.0, 0.15)
    masses = (0.0, 7.8, 12.9, 4.0, 2.0, 2.0, 0.6)
    centres = ((0, 0, 0), (0, 0, 0), (0.3, 0, 0), (0.3, 0, 0), (0, 0, 0), (0, 0, 0), (0, 0, 0))
    return bathyal.Arm.from_dh(
        a=[0, -0.61, -0.57, 0, 0, 0],
        alpha=[TURN, 0, 0, TURN, -TURN, 0],
        d=[0.18, 0, 0, 0.17, 0.12, 0.12],
        theta=[0] * 6,
        links=[
            bathyal.Link(f"link {k}", mass=m, center_of_mass=c)
            for k, (m, c) in enumerate(zip(masses, centres, strict=True))
        ],
        tool=tool,
    )


@dataclass
class Panel:
    """An effect of some size, and against what its residuals are drawn.

    `seen` tells along what: the axes of the "base" or of the "tool", or the turn of "joint k" that
    would make the residual, in which `split` parts two kinds of rows.
    """

    name: str
    parameters: dict[str, float]
    against: str
    joint: int | None = None
    settings: dict[str, float] = field(default_factory=dict)
    seen: str = "base"
    split: str = ""


def twist(*numbers: float, names: str = "shift turn", behind: str = "") -> dict[str, float]:
    shift, turn = names.split()
    axes = [f"{kind}_{axis}{behind}" for kind in (shift, turn) for axis in "xyz"]
    return dict(zip(axes, numbers, strict=False))


PANELS = (
    Panel("joint_harmonic", {"cos": 4e-4, "sin": 3e-4}, "joint 3", 2, {"order": 3}, "joint 3"),
    Panel(
        "joint_map",
        {"cos_1": 2e-4, "sin_1": 3e-4, "cos_2": 3e-4, "sin_2": -2e-4},
        "joint 2",
        1,
        {"terms": 2, "wave": 1},
        "joint 2",
    ),
    Panel("joint_scale", {"scale": 4e-4}, "joint 2", 1, {}, "joint 2"),
    Panel("joint_coupling", {"ratio": 6e-4}, "joint 2", 2, {"by": 1}, "joint 3"),
    Panel("backlash", {"gap": 8e-4}, "joint 2", 1, {}, "joint 2", "direction"),
    Panel("joint_compliance", {"compliance": 6e-6}, "joint 2", 1, {}, "joint 2", "payload"),
    Panel("link_compliance", {"flexibility": 2e-5}, "joint 2", 1, {"row": 1}, "joint 2", "payload"),
    Panel(
        "payload",
        {"mass_compliance_2": 4e-5, "mass_compliance_3": 4e-5},
        "joint 2",
        None,
        {"mass_compliance_2": 1, "mass_compliance_3": 2},
        "joint 2",
    ),
    Panel(
        "base_shift", twist(3e-4, 2e-4, 0, 0, 3e-4, 4e-4, behind="_2"), "time", None, {"from": 1}
    ),
    Panel("base_compliance", {"compliance_x": 3e-6, "compliance_y": 3e-6}, "joint 1"),
    Panel("tool_slip", twist(5e-4, 3e-4, 0), "time", None, {"moment": 130, "time": 1300}, "tool"),
    Panel("tool_change", twist(5e-4, 0, 4e-4, behind="_2"), "time", None, {"from": 1}, "tool"),
    Panel("thermal", {"expansion": 2.3e-5}, "temperature", None, {"mean_temperature": 16}),
    Panel(
        "drift",
        twist(1e-7, 0, 1e-7, 0, 2e-7, 0, names="rate turn_rate"),
        "time",
        None,
        {"first_time": 0},
    ),
    Panel("clock_shift", {"delay": 0.05}, "speed of joint 1", None, {}, "joint 1"),
    Panel("outliers", {}, "row"),
    Panel("range_noise", {}, "distance"),
    Panel("quantisation", {}, "joint 2", None, {}, "joint 2"),
)


class Recording:
    """Poses along a wandering way, and the covariates recorded with them."""

    def __init__(self) -> None:
        random = np.random.default_rng(7)
        self.arm = an_arm()
        self.time = 10.0 * np.arange(ROWS)
        self.q = random.uniform(-2.0, 2.0, (ROWS, 6)) - [0, 1.2, 0, 0, 0, 0]
        self.covariates: dict[str, Floats] = {
            "time": self.time,
            "session": (self.time >= 1800).astype(float),
            "temperature": 16 + 6 * np.sin(self.time / 700.0),
            "payload": 3.0 * (np.arange(ROWS) % 2),
            "direction": np.where(np.gradient(self.q, axis=0) < 0, -1.0, 1.0),
        }
        self.noise = NOISE * random.standard_normal((ROWS, 3))
        self.random = random

    def axis(self, against: str) -> Floats:
        speed = np.gradient(self.q[:, 0], self.time)
        axes: dict[str, Floats] = {
            "time": self.time,
            "temperature": self.covariates["temperature"],
            "speed of joint 1": speed,
            "row": np.arange(ROWS, dtype=float),
            "distance": np.asarray(np.linalg.norm(self.tips(self.q), axis=1)),
            **{f"joint {j + 1}": self.q[:, j] for j in range(6)},
        }
        return axes[against]

    def tips(self, q: Floats) -> Floats:
        return np.asarray(self.arm.forward(q))[:, :3, 3]

    def measured(self, panel: Panel) -> Floats:
        """Where the tip of the arm with this effect is seen."""
        tips = self.tips(self.q).copy()
        if panel.name == "outliers":
            tips[[40, 150, 151, 290]] += self.random.normal(0, 1e-3, (4, 3))
        elif panel.name == "range_noise":
            far = np.linalg.norm(tips, axis=1, keepdims=True)
            tips = tips + (2e-4 * far**3) * self.random.standard_normal(tips.shape)
        elif panel.name == "quantisation":
            tips = self.tips(self.q + self.random.uniform(-4e-4, 4e-4, self.q.shape))
        else:
            found = FoundEffect(
                panel.name, panel.parameters, joint=panel.joint, settings=panel.settings
            )
            data = bathyal.Tracked(self.q, tips, covariates=self.covariates)
            wrong = bathyal.CorrectedArm(self.arm, [found], data)
            tips = np.asarray(wrong.forward(self.q, covariates=self.covariates))[:, :3, 3]
        return tips + self.noise

    def residuals(self, panel: Panel) -> Floats:
        """(N, k) of the geometry that was fitted to it, along what it is seen [mm] or [mrad]."""
        data = bathyal.Tracked(self.q, self.measured(panel))
        left = 1e3 * np.asarray(bathyal.identify_arm(self.arm, data).residuals)
        if panel.seen == "base":
            return left
        if panel.seen == "tool":
            turns = np.asarray(self.arm.forward(self.q))[:, :3, :3]
            return np.asarray(np.einsum("nji,nj->ni", turns, left))
        move = np.asarray(self.arm.jacobian(self.q))[:, :3, int(panel.seen[-1]) - 1]
        lever = np.maximum((move**2).sum(axis=1), 0.2**2)  # [m²] near the axis noise is all
        return np.asarray((move * left).sum(axis=1) / lever)[:, None]


def main(path: str) -> None:
    recording = Recording()
    figure, axes = plt.subplots(6, 3, figsize=(11, 14), layout="constrained")
    for panel, ax in zip(PANELS, axes.flat, strict=True):
        across = recording.axis(panel.against)
        residuals = recording.residuals(panel)
        if panel.split:
            kind = recording.covariates[panel.split]
            kind = kind[:, 1] if kind.ndim == 2 else kind
            for value, colour in zip(np.unique(kind), AXIS_COLOURS, strict=False):
                rows = kind == value
                label = f"{panel.split} {value:g}"
                ax.plot(across[rows], residuals[rows, 0], ".", ms=3, color=colour, label=label)
            ax.legend(fontsize=6, loc="upper right", frameon=False, handletextpad=0.1)
        else:
            colours = AXIS_COLOURS if residuals.shape[1] == 3 else (INK,)
            for column, colour in zip(residuals.T, colours, strict=True):
                ax.plot(across, column, ".", ms=3, color=colour, alpha=0.6)
        ax.set_ylabel(
            "mrad of " + panel.seen if panel.seen[0] == "j" else "mm in " + panel.seen, fontsize=7
        )
        ax.axhline(0, color="#888888", lw=0.5)
        ax.set_title(panel.name, fontsize=10, family="monospace")
        ax.set_xlabel(panel.against, fontsize=8)
        ax.tick_params(labelsize=7)
    figure.savefig(path, dpi=90)


if __name__ == "__main__":
    main(sys.argv[1])
