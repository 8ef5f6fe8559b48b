"""Join neighboring pieces where one hull can replace two."""

from __future__ import annotations

import heapq
from collections.abc import Callable, Sequence
from itertools import count

import numpy as np

from ..steps.progress import Progress, Steps, within
from .cost import COST_STEP, cost_of_joint, error_of_joint, least_cost
from .piece import Piece, join

# Pieces count as neighbors if their bounding boxes are at most this far apart along
# each axis; the longest side is 2.
_NEAR = 0.03
# Errors are bounded up to where another joint costs less, and a little more: each time
# something must be found out.
_BEYOND = 1.01

# Films are left out where other hulls are at most this far away: planes along a face
# take off 1e-7 of what is below it.
_COVERED = 1e-5

# Cost, numbers of two pieces, the joined piece, and whether the cost is by its stated
# error. No piece while the cost is a bound.
_Joint = tuple[float, int, int, Piece | None, bool]
# The joined piece of each pair that was tried.
JoinedPairs = dict[tuple[Piece, Piece], Piece]


def join_pieces(
    pieces: Sequence[Piece], max_pieces: int, known: JoinedPairs, close: bool
) -> Steps[list[Piece]]:
    """Join neighbors, if there are too many pieces or if they are close as one.

    The pair of lowest cost is joined first. Pieces that are no neighbors are joined
    only if there are still more than `max_pieces`.

    Parameters
    ----------
    pieces : sequence of Piece
    max_pieces : int
        Largest number of pieces to return.
    known : JoinedPairs
        Joined pieces of pairs that were tried before, and from now on.
    close : bool
        Whether neighbors are joined, too, whose common error is allowed.

    Returns
    -------
    Steps of list of Piece
    """
    joined = yield from _join(pieces, max_pieces, known, close, _touch)
    if len(joined) > max_pieces:
        joined = yield from _join(joined, max_pieces, known, False, lambda *_: True)
    return joined


def part_again(pieces: list[Piece], max_pieces: int, known: JoinedPairs) -> list[Piece]:
    """Undo joints of pieces that are not close as one, while there is room for more.

    They were joined when there were too many pieces; others have been joined since.

    Parameters
    ----------
    pieces : list of Piece
    max_pieces : int
        Largest number of pieces to return.
    known : JoinedPairs
        Joined pieces of pairs, as `join_pieces` leaves them.

    Returns
    -------
    list of Piece
        Pieces come apart where both halves have smaller errors, the worst one first.
    """
    halves = {joint: pair for pair, joint in known.items()}
    while len(pieces) < max_pieces:
        far = [
            one
            for one in pieces
            if one in halves
            and not one.is_close
            and max(half.known_error for half in halves[one]) < one.known_error
        ]
        if not far:
            break
        worst = max(far, key=lambda one: round(one.known_error, 6))
        pieces = [*(one for one in pieces if one is not worst), *halves[worst]]
    return pieces


def without_films(pieces: Sequence[Piece]) -> list[Piece]:
    """Return pieces without the films that cuts leave along faces of others.

    Their hulls would be thickened, and cover nothing that those of others do not.

    Parameters
    ----------
    pieces : sequence of Piece

    Returns
    -------
    list of Piece
    """
    kept = list(pieces)
    for film in pieces:
        if film.is_film:
            rest = [one for one in kept if one is not film and _touch(one, film)]
            if _cover(rest, film):
                kept.remove(film)
    return kept


def _join(
    pieces: Sequence[Piece],
    max_pieces: int,
    known: JoinedPairs,
    close: bool,
    may: Callable[[Piece, Piece], bool],
) -> Steps[list[Piece]]:
    """Join the pairs of pieces that `may` allows, the cheapest first."""
    alive: dict[int, Piece] = {}
    queue: list[_Joint] = []
    solid_volume = sum(piece.volume for piece in pieces)

    def add(piece: Piece, number: int) -> Steps[None]:
        """Add a piece under a new number, and queue its joints with the others."""
        for other, neighbor in alive.items():
            if may(neighbor, piece):
                yield Progress("Joining", 0.0)
                cost = least_cost(neighbor, piece, solid_volume)
                heapq.heappush(queue, (cost, other, number, None, False))
        alive[number] = piece

    for number, piece in enumerate(pieces):
        yield Progress("Joining", 0.0)
        yield from add(piece, number)
    for number in count(len(pieces)):
        steps = _next_joint(alive, queue, max_pieces, known, close, solid_volume)
        share = 1 - len(alive) / (len(pieces) + 1)
        found = yield from within(steps, share, 1.0)
        if found is None:
            break
        one, other, joint = found
        del alive[one], alive[other]
        yield from within(add(joint, number), share, share)
    return list(alive.values())


def _next_joint(
    alive: dict[int, Piece],
    queue: list[_Joint],
    max_pieces: int,
    known: JoinedPairs,
    close: bool,
    solid_volume: float,
) -> Steps[tuple[int, int, Piece] | None]:
    """Return the numbers of the two pieces to join next, and the joined piece.

    A joint comes off the queue several times: with a lower bound of its cost, with the
    cost by its estimated error, and, if it is joined because there are too many pieces,
    with the cost by a bound of its error: estimates miss what is narrow. The bound is
    looked for while no other joint is known to cost less.
    """
    while queue:
        _, one, other, joint, sure = heapq.heappop(queue)
        if one not in alive or other not in alive:
            continue
        if joint is None:
            yield Progress("Joining", 0.0)
            pair = alive[one], alive[other]
            joint = known[pair] = known.get(pair) or join(*pair)
            _ = joint.hull
            yield Progress("Joining", 0.0)
            may_be_close = close and joint.may_be_close
            error = joint.error if may_be_close else joint.least_error
        elif close and (yield from joint.whether_close("Joining")):
            return one, other, joint
        elif len(alive) <= max_pieces:
            continue
        elif sure:
            return one, other, joint
        else:
            yield Progress("Joining", 0.0)
            next_cost = queue[0][0] if queue else np.inf
            limit = _error_beyond(joint, next_cost, solid_volume)
            limit = max(limit, joint.fit.max_error if close else 0.0)
            error = joint.bound.up_to(limit)
            sure = error <= limit
        cost = cost_of_joint(joint, error, solid_volume)
        heapq.heappush(queue, (cost, one, other, joint, sure))
    return None


def _error_beyond(joint: Piece, cost: float, solid_volume: float) -> float:
    """Return an error with which a joint costs more than another, also when rounded.

    A joint that costs the same would come off the queue again and again.
    """
    more = error_of_joint(joint, cost + COST_STEP, solid_volume)
    return max(error_of_joint(joint, cost, solid_volume) * _BEYOND, more)


def _touch(one: Piece, other: Piece) -> bool:
    """Return whether the bounding boxes of two pieces meet or nearly meet."""
    (low, high), (other_low, other_high) = one.hull.bounds, other.hull.bounds
    return bool(((low - _NEAR <= other_high) & (other_low - _NEAR <= high)).all())


def _cover(pieces: Sequence[Piece], film: Piece) -> bool:
    """Return whether the hulls of other pieces hold all points of a film."""
    points = np.concatenate([film.points, film.boundary])
    for piece in pieces:
        points = points[piece.hull.heights(points) > _COVERED]
    return len(points) == 0
