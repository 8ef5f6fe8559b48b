"""Measures given parts: area, number of faces, convexity rank and psi."""

from __future__ import annotations

import numpy as np

from ..clusters.moves import MoveGains
from ..geometry.transfer import Transfer
from ..parameters.parts import Parameters
from ..results.parts import Decomposition
from ..sight.prepared import PreparedShape
from ..sight.visibility import Visibility
from ..steps.arrays import IntArray
from .part_psi import PartPsi, count_parts

# A face with fewer samples is small: its samples say little.
_ENOUGH_SAMPLES = 8
# A face lies in several parts if at least this share of its samples belongs elsewhere.
_MANY_DRAWN = 0.25
# Least share of the area of such faces that is worth a note.
_MUCH_AREA = 0.1


def describe(
    visibility: Visibility,
    labels: IntArray,
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
    n_parts = count_parts(labels)
    parts = visibility.shape.labels_of_nodes(labels)
    samples = parts[visibility.nodes]
    pairs = visibility.psi_pairs
    whole = pairs.tally(np.zeros_like(samples), 1)
    areas = np.bincount(parts, visibility.shape.graph.areas, n_parts)
    return Decomposition(
        labels=labels,
        areas=areas.astype(np.float64) * visibility.shape.diagonal**2,
        ranks=visibility.rank_pairs.tally(samples, n_parts).ranks(),
        psi_before=whole.psi(parameters.alpha),
        psi=pairs.tally(samples, n_parts).psi(parameters.alpha),
        psi_by_k=psi_by_k,
        best_k=best_k,
        notes=visibility.shape.notes,
        normals=visibility.shape.normals,
        pairs_cast=pairs.n_cast,
        pairs_inferred=pairs.n_inferred,
    )


def by_size(nodes: IntArray, shape: PreparedShape) -> IntArray:
    """Renumber parts by area, the largest first.

    Parameters
    ----------
    nodes : (`n_nodes`,) int
        Part of each node of the shape, in 0…K − 1.
    shape : PreparedShape

    Returns
    -------
    labels : (P,) int
        New number of the part of each polygon, or of each point of a cloud.
    """
    order = np.argsort(-shape.graph.areas_of(nodes), kind="stable")
    return np.argsort(order)[nodes][shape.nodes]


def notes_on(found: Decomposition, part_psi: PartPsi) -> tuple[str, ...]:
    """Say what kept the parts from being as they were asked for, or could be.

    Parameters
    ----------
    found : Decomposition
    part_psi : PartPsi
        What found them.

    Returns
    -------
    tuple of str
        Sentences to the user.
    """
    on_count = notes_on_count(part_psi.parameters, max(found.psi_by_k))
    on_faces = on_count or _notes_on_faces(found, part_psi)
    return _notes_on_shells(part_psi.transfer) + on_faces


def _notes_on_faces(found: Decomposition, part_psi: PartPsi) -> tuple[str, ...]:
    """Return a note if faces of much area lie in several parts.

    A face does if it carries enough samples, and many of them would raise psi in
    another part than that of the face.
    """
    visibility, nodes = part_psi.visibility, part_psi.visibility.nodes
    if visibility.shape.is_cloud or part_psi.parameters.seams == "CUT":
        return ()
    counts = np.bincount(nodes)
    if counts.max() < _ENOUGH_SAMPLES:  # fine meshes need no look at psi
        return ()
    labels = visibility.shape.labels_of_nodes(found.labels)[nodes]
    moves = MoveGains(visibility.psi_pairs, labels, found.n_parts)
    gains = moves.of(slice(None), part_psi.parameters.alpha)
    drawn = gains.max(axis=1) > gains[np.arange(len(labels)), labels]
    share_drawn = np.bincount(nodes, drawn) / np.maximum(counts, 1)
    spanning = (counts >= _ENOUGH_SAMPLES) & (share_drawn >= _MANY_DRAWN)
    share = counts[spanning].sum() / len(nodes)
    if share < _MUCH_AREA:
        return ()
    return (
        f"Faces with {share:.0%} of the area lie in several parts each; choose Cut"
        " Faces for Seams to cut them there, or subdivide the mesh.",
    )


def _notes_on_shells(transfer: Transfer) -> tuple[str, ...]:
    """Return a note if most shells are too small for a sample of their own."""
    if transfer.n_unsampled <= transfer.n_shells / 2:
        return ()
    return (
        f"{transfer.n_unsampled:,} of {transfer.n_shells:,} loose pieces are too small"
        " for a sample and join the nearest piece that has one; raise Samples to"
        " separate them.",
    )


def notes_on_count(parameters: Parameters, most: int) -> tuple[str, ...]:
    """Return a note if a shape cannot be split into the number of parts asked for.

    Parameters
    ----------
    parameters : Parameters
    most : int
        The largest number of parts that could be made.

    Returns
    -------
    tuple of str
        Sentences to the user.
    """
    wanted = parameters.parts or parameters.min_parts
    # By default the search may well end with one part: that deserves no note.
    alone = not parameters.parts and wanted == Parameters.min_parts
    if most >= wanted or alone:
        return ()
    return (
        f"Only {most} of the {wanted} parts could be made: there are too few faces or"
        " samples, or Smallest Part is too large; subdivide the mesh, raise Samples or"
        " lower Smallest Part.",
    )
