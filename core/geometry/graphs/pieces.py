"""Points all over a surface: where its polygons are large, several on each."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from ...steps.arrays import FloatArray, IntArray
from ...steps.progress import Progress, Steps, mapped
from ..cutting.refined import refined
from ..mesh import TriangleMesh
from .face_graph import FaceGraph, face_graph


class Pieces(NamedTuple):
    """Polygons, and small pieces of them.

    Attributes
    ----------
    centers, normals : (Q, 3) float
    areas : (Q,) float
        0 of polygons whose pieces are here, too.
    polygons : (Q,) int
        Polygon that each is, or is a piece of.
    """

    centers: FloatArray
    normals: FloatArray
    areas: FloatArray
    polygons: IntArray


def whole_polygons(graph: FaceGraph) -> Pieces:
    """Return the polygons of a graph."""
    numbers = np.arange(graph.n_polygons)
    return Pieces(graph.centers, graph.normals, graph.areas, numbers)


def with_small_pieces(graph: FaceGraph, mesh: TriangleMesh) -> Steps[Pieces | None]:
    """Return the polygons of a graph and small pieces of all, None if none is large.

    Parameters
    ----------
    graph : FaceGraph
    mesh : TriangleMesh
        It has the polygons of the graph, and may have others with larger numbers.

    Returns
    -------
    Steps of Pieces or None
    """
    fine = refined(mesh)
    if len(fine.faces) == mesh.n_polygons:
        return None
    kept = np.flatnonzero(fine.faces < graph.n_polygons)
    steps = mapped(face_graph(fine.mesh), lambda _: Progress("Symmetry", 0.0))
    whole, pieces = whole_polygons(graph), (yield from steps).part(kept)
    return Pieces(
        np.concatenate([whole.centers, pieces.centers]),
        np.concatenate([whole.normals, pieces.normals]),
        np.concatenate([0 * whole.areas, pieces.areas]),
        np.concatenate([whole.polygons, fine.faces[kept]]),
    )
