"""What the user should know of hulls, in sentences."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from ..geometry.primitives import Hull
from .convex_hull import offset
from .fitting import Fit


def notes_on(
    hulls: Sequence[Hull], errors: NDArray[np.float64], fit: Fit
) -> tuple[str, ...]:
    """Return notes on errors above the largest, and on hulls that did not shrink.

    Parameters
    ----------
    hulls : sequence of Hull
        Convex hulls of the pieces, where the longest side of the whole is 2.
    errors : (K,) float
        Errors of the shapes around them, in the unit of the parameters.
    fit : Fit
        The shapes that were asked for.

    Returns
    -------
    tuple of str
    """
    notes, parameters, largest = [], fit.parameters, fit.parameters.max_error
    if parameters.pieces != "PARTS" and errors.max() > largest:
        if not fit.has_room:
            advice = (
                f"because Margin = {parameters.margin:g} alone is that much; choose a"
                " margin nearer to 0."
            )
        elif len(errors) < parameters.max_hulls:
            advice = (
                "and no cuts into at most Most Hulls ="
                f" {parameters.max_hulls} were found that make it smaller."
            )
        else:
            advice = (
                f"after as many cuts as Most Hulls = {parameters.max_hulls} allows;"
                " raise Most Hulls for more."
            )
        digits = (f"{errors.max():.{n}g}" for n in range(3, 18))  # that show it
        error = next(each for each in digits if float(each) > float(f"{largest:g}"))
        notes.append(
            f"The error is {error}, above Largest Error = {largest:g}, {advice}"
        )
    if parameters.shape == "HULL" and fit.margin < 0:
        kept = sum(offset(hull, fit.margin) is hull for hull in hulls)
        if kept:
            notes.append(
                f"Margin = {parameters.margin:g} would make {kept} of"
                f" {len(hulls)} hulls vanish, which keep their size; choose a"
                " value nearer to 0."
            )
    return tuple(notes)
