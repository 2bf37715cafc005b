# SPDX-License-Identifier: BSD-3-Clause
"""What may be wrong with an arm apart from its geometry: the library of effects, and your own.

>>> import bathyal
>>> [effect.name for effect in bathyal.effects.list()][:3]
['joint_harmonic', 'joint_map', 'joint_scale']
>>> bathyal.effects.get("thermal").needs
['temperature']

An effect of your own is a function of the recorded rows, in radians (or metres) per unit of its
parameter:

>>> import numpy as np
>>> def cable(data, joint):
...     return np.sin(data.q[:, 1] + data.q[:, 2])
>>> effect = bathyal.effects.Effect("cable", cable, parameters={"pull": "rad"}, joints="each")
"""

from __future__ import annotations

import builtins

from bathyal import errors
from bathyal._core import (
    Effect,
    EffectRange,
    EffectRows,
    FoundEffect,
    Support,
    find_effect_with,
    library_effects,
)

__all__ = [
    "Effect",
    "EffectRange",
    "EffectRows",
    "FoundEffect",
    "Support",
    "get",
    "list",
    "register",
    "unregister",
]

_registered: dict[str, Effect] = {}


def list() -> builtins.list[Effect]:
    """The effects of the library, in a fixed order, then those that were registered.

    Examples
    --------
    >>> import bathyal
    >>> print(bathyal.effects.list()[0].name)
    joint_harmonic
    """
    return [*library_effects(), *_registered.values()]


def get(name: str) -> Effect:
    """The effect of a name.

    Parameters
    ----------
    name : str

    Raises
    ------
    ValueError
        For a name that no effect has; the text lists those that there are.

    Examples
    --------
    >>> import bathyal
    >>> bathyal.effects.get("joint_harmonic")
    Effect("joint_harmonic")
    """
    known = {effect.name: effect for effect in list()}
    if name not in known:
        raise errors.argument_error("effect", f"one of {', '.join(known)}", repr(name))
    return known[name]


def register(effect: Effect) -> None:
    """Make an effect of your own known by its name, as files of corrected arms store it.

    Parameters
    ----------
    effect : Effect

    Raises
    ------
    ValueError
        For a name that is taken: of the library, or of another effect (`unregister` it first).

    Examples
    --------
    >>> import bathyal
    >>> def creak(data, joint):
    ...     return data.q[:, joint] ** 2
    >>> effect = bathyal.effects.Effect("creak", creak, parameters={"rate": "1/rad"}, joints=[0])
    >>> bathyal.effects.register(effect)
    >>> bathyal.effects.get("creak")
    Effect("creak")
    >>> bathyal.effects.unregister("creak")
    """
    if not isinstance(effect, Effect):
        raise errors.argument_error("effect", "an Effect", type(effect).__name__)
    if _registered.get(effect.name) is effect:
        return
    if effect.name in {known.name for known in list()}:
        raise errors.argument_error("effect", "a name that is not taken", repr(effect.name))
    _registered[effect.name] = effect


def unregister(name: str) -> None:
    """Forget an effect that was registered.

    Parameters
    ----------
    name : str

    Raises
    ------
    ValueError
        For a name that was not registered.
    """
    if name not in _registered:
        raise errors.argument_error("name", "one that was registered", repr(name))
    del _registered[name]


find_effect_with(get)  # what FoundEffect knows a name by
