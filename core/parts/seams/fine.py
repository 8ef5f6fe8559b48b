"""Carries parts from the patches of a large mesh to its polygons.

Seams between patches are ragged. They are cut once more where only the polygons along
them count on their own.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from ...geometry.graphs.components import nodes_at_seams
from ...geometry.graphs.patches import Patches
from ...steps.arrays import IntArray
from ...steps.memo import digest
from ...steps.progress import Progress, Steps, within
from ..part_psi import count_parts
from ..partition import Partitioner
from .cutter import SeamCutter, Seams

# Least smoothness: borders of patches are ragged.
_LEAST_SMOOTHNESS = 0.1
# Most sweeps of the cut: seams are near their places, and more hardly shorten them.
_SWEEPS = 2


def parts_of_nodes(
    partitioner: Partitioner, seams: Seams, rough: bool = False
) -> Steps[IntArray]:
    """Return the part of each node of a shape's graph.

    Parameters
    ----------
    partitioner : Partitioner
        What found the parts.
    seams : Seams
        Parts of the patches, or of the nodes if there are no patches.
    rough : bool, optional
        Whether seams stay between patches.

    Returns
    -------
    Steps of (P,) int
    """
    patches, parts = partitioner.memo.patches, seams.parts
    if patches is None or rough or count_parts(parts) == 1:
        return partitioner.memo.off_patches(parts)
    fine = partitioner.found.fine
    steps = fine.recall_steps(_key(seams), lambda: _cut(partitioner, patches, seams))
    return (yield from steps).astype(np.int64)


def seams_take_long(partitioner: Partitioner, seams: Seams) -> bool:
    """Return whether `parts_of_nodes` has seams to cut; it takes the same values."""
    several = partitioner.memo.patches is not None and count_parts(seams.parts) > 1
    return several and _key(seams) not in partitioner.found.fine


def _key(seams: Seams) -> tuple[float, bytes]:
    """Return the key under which the parts of the nodes are kept."""
    return seams.smoothness, digest(seams.parts)


def _cut(
    partitioner: Partitioner, patches: Patches, seams: Seams
) -> Steps[NDArray[np.uint16]]:
    """Cut the seams where the nodes of the patches along them count on their own.

    The labels take little room: many are kept.
    """
    yield Progress("Seams", 0.0)
    coarse, parts = patches.coarse, seams.parts
    chosen = nodes_at_seams(coarse.neighbors, parts)
    # Patches beside those are opened, too. No cut moves a seam across more.
    beside = chosen[coarse.neighbors].any(axis=1)
    chosen[coarse.neighbors[beside]] = True
    graph, places = yield from within(patches.opened(chosen), 0.0, 0.1)
    yield Progress("Seams", 0.1)
    nodes = places[partitioner.visibility.nodes]
    opened = np.flatnonzero(chosen[patches.of_nodes])
    numbers = np.concatenate([len(places) + np.flatnonzero(~chosen), opened])
    on_nodes = yield from within(partitioner.memo.on(graph, nodes, numbers), 0.1, 0.3)
    yield Progress("Seams", 0.3)
    start = np.zeros(graph.n_polygons, dtype=np.int64)
    start[places] = parts[patches.of_nodes]
    yield Progress("Seams", 0.3)
    enough = partitioner.psi(parts) - partitioner.sampling_error / 2
    smoothness = max(seams.smoothness, _LEAST_SMOOTHNESS)
    parameters = replace(partitioner.parameters, smoothness=smoothness)
    finer = Partitioner(on_nodes, parameters)
    cutter = SeamCutter(finer, _SWEEPS)
    cut = yield from within(cutter.cut(start, enough), 0.3, 0.9)
    smooth = yield from within(cutter.smoothed(cut), 0.9, 1.0)
    return smooth.parts[places].astype(np.uint16)
