"""What the user should know of hulls, in sentences."""

from __future__ import annotations

from collections.abc import Sequence

from ..geometry.primitives import CollisionShape, Hull
from ..steps.arrays import FloatArray
from .convex_hull import offset
from .fitting import Fit


def notes_on_parts(n_parts: int, n_shapes: int, fit: Fit) -> tuple[str, ...]:
    """Return a note on parts that share hulls, as there are more than are allowed."""
    if fit.parameters.pieces != "PARTS" or n_shapes == n_parts:
        return ()
    most = fit.parameters.max_hulls
    return (
        f"{n_parts} parts share {n_shapes} hulls, as Most Hulls ="
        f" {most} allows no more; raise it for one each.",
    )


def notes_on(
    shapes: Sequence[CollisionShape],
    hulls: Sequence[Hull],
    errors: FloatArray,
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
        worst = int(errors.argmax())
        error, most = _told_apart(float(errors.max()), largest)
        notes.append(
            f"The error is {error}, above Largest Error = {most},"
            f" {_reason(len(errors), fit, shapes[worst], hulls[worst])}"
        )
    if fit.margin < 0:
        pairs = zip(shapes, hulls, strict=True)
        kept = sum(_kept(shape, hull, fit) for shape, hull in pairs)
        if kept:
            n_hulls = sum(shape.kind == "HULL" for shape in shapes)
            notes.append(
                f"Margin = {parameters.margin:g} would make {kept} of"
                f" {n_hulls} hulls vanish, which keep their size; choose a"
                " value nearer to 0."
            )
    return tuple(notes)


def _kept(shape: CollisionShape, hull: Hull, fit: Fit) -> bool:
    """Return whether a hull keeps its size, because the margin would make it vanish."""
    return shape.kind == "HULL" and offset(hull, fit.margin) is hull


def _reason(n_shapes: int, fit: Fit, worst: CollisionShape, hull: Hull) -> str:
    """Return why the error of the worst shape is too large, and what to do."""
    parameters = fit.parameters
    if not fit.has_room(hull) and not _kept(worst, hull, fit):
        return (
            f"because Margin = {parameters.margin:g} alone uses up Largest Error;"
            " choose a margin nearer to 0."
        )
    if fit.left_out(worst, hull):
        return (
            f"because Most Vertices = {parameters.max_vertices} leaves out corners of"
            " hulls; raise Most Vertices."
        )
    if hull.is_thickened:
        return (
            "because hulls around flat faces have a thickness; give the faces one"
            " (Solidify modifier)."
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
