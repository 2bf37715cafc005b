# SPDX-License-Identifier: BSD-3-Clause
"""Arrays that callers give, where Python itself looks at them before the engine does."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from bathyal.errors import argument_error


def unmasked(name: str, values: ArrayLike) -> NDArray[Any]:
    """`values` as an array; ValueError where one of them is masked, as the engine's own check."""
    if np.ma.is_masked(values):
        mask = np.ma.getmaskarray(np.ma.asarray(values))
        got = f"{np.count_nonzero(mask)} masked of {mask.size}"
        raise argument_error(name, "an array without masked values", got)
    return np.asarray(values)
