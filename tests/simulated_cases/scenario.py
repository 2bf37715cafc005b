# SPDX-License-Identifier: BSD-3-Clause
"""What a case is to be, and where, when and how its poses were taken."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from tests.simulated_cases import motion
from tests.simulated_cases import unmodelled_effects as outside
from tests.simulated_cases.arm_draws import draw_arm
from tests.simulated_cases.arms import Array, SimArm, pose
from tests.simulated_cases.effect_draws import LIBRARY, draw_names

CONFOUNDED = {
    # A tool that moved between two sessions: by itself, or because somebody changed it.
    "slip": ("tool_slip", ["tool_slip", "tool_change"]),
    # One time for all of a day, and two days: a base that was moved, or drifts.
    "days": ("base_shift", ["base_shift", "drift"]),
}


@dataclass
class Plan:
    """What is drawn before any number."""

    kind: str
    form: str  # position, pose, touches
    rows: int
    noise: float
    names: list[str] = field(default_factory=list)
    sizes: list[float] = field(default_factory=list)
    outside: str = ""
    outside_size: float = 0.0
    confounded: str = ""
    needs: set[str] = field(default_factory=set)

    def size_of(self, name: str) -> float:
        return self.sizes[self.names.index(name)]

    @property
    def alternatives(self) -> list[str]:
        return CONFOUNDED[self.confounded][1] if self.confounded else []


def plan_case(
    random: np.random.Generator, kind: str, sizes: list[float], odds: list[float]
) -> Plan:
    least = float(random.choice(sizes, p=odds))
    larger = [s for s in sizes if s >= least]
    rows = int(random.integers(80, 300))
    if kind != "clean":
        low, high = {0.25: (300, 440), 0.5: (180, 340)}.get(least, (100, 300))
        rows = int(random.integers(low, high))
    noise = float(np.exp(random.uniform(np.log(0.03e-3), np.log(0.5e-3))))
    form = str(random.choice(["position", "pose", "touches"], p=[0.72, 0.14, 0.14]))
    plan = Plan(kind, form, rows, noise)
    if kind == "inside":
        plan.names = draw_names(random, int(random.choice([1, 2, 3], p=[0.5, 0.3, 0.2])))
        plan.sizes = [least] + [float(random.choice(larger)) for _ in plan.names[1:]]
    elif kind == "confounded":
        plan.confounded = str(random.choice(list(CONFOUNDED), p=[0.65, 0.35]))
        plan.names, plan.sizes = [CONFOUNDED[plan.confounded][0]], [max(least, 0.5)]
        plan.needs |= {"session"} | ({"time"} if plan.confounded == "days" else set())
    elif kind == "outside":
        plan.outside = str(random.choice(outside.NAMES))
        plan.outside_size = max(least, 0.5)
        plan.needs |= set(outside.needs(plan.outside))
        plan.rows = max(plan.rows, 150)
    for name in plan.names:
        plan.needs |= set(LIBRARY[name][1])
    if plan.outside in outside.IN_TIME:
        plan.needs.add(
            "motion" if random.random() < 0.7 or plan.outside == "hysteresis" else "time"
        )
    if plan.outside or plan.needs & {"motion", "positions"} or plan.confounded:
        plan.form = "position" if plan.form == "touches" or "positions" in plan.needs else plan.form
    return plan


@dataclass
class Scene:
    """An arm, its base, and its poses as commanded."""

    plan: Plan
    drawn: SimArm
    true: SimArm
    base: Array  # (4, 4) instrument_from_base
    q: Array
    covariates: dict[str, Array]
    motion: motion.Motion | None
    time: Array

    @staticmethod
    def draw(random: np.random.Generator, plan: Plan) -> Scene | None:
        """None where the plan asks for what this arm does not have."""
        arm = draw_arm(random)
        if "masses" in plan.needs and not arm.weighed:
            return None
        if "turning" in plan.needs and arm.sliding.any():
            return None
        if arm.urdf and set(plan.names) & {"link_compliance", "thermal"}:
            return None  # its rows may be cut elsewhere along an axis than these
        if plan.form == "touches" and arm.size < 5:
            return None
        true = arm.built(random, 1e-3, random.uniform(1e-3, 3e-3))
        away = random.normal(size=3)
        place = away / np.linalg.norm(away) * random.uniform(1.2, 2.5)
        base = pose(place, random.normal(0, 1.5, 3))
        moving = "motion" in plan.needs or (plan.form != "touches" and random.random() < 0.25)
        steps = random.uniform(0.8, 1.2, plan.rows)
        time = np.cumsum(steps) * (random.uniform(0.3, 0.6) if moving else random.uniform(5, 40))
        way = motion.Motion.draw(random, arm) if moving else None
        q = way.at(time) if way else motion.independent_poses(random, arm, plan.rows)
        covariates = _covariates(random, plan, arm, way, time)
        return Scene(plan, arm, true, base, q, covariates, way, time)


def _covariates(
    random: np.random.Generator,
    plan: Plan,
    arm: SimArm,
    way: motion.Motion | None,
    time: Array,
) -> dict[str, Array]:
    names = ["temperature", "time", "payload", "direction", "session", "gravity"]
    odds = [0.4, 0.4, 0.25, 0.35, 0.45, 0.1]
    given = {n for n, odd in zip(names, odds, strict=True) if random.random() < odd} | plan.needs
    if plan.outside == "hysteresis":
        given.discard("direction")
    rows = plan.rows
    out: dict[str, Array] = {}
    if "temperature" in given:
        out["temperature"] = motion.temperature(random, np.linspace(0, 1, rows))
    if "payload" in given:
        out["payload"] = motion.payloads(random, rows)
    if "direction" in given:
        out["direction"] = (
            np.sign(way.speed(time)) if way else motion.approach(random, rows, arm.size)
        )
    if "session" in given:
        fewest = 3 if "tool_change" in plan.names else 2
        most = 2 if plan.confounded == "days" else 4
        out["session"] = motion.sessions(random, rows, int(random.integers(fewest, most + 1)))
    if "gravity" in given:
        out["gravity"] = motion.tilts(random, rows)
    if plan.confounded == "days":
        out["time"] = 86400.0 * out["session"]
    elif "time" in given:
        out["time"] = time
    return out
