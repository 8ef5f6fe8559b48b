"""Shapes made ready to be sampled, looked through and labeled."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from ..clouds.neighbor_graph import neighbor_graph
from ..clouds.normals import estimate_normals, face_inwards
from ..clouds.splats import nearest_points, smoothed, thinned_splats
from ..geometry.face_graph import FaceGraph, face_graph
from ..geometry.flat import flat_mesh
from ..geometry.mesh import TriangleMesh
from ..geometry.orientation import oriented
from ..geometry.point_cloud import PointCloud
from ..geometry.shells import find_shells, set_apart
from ..steps.progress import Progress, Steps, within

Shape = TriangleMesh | PointCloud


@dataclass(frozen=True, eq=False)
class Form:
    """What a mesh, a flat mesh and a point cloud have in common.

    Lengths are in the unit of their diagonal.

    Attributes
    ----------
    targets : TriangleMesh
        What rays are cast at and samples lie on. Its polygons are nodes of `surface`,
        those beyond it carry no samples.
    surface : callable
        Returns the graph that labels move along.
    nodes : (F,) int
        Node of each polygon of the mesh, or point of the cloud.
    grain : float
        Size of the splats among `targets`, 0 for a mesh.
    tilt : float
        Sine of the angle by which normals of `targets` may be off.
    notes : tuple of str
        Sentences to the user about what was changed for the computation.
    normals : (F, 3) float or None
        Outward normals of the points of a cloud whose own were missing or wrong.
    plane : (3,) float or None
        Normal of the plane of a flat mesh, a unit vector.
    """

    targets: TriangleMesh
    surface: Callable[[], FaceGraph]
    nodes: NDArray[np.int64]
    grain: float = 0.0
    tilt: float = 0.0
    notes: tuple[str, ...] = ()
    normals: NDArray[np.float64] | None = None
    plane: NDArray[np.float64] | None = None

    def labels_of_nodes(self, labels: NDArray[np.int64]) -> NDArray[np.int64]:
        """Return the label of each node from those of polygons or points, (F,)."""
        found = np.zeros(int(self.nodes.max()) + 1, dtype=np.int64)
        found[self.nodes] = labels
        return found

    def part(self, members: NDArray[np.bool_]) -> Form:
        """Return the form of some polygons, or points, seen through the whole shape.

        Parameters
        ----------
        members : (F,) bool

        Returns
        -------
        Form
            Rays are cast at all `targets`; samples, surface and nodes are those of the
            members alone.
        """
        whole = self.surface()
        kept = np.unique(self.nodes[members])
        places = np.full(whole.n_polygons, len(kept))
        places[kept] = np.arange(len(kept))
        return replace(
            self,
            targets=replace(self.targets, polygons=places[self.targets.polygons]),
            surface=lambda: whole.part(kept),
            nodes=places[self.nodes[members]],
            normals=None if self.normals is None else self.normals[members],
        )


def form_of(shape: Shape) -> Steps[Form]:
    """Return the form of a shape: centered, of diagonal 1, facing outwards."""
    yield Progress("Surface", 0.0)
    if isinstance(shape, PointCloud):
        return (yield from _form_of_cloud(shape.normalized()))
    mesh = shape.normalized()
    nodes = np.arange(mesh.n_polygons)
    yield Progress("Surface", 0.3)
    if flat := flat_mesh(mesh):
        return Form(
            flat.walls, flat.surface, nodes, notes=flat.notes, plane=flat.normal
        )
    yield Progress("Surface", 0.4)
    shells = find_shells(mesh)
    yield Progress("Surface", 0.6)
    mesh, notes = oriented(mesh, shells)
    yield Progress("Surface", 0.8)
    targets = set_apart(mesh, shells)
    return Form(targets, lambda: face_graph(mesh), nodes, notes=notes)


def _form_of_cloud(cloud: PointCloud) -> Steps[Form]:
    """Return the form of a cloud: its splats, of not more points than needed."""
    points, normals, tilt = cloud.points, cloud.normals, 0.0
    notes: tuple[str, ...] = ()
    if normals is None:
        normals, tilt = yield from within(estimate_normals(points), 0.0, 0.6)
        notes = ("The points have no normals; they were estimated.",)
    elif face_inwards(points, normals):
        normals = -normals
        notes = (
            "The normals of the points face inwards; they were turned for this"
            " computation only.",
        )
    found = normals if notes else None
    yield Progress("Splats", 0.6)
    points = smoothed(points, normals)
    kept, areas, targets = thinned_splats(points, normals)
    yield Progress("Splats", 0.8)
    nodes, everything = np.arange(len(points)), (points, normals)
    if len(kept) < len(points):
        points, normals = points[kept], normals[kept]
        nodes = nearest_points(points, normals, everything, 1)[:, 0]
    return Form(
        targets,
        lambda: neighbor_graph(points, normals, areas),
        nodes,
        float(np.sqrt(areas.mean())),
        tilt,
        notes,
        found,
    )
