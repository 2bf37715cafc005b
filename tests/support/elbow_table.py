# SPDX-License-Identifier: BSD-3-Clause
"""The table of an elbow arm of six joints, for tests of weight and loads."""

import numpy as np

_RIGHT = np.pi / 2
ELBOW = {
    "a": [0.08, 0.42, 0, 0, 0, 0],
    "alpha": [-_RIGHT, 0, _RIGHT, -_RIGHT, _RIGHT, 0],
    "d": [0.4, 0, 0.06, 0.48, 0, 0.09],
    "theta": [0, -_RIGHT, _RIGHT, 0, 0, 0],
}
