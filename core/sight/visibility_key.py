"""What tells one visibility from another."""

from __future__ import annotations

from collections.abc import Hashable
from dataclasses import fields
from hashlib import blake2b
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..parameters.parameter import info_of
from ..parameters.parts import Parameters
from .prepared import Shape


def visibility_key(shape: Shape, parameters: Parameters) -> Hashable:
    """Return what is the same for two calls of `see` only if their values are.

    Everything of `shape` counts, and every parameter that is no `recut`.
    """
    digest = blake2b()
    for each in fields(shape):
        array: NDArray[Any] | None = getattr(shape, each.name)
        digest.update(f"{each.name} {None if array is None else array.shape}".encode())
        if array is not None:
            digest.update(np.ascontiguousarray(array).data)
    values = tuple(
        getattr(parameters, each.name)
        for each in fields(parameters)
        if not info_of(each).recut
    )
    return type(shape), digest.digest(), values
