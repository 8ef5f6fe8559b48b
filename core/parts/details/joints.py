"""Cuts spikes off parts, and limbs at their knees, where few lines of sight cross."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from functools import partial
from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray

from ...geometry.face_graph import FaceGraph
from ...parameters.parts import Parameters
from ...results.parts import Decomposition
from ...sight.pair_tally import PairTally
from ...steps.memo import digest
from ...steps.progress import Progress, Steps, within, within_turn
from ..describe import by_size, describe
from ..merging.pieces import connected_parts
from ..part_memo import PartMemo
from ..partition import Partitioner
from ..seam_smoothing import smooth_seams
from .knees import Knees, find_knees
from .spikes import find_spikes
from .surface import PartSurface

Count: TypeAlias = Callable[[NDArray[np.int64], int], PairTally]

# Parts that see this much of themselves hide neither.
_MOST_RANK = 0.95
# Largest share of pairs across a knee that see each other.
_MOST_SEEN = 0.5
# What is left of a part without its spikes, and the pieces beside a knee, see at least
# so much of themselves: a wing of feathers has no spikes, and an arc no knees.
_LEAST_BODY = 0.8
_LEAST_PIECE = 0.6
# Fewer samples of a piece say nothing.
_FEWEST_SAMPLES = 10
# The limbs of a shape bend alike: one has to turn by this much, in radians.
_CLEAR_TURN = 0.87


def cut_joints(
    memo: PartMemo, found: Decomposition, parameters: Parameters
) -> Steps[Decomposition]:
    """Cut spikes off parts, and limbs at their knees.

    Both are found on the surface. They are cut where the lines of sight that are known
    already agree, so that no ray is cast.

    Parameters
    ----------
    memo : PartMemo
        Of this shape.
    found : Decomposition
        Its parts.
    parameters : Parameters
        `smallest_part`, `smoothness` and `alpha` are used. If `bends` are kept, limbs
        are not cut.

    Returns
    -------
    Steps of Decomposition
        By area, the largest first; `found` itself if nothing is cut.
    """
    shape = memo.visibility.shape
    chosen = np.flatnonzero(found.ranks < _MOST_RANK)
    if shape.plane is not None or found.n_parts == 1 or len(chosen) == 0:
        return found
    nodes = shape.labels_of_nodes(found.labels)
    pieces = yield from within(_pieces(memo, nodes, chosen, parameters), 0.0, 0.7)
    for turn, (part, labels) in enumerate(pieces.items()):
        steps = _smooth(shape.graph, nodes == part, labels, parameters)
        cut = yield from within(within_turn(steps, turn, len(pieces)), 0.7, 1.0)
        nodes = np.where(cut > 0, nodes.max() + cut, nodes)
    if nodes.max() < found.n_parts:
        return found
    if memo.patches is None:
        nodes = yield from _evened(memo, nodes, parameters)
    numbered = by_size(nodes, shape.graph)[shape.nodes]
    visibility, ks = memo.visibility, (found.psi_by_k, found.best_k)
    cut_parts = describe(visibility, numbered, parameters, *ks)
    return replace(cut_parts, notes=found.notes)


def _evened(
    memo: PartMemo, nodes: NDArray[np.int64], parameters: Parameters
) -> Steps[NDArray[np.int64]]:
    """Return parts (P,) symmetric to the mirror plane, if psi is as high then."""
    by = Partitioner(memo, parameters)
    even = yield from by.symmetric(nodes, range(2, int(nodes.max()) * 2))
    least = by.psi(nodes) - 2 * by.negligible
    best = max(even, key=lambda each: each.psi, default=None)
    return nodes if best is None or best.psi < least else best.parts


def _smooth(
    graph: FaceGraph,
    members: NDArray[np.bool_],
    labels: NDArray[np.int64],
    parameters: Parameters,
) -> Steps[NDArray[np.int64]]:
    """Return the pieces (P,) of a part after their seams are smoothed, 0 elsewhere."""
    kept = np.flatnonzero(members)
    part = graph.part(kept)
    n_pieces, smoothness = int(labels.max()) + 1, parameters.smoothness
    least = parameters.smallest_part * graph.areas.sum()
    pieces = labels[kept]
    if smoothness > 0:
        pieces = yield from smooth_seams(part, pieces, range(n_pieces), smoothness)
    found = np.zeros(len(members), dtype=np.int64)
    found[kept] = connected_parts(part, pieces, least)
    return found


def _pieces(
    memo: PartMemo,
    nodes: NDArray[np.int64],
    chosen: NDArray[np.int64],
    parameters: Parameters,
) -> Steps[dict[int, NDArray[np.int64]]]:
    """Return the pieces (P,) of each part that is cut; 0 is the one at its seams."""
    transfer = yield from memo.transfer_in_steps()
    graph, patches = transfer.graph, memo.patches
    parts = nodes if patches is None else patches.labels_of_patches(nodes)
    one, other = parts[graph.neighbors].T
    at_seams = np.zeros(len(parts), dtype=bool)
    at_seams[graph.neighbors[one != other]] = True
    least = parameters.smallest_part * float(graph.areas.sum())
    spiky, bent, turns = {}, {}, [0.0]
    for turn, part in enumerate(chosen.tolist()):
        yield Progress("Details", turn / len(chosen))
        kept = np.flatnonzero(parts == part)
        if not at_seams[kept].any():
            continue
        place = np.where(parts == part, 1 + at_seams, 0)
        surface = memo.surfaces.recall(
            digest(place), partial(PartSurface, graph, kept, at_seams)
        )
        count = partial(_tally, memo, kept)
        found = find_spikes(surface, least)
        spikes = _seen_apart(np.zeros_like(kept), found, count, parameters.alpha)
        if spikes.any():
            spiky[part] = _on_all(kept, spikes, memo)
            continue
        knees = _seen_beyond(find_knees(surface), count)
        if knees.turns and parameters.bends != "KEEP":
            bent[part] = _on_all(kept, knees.pieces, memo)
            turns += knees.turns
    return spiky | bent if max(turns) >= _CLEAR_TURN else spiky


def _tally(
    memo: PartMemo, kept: NDArray[np.int64], labels: NDArray[np.int64], n_labels: int
) -> PairTally:
    """Count pairs of samples by labels (M,) of a part's nodes; the rest comes last."""
    on_all = np.full(memo.transfer.graph.n_polygons, n_labels)
    on_all[kept] = labels
    samples = memo.transfer.to_samples(on_all)
    return memo.visibility.psi_pairs.tally(samples, n_labels + 1)


def _on_all(
    kept: NDArray[np.int64], labels: NDArray[np.int64], memo: PartMemo
) -> NDArray[np.int64]:
    """Return labels (P,) of all nodes of a shape from those of a part's nodes."""
    found = np.zeros(memo.transfer.graph.n_polygons, dtype=np.int64)
    found[kept] = labels
    return found if memo.patches is None else found[memo.patches.of_nodes]


def _seen_apart(
    labels: NDArray[np.int64],
    spikes: list[NDArray[np.int64]],
    count: Count,
    alpha: float,
) -> NDArray[np.int64]:
    """Return the number (M,) of the spike that each node lies on, 0 for the body.

    Only spikes count without which psi is larger. The body has to be nearly convex.
    """
    for number, spike in enumerate(spikes, 1):
        labels[spike] = number
    if not spikes:
        return labels
    tally = count(labels, len(spikes) + 1)
    for number in range(len(spikes), 0, -1):
        loss = tally.merge_gains(alpha)[0, number]
        if loss >= 0 or not _sampled(tally)[number]:
            tally = tally.merged(0, number)
            labels[labels == number] = 0
            labels[labels > number] -= 1
    return labels if tally.ranks()[0] >= _LEAST_BODY else np.zeros_like(labels)


def _seen_beyond(knees: Knees, count: Count) -> Knees:
    """Return the knees that divide two pieces which see little of each other.

    Both have to be nearly convex.
    """
    pieces, turns = knees.pieces, list(knees.turns)
    if not turns:
        return knees
    tally = count(pieces, len(turns) + 1)
    shares = tally.visible / np.maximum(tally.known, 1)
    seen = np.diagonal(shares, 1)[:-1].tolist()
    while turns:
        whole = (tally.ranks() >= _LEAST_PIECE) & _sampled(tally)
        fine = whole[:-2] & whole[1:-1] & (np.array(seen) < _MOST_SEEN)
        if fine.all():
            break
        knee = int(np.where(fine, np.inf, turns).argmin())
        del turns[knee], seen[knee]
        tally = tally.merged(knee, knee + 1)
        pieces = np.where(pieces > knee, pieces - 1, pieces)
    return Knees(pieces, turns)


def _sampled(tally: PairTally) -> NDArray[np.bool_]:
    """Return which pieces have enough samples (K,)."""
    enough: NDArray[np.bool_] = np.diag(tally.known) >= _FEWEST_SAMPLES**2
    return enough
