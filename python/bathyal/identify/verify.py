# SPDX-License-Identifier: BSD-3-Clause
"""Whether an arm goes where its model says: predicted positions against measured ones."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from bathyal import _core, optional
from bathyal._core import Arm, CorrectedArm, Verification
from bathyal.errors import argument_error


def verify_arm(
    arm: Arm | CorrectedArm,
    q: ArrayLike,
    positions: ArrayLike,
    *,
    pairing: str = "exact",
    covariates: Mapping[str, Any] | None = None,
) -> Verification:
    """Compare where the arm says its tool centre point is with where an instrument saw it.

    Both clouds' centroids are removed and the predicted one is turned onto the measured one, so
    that neither the instrument's frame nor the pose of the arm's base counts (Yukhimets, Gubankov
    2023, section 4: 13 positions of the flange at constant orientation, seen by a laser tracker).
    Set ``arm.tool`` first where positions are those of a target on the flange; an orientation that
    never changes makes it immaterial.

    Parameters
    ----------
    arm : Arm or CorrectedArm
    q : (N, n) array
        Joints [rad] or [m].
    positions : (N, 3) array
        Measured, in any frame [m].
    pairing : {"exact", "icp"}
        "exact" pairs row with row. "icp" finds for each prediction the measured position that
        PCL's iterative closest point leaves nearest, for positions in any order, of which there may
        be more than poses; it needs the optional extension ``_pcl`` and clouds that lie close from
        the start.
    covariates : dict, optional
        Of a `CorrectedArm`, as its `forward` takes them.

    Returns
    -------
    Verification
        ``.rms_before`` (centroids removed only), ``.rms_after`` (aligned), ``.deviation`` (N,),
        ``.residual`` (N, 3), ``.pairs``, ``.measured_from_predicted``.

    Raises
    ------
    ValueError
        For fewer than three positions, positions on one line, other numbers of rows, numbers that
        are not finite; covariates of an arm that has no use for them.
    Error
        For "icp" without the extension, when it does not converge, or pairs two poses with one
        position.

    Examples
    --------
    >>> import bathyal, numpy as np
    >>> arm = bathyal.arms.ur10e()
    >>> q = np.random.default_rng(1).uniform(-1, 1, (13, 6))
    >>> seen = arm.forward(q)[:, :3, 3] + [4.0, 5.0, 6.0]
    >>> bool(bathyal.verify_arm(arm, q, seen).rms_after < 1e-12)
    True
    """
    if covariates is None:
        poses = arm.forward(q)
    elif isinstance(arm, CorrectedArm):
        poses = arm.forward(q, covariates=dict(covariates))
    else:
        raise argument_error("covariates", "none of a rigid arm", ", ".join(covariates))
    predicted = poses[..., :3, 3]
    if predicted.ndim != 2 or len(predicted) < 3:
        raise argument_error("q", "three rows or more", f"shape {np.shape(q)}")
    if pairing == "exact":
        return _core.verify_positions(predicted, positions)
    if pairing == "icp":
        pairs = optional.pcl('pairing="icp"', 'pairing="exact"').pair_by_icp(predicted, positions)
        return _core.verify_positions(predicted, positions, pairs=pairs.tolist())
    raise argument_error("pairing", '"exact" or "icp"', repr(pairing))
