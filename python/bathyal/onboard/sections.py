# SPDX-License-Identifier: BSD-3-Clause
"""The sections of a mission's file about software on board."""

from __future__ import annotations

from datetime import datetime, timezone
from pathlib import Path
from typing import Annotated, Literal

from pydantic import Field, model_validator

from bathyal.io.yaml_sections import Name, Number, Positive, Section

Channel = Annotated[int, Field(strict=True, ge=1, le=32)]
_DEFAULT_PORTS = {"nmea": "pty", "pd6": "pty", "ardusub": "udp:9002", "mavlink": "tcp:4560"}
_PORTS = {
    "nmea": ("pty", "tcp"),
    "pd6": ("pty", "tcp"),
    "ardusub": ("udp",),
    "mavlink": ("tcp",),
}


class OriginSection(Section):
    """Where on Earth the world's origin is; x is east, y north."""

    latitude: Annotated[Number, Field(ge=-89.9, le=89.9)]
    longitude: Annotated[Number, Field(ge=-180, le=180)]


class LinkSection(Section):
    """A line to a program on this machine."""

    protocol: Literal["nmea", "pd6", "ardusub", "mavlink"]
    port: Annotated[str, Field(pattern=r"^(pty|(tcp|udp):\d{1,5})$")] | None = None
    name: Annotated[Name, Field(pattern=r"^[A-Za-z0-9_.-]+$")] | None = None
    lockstep: bool = True
    timeout: Positive = 60.0
    devices: list[Name] | None = None
    sentences: Literal["all", "standard", "own"] = "all"
    baud: Positive | None = None
    buffer: Annotated[int, Field(strict=True, ge=1, le=1 << 24)] = 4096
    bit_error_rate: Annotated[Number, Field(ge=0, le=1)] = 0.0
    channels: Annotated[list[Channel], Field(min_length=1)] | None = None

    @model_validator(mode="after")
    def _a_port(self) -> LinkSection:
        kind, _, number = self.where.partition(":")
        if kind not in _PORTS[self.protocol]:
            expected = " or ".join(_PORTS[self.protocol])
            raise ValueError(f"port: expected {expected} for {self.protocol}, got {self.where}")
        if number and int(number) > 65535:
            raise ValueError(f"port: expected a number below 65536, got {number}")
        if self.bit_error_rate > 0 and self.baud is None:
            raise ValueError("bit_error_rate: expected a baud with it, got none")
        return self

    @property
    def where(self) -> str:
        """The port, or that of the protocol."""
        return self.port or _DEFAULT_PORTS[self.protocol]

    def path(self, folder: Path) -> Path:
        """Of a pseudo-terminal."""
        return folder / (self.name or self.protocol)


class OnboardSections(Section):
    """Of a mission."""

    links: Annotated[list[LinkSection], Field(max_length=20)] = []
    origin: OriginSection | None = None
    date: datetime = datetime(2026, 1, 1, tzinfo=timezone.utc)

    @property
    def started(self) -> datetime:
        """At which the run begins, UTC; a date without a zone is UTC."""
        zoned = self.date if self.date.tzinfo else self.date.replace(tzinfo=timezone.utc)
        return zoned.astimezone(timezone.utc)
