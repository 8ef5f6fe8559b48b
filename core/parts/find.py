"""From visibility to parts, and what is told of them."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from ..geometry.face_graph import FaceGraph
from ..geometry.transfer import Transfer
from ..parameters.parts import Parameters
from ..sight.visibility import Visibility
from ..steps.one_thread import on_one_thread
from ..steps.progress import Steps
from .part_count import given_part_count, search_part_count
from .partition import Partitioner, count


@dataclass(frozen=True, eq=False)
class Decomposition:
    """The parts of a shape.

    Attributes
    ----------
    labels : (P,) int
        Part of each polygon, or point of a cloud, 0-based; the largest comes first.
    areas : (K,) float
        Area of each part, in the units of the shape squared.
    face_counts : (K,) int
        Polygons, or points, of each part.
    ranks : (K,) float
        Convexity rank of each part (eq. 1).
    psi_before : float
        Psi of one part: the convexity rank of the whole shape, but for containers.
    psi : float
        Quality of the parts (eq. 5).
    psi_by_k : dict of int to float
        Psi for every number of parts that was tried, before seams were cut.
    best_k : int
        The number among them that a search chooses.
    notes : tuple of str
        Sentences to the user about what is worth knowing.
    normals : (P, 3) float or None
        Outward normals of the points of a cloud whose own were missing or wrong.
    """

    labels: NDArray[np.int64]
    areas: NDArray[np.float64]
    face_counts: NDArray[np.int64]
    ranks: NDArray[np.float64]
    psi_before: float
    psi: float
    psi_by_k: dict[int, float]
    best_k: int
    notes: tuple[str, ...]
    normals: NDArray[np.float64] | None = None

    @property
    def n_parts(self) -> int:
        """Number of parts K."""
        return len(self.areas)


def find_parts(visibility: Visibility, parameters: Parameters) -> Steps[Decomposition]:
    """Return the parts for `parameters` from a visibility computed before.

    Every `recut` among the parameters may differ from those that `visibility` was
    computed with.
    """
    return (yield from on_one_thread(_find_parts(visibility, parameters)))


def _find_parts(visibility: Visibility, parameters: Parameters) -> Steps[Decomposition]:
    surface = visibility.transfer.surface
    partitioner = Partitioner(visibility, parameters)
    if parameters.parts:
        search = given_part_count(
            partitioner, parameters.parts, parameters.min_parts, parameters.max_parts
        )
    else:
        search = search_part_count(
            partitioner, parameters.min_parts, parameters.max_parts
        )
    parts, psi_by_k, best_k = yield from search
    labels = by_size(parts, surface)[visibility.form.nodes]
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
    n_parts, transfer = count(labels), visibility.transfer
    parts = visibility.form.labels_of_nodes(labels)
    samples = transfer.to_samples(parts)
    pairs = visibility.pairs
    whole = pairs.tally(np.zeros_like(samples), 1)
    areas = np.bincount(parts, transfer.surface.areas, n_parts)
    return Decomposition(
        labels=labels,
        areas=areas.astype(np.float64) * visibility.unit_area,
        face_counts=np.bincount(labels),
        ranks=visibility.ranked.tally(samples, n_parts).ranks(),
        psi_before=whole.psi(parameters.alpha),
        psi=pairs.tally(samples, n_parts).psi(parameters.alpha),
        psi_by_k=psi_by_k,
        best_k=best_k,
        notes=visibility.form.notes,
        normals=visibility.form.normals,
    )


def by_size(parts: NDArray[np.int64], surface: FaceGraph) -> NDArray[np.int64]:
    """Return the parts renumbered, the largest first."""
    order = np.argsort(-surface.areas_of(parts), kind="stable")
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
