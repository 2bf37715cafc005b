# SPDX-License-Identifier: BSD-3-Clause
"""The colours that pictures and views share."""

from __future__ import annotations

# Deep to shallow. Lightness rises evenly (CIE L* from 18 to 96), so that equal steps of depth look
# equal, also in grey and to colour-blind readers.
DEPTH = (
    "#1c2a55",
    "#22447c",
    "#266297",
    "#2f80a5",
    "#449eac",
    "#69b9ae",
    "#96d2b3",
    "#c5e7bf",
    "#eff6d6",
)

# One after the other along the path; none is close to the red of a gap or the blues of depth.
SEGMENTS = ("#ff9e1b", "#c2189b", "#ffe347", "#7a3b00", "#8f5bff", "#ffb3c7")

GAP = "#e3120b"
INK = "#1b1f24"
PALE = "#ffffff"
BOTTOM = "#8a7f72"


def segment_colour(segment: int) -> str:
    """The colour of the stretch between target `segment` and the next one."""
    return SEGMENTS[int(segment) % len(SEGMENTS)]


# An identification: the nominal arm, the one found, and what became of each parameter.
BEFORE = "#e07b00"
AFTER = "#1f6f9c"
STATUSES = {
    "identified": "#1f6f9c",
    "gauge": "#8a8f98",
    "prior": "#b06f00",
    "not_identifiable": GAP,
    "fixed": "#8a8f98",
    "pruned": "#5a8f5a",
}

# A diagnosis. Each verdict differs from the others in lightness too, and its sign says it without
# colour; components of a residual keep apart for colour-blind readers (Okabe, Ito 2008).
VERDICT_COLOURS = {
    "clean": "#00664b",
    "named": "#14507a",
    "ambiguous": "#8a5a00",
    "unknown": "#9c1c13",
    "none": "#5b6068",
}
COMPONENTS = ("#d55e00", "#009e73", "#0072b2")
