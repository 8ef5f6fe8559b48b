"""Finds the parts of a shape from its visibility, and measures given parts."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from ..geometry.face_graph import FaceGraph
from ..geometry.transfer import Transfer
from ..parameters.parts import Parameters
from ..results import Decomposition
from ..sight.visibility import Visibility
from ..steps.one_thread import on_one_thread
from ..steps.progress import Steps
from .part_count import PartCountSearch
from .part_memo import PartMemo
from .partition import Partitioner, count_parts
from .seams import SeamCutter


def find_parts(memo: PartMemo, parameters: Parameters) -> Steps[Decomposition]:
    """Find the parts of a shape from its visibility.

    Parameters
    ----------
    memo : PartMemo
        The visibility, with results of earlier calls; new results are added.
    parameters : Parameters
        They may differ from the parameters of the visibility in settings that do not
        affect samples or lines of sight.

    Returns
    -------
    Steps of Decomposition
        The steps yield `Progress`; `run` returns the decomposition.
    """
    return (yield from on_one_thread(_find_parts(memo, parameters)))


def _find_parts(memo: PartMemo, parameters: Parameters) -> Steps[Decomposition]:
    """Find the parts; `find_parts` runs these steps on one thread."""
    visibility, cut = memo.visibility, memo.cut(parameters)
    partitioner = Partitioner(memo, parameters)
    search = PartCountSearch(
        partitioner,
        SeamCutter(partitioner, cut.seams),
        parameters.min_parts,
        parameters.max_parts,
        cut.searches,
    )
    wanted = search.given(parameters.parts) if parameters.parts else search.best()
    parts, psi_by_k, best_k = yield from wanted
    labels = by_size(parts, visibility.transfer.graph)[visibility.shape.nodes]
    found = describe(visibility, labels, parameters, psi_by_k, best_k)
    return replace(
        found,
        notes=found.notes
        + _notes_on_shells(visibility.transfer)
        + _notes_on_count(parameters, psi_by_k),
    )


def describe(
    visibility: Visibility,
    labels: NDArray[np.int64],
    parameters: Parameters,
    psi_by_k: dict[int, float],
    best_k: int,
) -> Decomposition:
    """Measure given parts: area, number of faces, convexity rank and psi.

    Parameters
    ----------
    visibility : Visibility
        Visibility of the shape that the parts belong to.
    labels : (P,) int
        Part of each polygon, or of each point of a cloud, in 0…K − 1, each used. They
        are not renumbered.
    parameters : Parameters
        Only `alpha`, the weight in psi, is used.
    psi_by_k : dict of int to float
        Psi for the numbers of parts that were tried, stored as it is.
    best_k : int
        The number of parts that a search chooses, stored as it is.

    Returns
    -------
    Decomposition
    """
    n_parts, transfer = count_parts(labels), visibility.transfer
    parts = visibility.shape.labels_of_nodes(labels)
    samples = transfer.to_samples(parts)
    pairs = visibility.psi_pairs
    whole = pairs.tally(np.zeros_like(samples), 1)
    areas = np.bincount(parts, transfer.graph.areas, n_parts)
    return Decomposition(
        labels=labels,
        areas=areas.astype(np.float64) * visibility.shape.diagonal**2,
        face_counts=np.bincount(labels),
        ranks=visibility.rank_pairs.tally(samples, n_parts).ranks(),
        psi_before=whole.psi(parameters.alpha),
        psi=pairs.tally(samples, n_parts).psi(parameters.alpha),
        psi_by_k=psi_by_k,
        best_k=best_k,
        notes=visibility.shape.notes,
        normals=visibility.shape.normals,
    )


def by_size(parts: NDArray[np.int64], graph: FaceGraph) -> NDArray[np.int64]:
    """Renumber parts by area, the largest first.

    Parameters
    ----------
    parts : (P,) int
        Part of each node of `graph`, in 0…K − 1.
    graph : FaceGraph

    Returns
    -------
    parts : (P,) int
    """
    order = np.argsort(-graph.areas_of(parts), kind="stable")
    return np.argsort(order)[parts]


def _notes_on_shells(transfer: Transfer) -> tuple[str, ...]:
    """Return a note if most shells are too small for a sample of their own."""
    if transfer.n_unsampled <= transfer.n_shells / 2:
        return ()
    return (
        f"{transfer.n_unsampled:,} of {transfer.n_shells:,} loose pieces are too small"
        " for a sample of their own and go with the nearest one; raise Samples to tell"
        " them apart.",
    )


def _notes_on_count(
    parameters: Parameters, psi_by_k: dict[int, float]
) -> tuple[str, ...]:
    """Return a note if the shape cannot be split into the number of parts asked for."""
    wanted, most = parameters.parts or parameters.min_parts, max(psi_by_k)
    # By default the search may well end with one part: that deserves no note.
    alone = not parameters.parts and wanted == 2
    if most >= wanted or alone:
        return ()
    return (
        f"At most {most} of the {wanted} parts asked for can be made: there are too few"
        " faces or samples, or the parts are too small; subdivide the mesh, raise"
        " Samples or lower Smallest Part.",
    )
