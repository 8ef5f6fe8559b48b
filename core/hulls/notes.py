"""What the user should know of hulls, in sentences."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from ..geometry.primitives import CollisionShape, Hull
from .convex_hull import offset
from .fitting import Fit


def notes_on(
    shapes: Sequence[CollisionShape],
    hulls: Sequence[Hull],
    errors: NDArray[np.float64],
    fit: Fit,
) -> tuple[str, ...]:
    """Return notes on errors above the largest, and on hulls that did not shrink.

    Parameters
    ----------
    shapes : sequence of CollisionShape
        Where the longest side of the whole is 2.
    hulls : sequence of Hull
        Convex hulls of the pieces that they are around.
    errors : (K,) float
        Errors of the shapes, in the unit of the parameters.
    fit : Fit
        The shapes that were asked for.

    Returns
    -------
    tuple of str
    """
    notes, parameters, largest = [], fit.parameters, fit.parameters.max_error
    if parameters.pieces != "PARTS" and errors.max() > largest:
        error, most = _told_apart(float(errors.max()), largest)
        notes.append(
            f"The error is {error}, above Largest Error = {most},"
            f" {_reason(len(errors), fit)}"
        )
    if fit.margin < 0:
        pairs = zip(shapes, hulls, strict=True)
        offset_ones = [hull for shape, hull in pairs if shape.kind == "HULL"]
        kept = sum(offset(hull, fit.margin) is hull for hull in offset_ones)
        if kept:
            notes.append(
                f"Margin = {parameters.margin:g} would make {kept} of"
                f" {len(offset_ones)} hulls vanish, which keep their size; choose a"
                " value nearer to 0."
            )
    return tuple(notes)


def _reason(n_shapes: int, fit: Fit) -> str:
    """Return why an error is too large, and what to do."""
    parameters = fit.parameters
    if not fit.has_room:
        return (
            f"because Margin = {parameters.margin:g} alone is that much; choose a"
            " margin nearer to 0."
        )
    if n_shapes < parameters.max_hulls:
        return (
            f"and no cuts into at most Most Hulls = {parameters.max_hulls} were found"
            " that make it smaller."
        )
    return (
        f"after as many cuts as Most Hulls = {parameters.max_hulls} allows; raise Most"
        " Hulls for more."
    )


def _told_apart(larger: float, smaller: float) -> tuple[str, str]:
    """Return two different numbers as text, with the fewest digits that show it."""
    texts = [(f"{larger:.{n}g}", f"{smaller:.{max(n, 6)}g}") for n in range(3, 18)]
    return next(pair for pair in texts if float(pair[0]) > float(pair[1]))
