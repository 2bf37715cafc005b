# SPDX-License-Identifier: BSD-3-Clause
"""A program on board in lock-step over a pseudo-terminal: exchanges a second.

    python -m benchmarks.python.lockstep

The program is a process of its own and steers by the depth that it reads. Every run is compared
with the one in this process before any time is printed: the same bytes.
"""

from __future__ import annotations

import inspect
import statistics
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import bathyal
from tests.support.onboard import MISSION, keep_down

TICKS = 6000
ROUNDS = 5


def program_at(port: Path) -> subprocess.Popen[bytes]:
    """The same program, in a process of its own, that waits for the port."""
    code = (
        "import bathyal, pathlib, time\n"
        + inspect.getsource(keep_down)
        + f"""
port = pathlib.Path({str(port)!r})
print("ready", flush=True)
while not port.exists():
    time.sleep(0.001)
keep_down(bathyal.SerialVehicle(port))
"""
    )
    program = subprocess.Popen([sys.executable, "-c", code], stdout=subprocess.PIPE)
    assert program.stdout is not None
    program.stdout.readline()
    return program


def main() -> None:
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        for devices, told in (
            ("", "all sensors"),
            (", devices: [depth]", "one sensor"),
        ):
            path = folder / "mission.yaml"
            text = MISSION.replace("20 s", f"{TICKS // 10} s")
            path.write_text(text.replace("timeout: 20", f"timeout: 20, sentences: own{devices}"))
            run = bathyal.Run(path, seed=1, log=folder / "here.mcap")
            keep_down(bathyal.SimulatedVehicle(run))
            run.close()
            here = (folder / "here.mcap").read_bytes()
            rates = []
            for row in range(ROUNDS):
                out = folder / f"{row}{len(devices)}"
                program = program_at(out / "port")
                begun = time.perf_counter()
                bathyal.run(path, seed=1, out=out)
                rates.append((TICKS + 1) / (time.perf_counter() - begun))
                program.wait(10)
                assert (out / "log.mcap").read_bytes() == here
            print(f"| {told} | {statistics.median(rates):,.0f} exchanges/s |")


if __name__ == "__main__":
    main()
