"""Checks of the arrays that shapes are made of, and of the size of shapes."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..errors import DecompositionError

# Least and largest diagonal of a shape. Single precision lies between them, and their
# cubes are far from the ends of double precision.
_SHORTEST, _LONGEST = 1e-50, 1e50


def real_numbers(values: object) -> NDArray[Any] | None:
    """Return an array of real numbers; None if values are ragged or no numbers.

    Parameters
    ----------
    values : object
        An array, a sequence, or anything else.

    Returns
    -------
    ndarray of integers or floats, or None
    """
    if values is None or isinstance(values, str | bytes):
        return None
    try:
        array = np.asarray(values)
    except (TypeError, ValueError):  # ragged, or an object that cannot be an array
        return None
    return array if array.dtype.kind in "iuf" else None


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
    return f"an array of dtype {array.dtype} and shape {array.shape}"


def checked_numbers(values: object, name: str, whole: bool = False) -> NDArray[Any]:
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


def check_size(low: NDArray[np.float64], high: NDArray[np.float64]) -> None:
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
