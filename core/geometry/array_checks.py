"""Arguments and arrays of shapes: what is refused, and why."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import Any, get_args

import numpy as np
from numpy.typing import NDArray

from ..errors import DecompositionError
from ..steps.arrays import FloatArray, IntArray

# Least and largest diagonal of a shape. Single precision lies between them, and their
# cubes are far from the ends of double precision.
_SHORTEST, _LONGEST = 1e-50, 1e50
# Numbers in arrays of dtype object.
_PLAIN = (int, float, np.integer, np.floating)
# Types that people know by another name.
_KNOWN_AS = {Mapping: "dict"}


def real_numbers(values: object) -> NDArray[Any] | None:
    """Return an array of real numbers; None if values are ragged or no numbers.

    Parameters
    ----------
    values : object
        An array, a sequence, or anything else.

    Returns
    -------
    ndarray of integers or floats, or None

    Raises
    ------
    DecompositionError
        If a whole number has more than 64 bits, or numbers are masked.
    """
    if np.ma.is_masked(values):
        raise DecompositionError(
            "Some numbers of an array are masked, and masks are not read; leave those"
            " points or faces out."
        )
    if values is None or isinstance(values, str | bytes):
        return None
    try:
        array = np.asarray(values)
    except (TypeError, ValueError):  # ragged, or an object that cannot be an array
        return None
    if array.dtype.kind == "O":  # as of pandas, or with whole numbers of any size
        return _plain_numbers(array)
    return array if array.dtype.kind in "iuf" else None


def _plain_numbers(array: NDArray[np.object_]) -> NDArray[Any] | None:
    """Return an array of objects as numbers; None if one of them is no plain number."""
    kinds = set(map(type, array.flat))
    if not all(issubclass(kind, _PLAIN) and kind is not bool for kind in kinds):
        return None
    whole = all(issubclass(kind, int | np.integer) for kind in kinds)
    try:
        return array.astype(np.int64 if whole else np.float64)
    except OverflowError as error:
        raise DecompositionError(
            "A whole number is too large: numbers of vertices, polygons and parts are"
            " below 2**63; pass coordinates of that size as floats."
        ) from error


def described(values: object) -> str:
    """Return how an error message names a value: by its type, or that of its array.

    Parameters
    ----------
    values : object

    Returns
    -------
    str
        Such as 'an array of dtype bool and shape (8, 3)'.
    """
    if isinstance(values, str | bytes) or not isinstance(values, Sequence | np.ndarray):
        return f"a value of type {type(values).__name__}"
    try:
        array = np.asarray(values)
    except (TypeError, ValueError):
        return f"a {type(values).__name__} of rows of unequal lengths"
    if array.dtype.kind == "U" and not isinstance(values, np.ndarray):
        return f"a {type(values).__name__} that holds strings"
    hint = ""
    if isinstance(values, np.ndarray) and array.dtype.kind == "O" and array.ndim > 1:
        hint = "; turn it into numbers with `.astype(float)`, or `int` for faces"
    return f"an array of dtype {array.dtype} and shape {array.shape}{hint}"


def check_types(**arguments: tuple[object, Any]) -> None:
    """Raise an error if an argument has a wrong type.

    Parameters
    ----------
    **arguments : tuple of object and type
        The value and the type, or union of types, of each argument, by its name.

    Raises
    ------
    TypeError
    """
    for name, (value, kind) in arguments.items():
        if not isinstance(value, kind):
            kinds = get_args(kind) or (kind,)
            names = " or ".join(_KNOWN_AS.get(each, each.__name__) for each in kinds)
            raise TypeError(f"`{name}` must be a {names}, not {described(value)}.")


def checked_numbers(values: object, name: str, whole: bool) -> NDArray[Any]:
    """Return values as an array of numbers.

    Parameters
    ----------
    values : object
    name : str
        What the values are, for the error message.
    whole : bool
        Whether they must be integers.

    Returns
    -------
    ndarray
        Of integers if `whole` and not empty, else of integers or floats.

    Raises
    ------
    TypeError
        If values are ragged, no real numbers, or not of an integer type if `whole`.
    """
    array = real_numbers(values)
    if array is None or (whole and array.size and array.dtype.kind == "f"):
        kind = "whole numbers" if whole else "numbers"
        raise TypeError(f"{name} must be {kind}, not {described(values)}.")
    return array


def rows_of_three(values: object, name: str, whole: bool = False) -> NDArray[Any]:
    """Return values as an array of three numbers a row.

    Parameters
    ----------
    values : object
    name : str
        What the rows are, for the error message.
    whole : bool
        Whether the numbers must be integers.

    Returns
    -------
    (N, 3) ndarray

    Raises
    ------
    TypeError
        If values are no numbers of that kind.
    DecompositionError
        If the array has another shape, and is not empty.
    """
    array = checked_numbers(values, name, whole)
    if array.size == 0:
        return array.reshape(0, 3)
    if array.ndim != 2 or array.shape[1] != 3:
        raise DecompositionError(
            f"{name} must be an array of shape (N, 3), not {array.shape}; pass one row"
            " of three numbers for each."
        )
    return array


def check_surface(vertices: NDArray[Any], n_triangles: int) -> None:
    """Raise if there are no triangles, or coordinates (V, 3) are not finite.

    Raises
    ------
    DecompositionError
    """
    if n_triangles == 0:
        raise DecompositionError(
            "The mesh has no faces; add faces or choose another object."
        )
    if not np.isfinite(vertices).all():
        raise DecompositionError(
            "The mesh has coordinates that are not finite numbers; replace them. In"
            " Blender, `bpy.context.object.data.validate()` in the Python Console sets"
            " them to 0."
        )


def check_indices(indices: IntArray, n_vertices: int) -> None:
    """Raise DecompositionError if numbers of vertices are not all in 0…n - 1."""
    if indices.size and (indices.min() < 0 or indices.max() >= n_vertices):
        raise DecompositionError(
            "The mesh has faces that refer to missing vertices; repair it first."
        )


def check_size(low: FloatArray, high: FloatArray) -> None:
    """Raise an error if areas and volumes of a shape would leave double precision.

    Parameters
    ----------
    low, high : (3,) float
        Lowest and highest corner of its bounding box.

    Raises
    ------
    DecompositionError
        If the diagonal is not 0 but too short, or too long.
    """
    diagonal = math.dist(low, high)  # does not overflow on the way
    if diagonal and not _SHORTEST <= diagonal <= _LONGEST:
        raise DecompositionError(
            f"The bounding box has a diagonal of {diagonal:.3g}; scale the shape to"
            f" between {_SHORTEST:g} and {_LONGEST:g}."
        )
