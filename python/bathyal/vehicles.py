# SPDX-License-Identifier: BSD-3-Clause
"""Published vehicles."""

from bathyal._core import Vehicle

__all__ = ["bluerov2_heavy", "remus100"]


def remus100(*, equal_cross_flow: bool = False) -> Vehicle:
    """REMUS 100 as printed in Prestero (2001): weight 299 N, buoyancy 306 N, g 9.81 m/s².

    The printed Y_vv = −1310 is ten times Z_ww of the same round hull; `equal_cross_flow` takes −131
    for both.
    """
    return Vehicle.remus100(equal_cross_flow=equal_cross_flow)


def bluerov2_heavy() -> Vehicle:
    """BlueROV2 Heavy by von Benzon and others (2022), its volume such that it is neutral."""
    return Vehicle.bluerov2_heavy()
