"""Cut a solid by the planes whose two sides have the cheapest shapes."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np

from ...geometry.frames import settled
from ...steps.arrays import FloatArray
from ...steps.progress import Progress, Steps, within
from ..cost import cost_of_sides
from ..enclosing.shapes import roughly_around
from ..joining import JoinedPairs, join_pieces, part_again, without_films
from ..piece import Piece
from .cell import Cell, cut
from .ranked_planes import ranked_planes

# Number of pieces to cut, as a multiple of Most Hulls: joins correct cuts that were
# best at their turn only. Shapes other than hulls take longer to fit, and spheres
# around two neighbors are seldom close.
_SURPLUS = {"HULL": 2.0, "SPHERE": 1.0}
_OTHER_SURPLUS = 1.5
# Number of planes that are cut with, to compare the exact costs of both sides.
_TRIES = 8
# Two planes count as the same above this cosine between their normals and below this
# difference of their offsets; the longest side of the shape is 2.
_ALIKE = 0.95
_NEAR = 0.05
# A piece is convex if its hull adds less than this share of the hull's volume.
_CONVEX = 0.05
# Shapes that fit a convex piece the better the less long it is.
_ROUND = ("SPHERE", "CYLINDER", "CAPSULE")
# Number of times that pieces are cut and joined: what is narrow may be cut and joined
# without end. Ten rounds were the most that a model took, for up to 64 hulls.
_MOST_ROUNDS = 16
# Cuts that leave more than this share of the error are in vain.
_LOWER = 0.9


def close_pieces(
    cells: Sequence[Cell], most: int, only_close: bool = False
) -> Steps[list[Piece]]:
    """Cut pieces until all are close, and join neighbors.

    If joining leaves room for more pieces, those that are not close yet are cut again,
    a few times, or come apart again.

    Parameters
    ----------
    cells : sequence of Cell
    most : int
        Largest number of pieces to return.
    only_close : bool, optional
        Whether pieces that are not close are of no use. It saves time to give up.

    Returns
    -------
    Steps of list of Piece
        None if it was given up.
    """
    fit, pieces, joints = cells[0].fit, list[Piece](), JoinedPairs()
    most_cells = int(_SURPLUS.get(fit.parameters.shape, _OTHER_SURPLUS) * most)
    # The whole is not tried yet: it may seem close, and its bound say otherwise.
    far, tried, share, n_rounds = list(cells), set[Cell](), 0.0, 0
    while far:
        n_rounds += 1
        room, rest = most_cells - len(pieces), 1 - share
        cutting, joining = share + 0.7 * rest, share + 0.8 * rest
        pieces += yield from within(_cut_until_close(far, room), share, cutting)
        if only_close and len(pieces) >= most_cells:
            return []
        many = len(pieces) if only_close else most
        joined = join_pieces(pieces, many, joints, close=True)
        pieces = without_films((yield from within(joined, cutting, joining)))
        share = joining
        if len(pieces) > most:
            return []
        cells = [one for one in pieces if isinstance(one, Cell) and one not in tried]
        again = len(pieces) < most and n_rounds < _MOST_ROUNDS
        far = (yield from within(_far(cells), joining, joining)) if again else []
        tried.update(far)
        pieces = [one for one in pieces if one not in far]
    return without_films(part_again(pieces, most, joints))


def _far(cells: Sequence[Cell]) -> Steps[list[Cell]]:
    """Return the pieces that are not close."""
    far: list[Cell] = []
    for one in cells:
        far += [] if (yield from one.whether_close("Cutting")) else [one]
    return far


def _cut_until_close(cells: Sequence[Cell], most: int) -> Steps[list[Cell]]:
    """Cut the piece of largest error repeatedly, until the errors of all are allowed.

    If `most` pieces are too few for that, cuts of convex pieces that do not lower the
    error are undone: small spheres in a row stray as far as a large one.

    Parameters
    ----------
    cells : sequence of Cell
    most : int
        Largest number of pieces.

    Returns
    -------
    Steps of list of Cell
    """
    left, done, largest = list(cells), list[Cell](), cells[0].fit.max_error
    sides_of: dict[Cell, tuple[Cell, Cell]] = {}
    while left and (count := len(left) + len(done)) < most:
        share = count / most
        unsure: list[Cell] = []
        for one in left:  # by estimates, where they tell: bounds take far longer
            yield Progress("Cutting", share)
            unsure += [one] if one.known_error > largest else []
        far = yield from within(_far(unsure), share, share)
        if not far:
            return done + left
        worst = max(far, key=lambda one: round(one.error, 6))
        left.remove(worst)
        sides = yield from within(best_cut(worst), share, (count + 1) / most)
        if sides:
            sides_of[worst] = sides
        left += sides or ()
        done += () if sides else (worst,)
    return _worthwhile(cells, sides_of)


def _worthwhile(
    cells: Sequence[Cell], sides_of: dict[Cell, tuple[Cell, Cell]]
) -> list[Cell]:
    """Return the pieces of cut ones, without cuts of convex pieces in vain.

    `sides_of` has both sides of each piece that was cut, in the order of the cuts.
    """
    pieces: dict[Cell, list[Cell]] = {}
    for cell, sides in reversed(sides_of.items()):
        small = [one for side in sides for one in pieces.get(side, [side])]
        error = max(one.error for one in small)  # bounds would be no fair comparison
        in_vain = _is_convex(cell) and error > _LOWER * cell.error
        pieces[cell] = [cell] if in_vain else small
    return [one for cell in cells for one in pieces.get(cell, [cell])]


def best_cut(cell: Cell) -> Steps[tuple[Cell, Cell] | None]:
    """Cut a piece by the plane whose two sides have the lowest cost.

    Planes are ranked by the volume that the hulls of both sides add. Only the first few
    different ones are cut with, and compared by `cost_of_sides`: the errors of both
    hulls and the volume that they add. Where this tells little, the piece is cut across
    its longest side: convex pieces that round shapes or hulls of few vertices are far
    from, and where two shapes other than hulls would be no better than one, such as a
    film and the rest. A sphere may have to be cut more than once to gain anything.

    Parameters
    ----------
    cell : Cell

    Returns
    -------
    Steps of tuple of two Cells or None
        The pieces below and above the plane. Some of the surface is on both sides if
        any plane has that. None if no plane has points on both sides.
    """
    kind = cell.fit.parameters.shape
    if _is_convex(cell) and (kind in _ROUND or cell.left_out):
        return (yield from _cheapest(cell, _middle(cell)))
    planes, is_block = yield from ranked_planes(cell)
    best = yield from _cheapest(cell, planes, is_block)
    in_vain = best and min(side.error for side in best) > _LOWER * cell.error
    if in_vain and kind not in ("HULL", "SPHERE"):
        best = (yield from _cheapest(cell, _middle(cell))) or best
    return best


def _cheapest(
    cell: Cell, planes: FloatArray, is_block: bool = False
) -> Steps[tuple[Cell, Cell] | None]:
    """Return the sides of lowest cost, of cuts by the first planes that differ."""
    made: list[tuple[Cell, Cell]] = []
    for plane in _distinct(planes):
        yield Progress("Cutting", 1.0)
        sides = cut(cell, plane)
        if all(len(side.points) for side in sides):  # by rounding, a film may have none
            made.append(sides)
    # A film along a cut has no sample of the surface. But a small piece may have so few
    # that one side of every cut has none.
    firm = [sides for sides in made if all(side.on_surface.any() for side in sides)]
    cuts: list[tuple[float, int, tuple[Cell, Cell]]] = []
    for turn, sides in enumerate(firm or made):
        least_errors = []
        for side in sides:
            yield Progress("Cutting", 1.0)
            least_errors.append(side.least_error)
        cuts.append((_cost(sides, least_errors, is_block), turn, sides))
    best, least = None, (np.inf, 0)
    for bound, turn, sides in sorted(cuts):
        if bound > least[0]:
            break
        yield Progress("Cutting", 1.0)
        cost = _cost(sides, [side.error for side in sides], is_block)
        if (cost, turn) < least:
            best, least = sides, (cost, turn)
    return best


def _cost(sides: tuple[Cell, Cell], errors: list[float], is_block: bool) -> float:
    """Return the cost of a cut; slices of a block are as deep as before the cut."""
    if is_block:
        depths = [side.uncut_depth for side in sides]
        errors = np.maximum(errors, depths).tolist()
    return cost_of_sides(sides, errors, sides[0].solid.volume)


def _is_convex(cell: Cell) -> bool:
    """Return whether a hull adds next to no volume to a piece."""
    return cell.hull.volume - cell.volume < _CONVEX * cell.hull.volume


def _middle(cell: Cell) -> FloatArray:
    """Return the plane across the longest side of a piece's box, (1, 4)."""
    box = roughly_around(cell.hull, "BOX")
    normal = box.axes[np.round(box.sizes, 6).argmax()]
    return settled(np.append(normal, -normal @ box.center)[None])


def _distinct(planes: FloatArray) -> Iterator[FloatArray]:
    """Yield the first planes (4,) that differ from those before, `_TRIES` at most."""
    taken = np.zeros((0, 4))
    for plane in planes:
        along = taken[:, :3] @ plane[:3]
        shifts = np.abs(np.sign(along) * taken[:, 3] - plane[3])
        if not ((np.abs(along) > _ALIKE) & (shifts < _NEAR)).any():
            yield plane
            taken = np.concatenate([taken, plane[None]])
        if len(taken) == _TRIES:
            return
