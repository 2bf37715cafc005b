# SPDX-License-Identifier: BSD-3-Clause
"""A world in a few lines."""

from __future__ import annotations

from bathyal._core import World


def describe_world(world: World) -> dict[str, str]:
    """Names and texts of what a person asks first."""
    scene = world.scene
    triangles = sum(len(mesh.triangles) for mesh in scene.meshes)
    named = world.names
    shown = named if len(named) <= 8 else [*named[:8], f"and {len(named) - 8} more"]
    return {
        "objects": ", ".join(shown),
        "triangles": f"{triangles:,}",
        "water": str(world.water),
    }
