# SPDX-License-Identifier: BSD-3-Clause
"""Links as a mission's file describes them, opened."""

from __future__ import annotations

from pathlib import Path

from bathyal._core import Error, MissionPlan, SerialLine
from bathyal.onboard.autopilots import ArduSubLink, MavlinkLink
from bathyal.onboard.links import Link
from bathyal.onboard.nmea import NmeaLink
from bathyal.onboard.pd6 import Pd6Link
from bathyal.onboard.place import EarthFrame
from bathyal.onboard.ports import DatagramPort, Port, PtyPort, TcpPort
from bathyal.onboard.sections import LinkSection, OnboardSections


def open_links(
    sections: OnboardSections, plan: MissionPlan, *, folder: Path, seed: int
) -> list[Link]:
    """Opens all of them; pseudo-terminals are links in `folder`.

    Raises
    ------
    Error
        By link: for ports that are taken, devices that are not there, positions without an origin.
    """
    opened: list[Link] = []
    for row, section in enumerate(sections.links):
        try:
            opened.append(_open(section, sections, plan, folder, f"links[{row}]", seed))
        except (Error, ValueError) as error:
            for link in opened:
                link.close("failed")
            raise Error(f"links[{row}]: {error}") from error
    return opened


def _open(
    section: LinkSection,
    sections: OnboardSections,
    plan: MissionPlan,
    folder: Path,
    key: str,
    seed: int,
) -> Link:
    devices = _devices(section, plan)
    earth = None
    if sections.origin is not None:
        earth = EarthFrame(sections.origin.latitude, sections.origin.longitude)
    if section.protocol == "ardusub":
        return ArduSubLink(
            DatagramPort(_number(section)), channels=section.channels, timeout=section.timeout
        )
    if section.protocol == "mavlink":
        return MavlinkLink(
            TcpPort(_number(section)),
            earth=earth,
            channels=section.channels,
            lockstep=section.lockstep,
            timeout=section.timeout,
        )
    line = None
    if section.baud is not None:
        line = SerialLine(
            key,
            baud=section.baud,
            buffer=section.buffer,
            bit_error_rate=section.bit_error_rate,
            seed=seed,
        )
    if section.protocol == "pd6":
        logs = [name for name, kind in devices.items() if kind == "dvl"]
        if not logs:
            raise ValueError("devices: expected a dvl, got none")
        return Pd6Link(_port(section, folder), device=logs[0], line=line, start=sections.started)
    if section.sentences == "standard" and earth is None and "gps" in devices.values():
        raise ValueError("positions need the mission's origin: {latitude: …, longitude: …}")
    return NmeaLink(
        _port(section, folder),
        devices=devices,
        lockstep=section.lockstep,
        timeout=section.timeout,
        standard=section.sentences != "own",
        own=section.sentences != "standard",
        line=line,
        earth=earth,
        start=sections.started,
    )


def _devices(section: LinkSection, plan: MissionPlan) -> dict[str, str]:
    """Kinds by name, of those that are named or of all."""
    known = {sensor.name: sensor.kind for sensor in plan.sensors}
    if section.devices is None:
        return known
    missing = [name for name in section.devices if name not in known]
    if missing:
        raise ValueError(f"devices: expected some of {', '.join(known)}, got {missing[0]!r}")
    return {name: known[name] for name in section.devices}


def _number(section: LinkSection) -> int:
    return int(section.where.partition(":")[2])


def _port(section: LinkSection, folder: Path) -> Port:
    if section.where == "pty":
        return PtyPort(section.path(folder))
    return TcpPort(_number(section))
