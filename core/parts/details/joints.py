"""Cuts spikes off parts, and limbs at knees and necks, where lines of sight agree."""

from __future__ import annotations

from dataclasses import replace
from functools import partial

import numpy as np

from ...geometry.graphs.components import nodes_at_seams
from ...geometry.graphs.face_graph import FaceGraph
from ...parameters.parts import Parameters
from ...results.parts import Decomposition
from ...steps.arrays import BoolArray, IntArray
from ...steps.memo import digest
from ...steps.progress import Progress, Steps, within, within_turn
from ..describe import by_size, describe
from ..merging.pieces import connected_parts
from ..part_memo import PartMemo
from ..part_psi import count_parts
from ..partition import Partitioner
from ..seams.smoothing import smooth_seams
from .limb_joints import cut_limbs
from .seen import count_pairs, seen_apart
from .spikes import find_spikes
from .surface import PartSurface

# Parts that see this much of themselves hide neither.
_MOST_RANK = 0.95


def cut_joints(
    memo: PartMemo, found: Decomposition, parameters: Parameters
) -> Steps[Decomposition]:
    """Cut spikes off parts, and limbs at their knees and necks.

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
        are not cut at knees.

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
        wanted = range(2, int(nodes.max()) * 2)
        nodes = yield from Partitioner(memo, parameters).evened(nodes, wanted)
    ks = found.psi_by_k, found.best_k
    cut_parts = describe(memo.visibility, by_size(nodes, shape), parameters, *ks)
    return replace(cut_parts, notes=found.notes)


def _smooth(
    graph: FaceGraph, members: BoolArray, labels: IntArray, parameters: Parameters
) -> Steps[IntArray]:
    """Return the pieces (P,) of a part after their seams are smoothed, 0 elsewhere."""
    kept = np.flatnonzero(members)
    part = graph.part(kept)
    n_pieces, smoothness = count_parts(labels), parameters.smoothness
    least = parameters.smallest_part * graph.areas.sum()
    pieces = labels[kept]
    if smoothness > 0:
        pieces = yield from smooth_seams(part, pieces, range(n_pieces), smoothness)
    found = np.zeros(len(members), dtype=np.int64)
    found[kept] = connected_parts(part, pieces, least)
    return found


def _pieces(
    memo: PartMemo, nodes: IntArray, chosen: IntArray, parameters: Parameters
) -> Steps[dict[int, IntArray]]:
    """Return the pieces (P,) of each part that is cut; 0 is the one at its seams."""
    transfer = yield from memo.transfer_in_steps()
    graph, parts = transfer.graph, memo.on_patches(nodes)
    at_seams = nodes_at_seams(graph.neighbors, parts)
    least = parameters.smallest_part * float(graph.areas.sum())
    spiky, others = {}, {}
    for turn, part in enumerate(chosen.tolist()):
        yield Progress("Details", turn / len(chosen))
        kept = np.flatnonzero(parts == part)
        if not at_seams[kept].any():
            continue
        place = np.zeros_like(parts)
        place[kept] = 1 + at_seams[kept]
        make = partial(PartSurface, graph, kept, at_seams)
        surface = memo.surfaces.recall(digest(place), make)
        count = partial(count_pairs, memo, kept)
        found = find_spikes(surface, least)
        spikes = seen_apart(len(kept), found, count, parameters.alpha)
        if spikes.any():
            spiky[part] = kept, spikes
        else:
            others[part] = surface, count
    cut = spiky | (yield from cut_limbs(others, parameters.bends != "KEEP"))
    return {part: _on_all(*pieces, memo) for part, pieces in cut.items()}


def _on_all(kept: IntArray, labels: IntArray, memo: PartMemo) -> IntArray:
    """Return labels (P,) of all nodes of a shape from those of a part's nodes."""
    found = np.zeros(memo.transfer.graph.n_polygons, dtype=np.int64)
    found[kept] = labels
    return memo.off_patches(found)
