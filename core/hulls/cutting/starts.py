"""Choose what to cut: the whole, its walls without thickness, or its shells."""

from __future__ import annotations

from collections.abc import Sequence

from ...steps.progress import Progress, Steps, within
from ..piece import Piece
from .cell import Cell
from .close_pieces import close_pieces
from .plates import plates_of
from .shells import shells_of

# Largest number of pieces to start with, as a multiple of Most Hulls.
_SURPLUS = 2


def pieces_of(cell: Cell, most: int) -> Steps[list[Piece]]:
    """Cut a whole until all pieces are close; try its walls and its shells as well.

    Cuts find neither: while two walls are left, their hull strays as far as that of
    all, and planes beside one board run through others.

    Parameters
    ----------
    cell : Cell
        The whole.
    most : int
        Largest number of pieces to return.

    Returns
    -------
    Steps of list of Piece
        What keeps to the largest error, or strays less. Then the fewer ones.
    """
    if (yield from within(cell.whether_close("Cutting"), 0.0, 0.0)):
        return [cell]
    starts, late = yield from within(_starts_of(cell, _SURPLUS * most), 0.0, 0.0)
    found, done = list[Piece](), False
    for turn, start in enumerate(starts):
        low, high = turn / len(starts), (turn + 1) / len(starts)
        only_close = done or start is late
        steps = close_pieces(start, len(found) - 1 if done else most, only_close)
        pieces = yield from within(steps, low, high)
        found = yield from within(_better(found, pieces), high, high)
        n_close = yield from within(_count_close(found), high, high)
        done = n_close == len(found)
        if done and n_close == 1:
            break
    return found


def _starts_of(cell: Cell, most: int) -> Steps[tuple[list[list[Cell]], list[Cell]]]:
    """Return what to begin with, in turn, and which of it is of use if all is close.

    Where most shells must be cut, they seldom need fewer cuts than the whole, and
    hardly ever where nothing tells what of them others bury.
    """
    shells = yield from shells_of(cell, most)
    early = 2 * (yield from _count_close(shells)) > len(shells)
    late = shells if cell.solid.closed and not early else []
    starts = [shells if early else [], plates_of(cell, most), [cell], late]
    return [start for start in starts if start], late


def _count_close(pieces: Sequence[Piece]) -> Steps[int]:
    """Return how many pieces are close."""
    count = 0
    for piece in pieces:
        count += yield from piece.whether_close("Cutting")
    return count


def _better(one: list[Piece], other: list[Piece]) -> Steps[list[Piece]]:
    """Return the pieces that stray less, or the fewer ones if none strays too far."""
    if not (one and other):
        return one or other
    ranks = []
    for pieces in (one, other):
        farthest = pieces[0].fit.max_error
        for piece in pieces:
            yield Progress("Cutting", 1.0)
            farthest = max(farthest, piece.bound.value)
        ranks.append((farthest, len(pieces)))
    return one if ranks[0] <= ranks[1] else other
