"""From visibility to parts, and the figures of parts."""

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
        The visibility, and what was found from it before.
    parameters : Parameters
        May differ from those of the visibility where they do not affect sight.
    """
    return (yield from on_one_thread(_find_parts(memo, parameters)))


def _find_parts(memo: PartMemo, parameters: Parameters) -> Steps[Decomposition]:
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
    """Return the figures of given parts.

    Parameters
    ----------
    visibility : Visibility
        Of the shape.
    labels : (P,) int
        Part of each polygon, or point, in 0…K − 1, each used; kept as they are.
    parameters : Parameters
        Whose alpha weights psi.
    psi_by_k : dict of int to float
        Psi for the numbers of parts that were tried.
    best_k : int
        The number among them that a search chooses.
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
    """Return the parts renumbered, the largest first."""
    order = np.argsort(-graph.areas_of(parts), kind="stable")
    return np.argsort(order)[parts]


def _notes_on_shells(transfer: Transfer) -> tuple[str, ...]:
    """Say that most pieces could not be told apart, if so."""
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
    """Say why there are not as many parts as asked for, if so."""
    wanted, most = parameters.parts or parameters.min_parts, max(psi_by_k)
    alone = not parameters.parts and wanted == 2  # one part is an answer, too
    if most >= wanted or alone:
        return ()
    return (
        f"At most {most} of the {wanted} parts asked for can be made: there are too few"
        " faces or samples, or the parts are too small; subdivide the mesh, raise"
        " Samples or lower Smallest Part.",
    )
