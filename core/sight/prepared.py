"""Prepared shapes: everything that casts rays through a shape takes one."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np

from ..clouds.neighbor_graph import neighbor_graph
from ..clouds.splat_surface import splat_surface
from ..geometry.flat import FlatMesh, flat_mesh
from ..geometry.graphs.face_graph import FaceGraph, face_graph
from ..geometry.mesh import TriangleMesh
from ..geometry.point_cloud import PointCloud
from ..geometry.shape import Shape
from ..solids.bare import bare_mesh
from ..solids.convexity import is_convex
from ..solids.orientation import oriented
from ..solids.shells import find_shells, set_apart
from ..steps.arrays import BoolArray, FloatArray, IntArray
from ..steps.memo import computed_once
from ..steps.progress import Progress, Steps, run, within
from .ray_caster import MakeCaster
from .ray_march import RayMarcher


@dataclass(frozen=True, eq=False)
class PreparedShape:
    """A shape that is normalized, oriented and ready for rays.

    Its bounding box has center 0 and diagonal 1, and its faces point outwards.

    Attributes
    ----------
    center : (3,) float
        Center of the bounding box of the shape, in its units.
    diagonal : float
        Diagonal of that box, in the units of the shape.
    targets : TriangleMesh
        The surface that carries the samples and that rays are cast at. Its polygons
        are the nodes of `graph`; polygons from number `n_nodes` on carry no samples.
    marcher : RayMarcher
        Sends rays through the inside of all targets.
    n_nodes : int
        Number of nodes of `graph`.
    nodes : (P,) int
        Node of each polygon of the mesh, or of each point of the cloud.
    make_graph : callable
        Returns the steps that make `graph`.
    solid : TriangleMesh
        The normalized mesh without walls within solids; the splats of a point cloud.
    notes : tuple of str
        Sentences to the user on what was changed for the computation.
    normals : (P, 3) float or None
        Outward normals of the points of a cloud that had none, or wrong ones.
    plane : (3,) float or None
        Unit normal of the plane of a flat mesh, None for other shapes.
    convex : bool
        Whether it is the whole surface of a convex solid.
    shells : (T,) int or None
        Shell of each triangle of `targets`; None of flat meshes and clouds.
    """

    center: FloatArray
    diagonal: float
    targets: TriangleMesh
    marcher: RayMarcher
    n_nodes: int
    nodes: IntArray
    make_graph: Callable[[], Steps[FaceGraph]]
    solid: TriangleMesh
    notes: tuple[str, ...] = ()
    normals: FloatArray | None = None
    plane: FloatArray | None = None
    convex: bool = False
    shells: IntArray | None = None

    @property
    def graph(self) -> FaceGraph:
        """Graph of neighboring polygons, or of neighboring points of a cloud."""
        return run(self.graph_in_steps())

    @computed_once
    def graph_in_steps(self) -> Steps[FaceGraph]:
        """Return `graph`, made in steps if it is not known yet."""
        return (yield from self.make_graph())

    @property
    def is_cloud(self) -> bool:
        """Whether it is a point cloud."""
        return self.marcher.splat_size > 0

    @property
    def sampled(self) -> IntArray:
        """Rows of the triangles of `targets` that carry samples, (R,) int."""
        return np.flatnonzero(self.targets.polygons < self.n_nodes)

    def labels_of_nodes(self, labels: IntArray) -> IntArray:
        """Return the label of each node, (`n_nodes`,).

        Parameters
        ----------
        labels : (P,) int
            Label of each polygon, or of each point of the cloud.
        """
        found = np.zeros(self.n_nodes, dtype=np.int64)
        found[self.nodes] = labels
        return found

    def part(self, members: BoolArray) -> PreparedShape:
        """Return some polygons, or points, as a shape of their own.

        Rays still run through the whole shape and use the same ray tree. Samples,
        graph and nodes cover only the chosen polygons or points.

        Parameters
        ----------
        members : (P,) bool
            Polygons of the mesh, or points of the cloud, that belong to the part.

        Returns
        -------
        PreparedShape
        """
        kept = np.unique(self.nodes[members])
        places = np.full(self.n_nodes + 1, len(kept))
        places[kept] = np.arange(len(kept))
        polygons = places[np.minimum(self.targets.polygons, self.n_nodes)]
        return replace(
            self,
            targets=self.targets.with_polygons(polygons),
            n_nodes=len(kept),
            nodes=places[self.nodes[members]],
            make_graph=lambda: self._part_of_graph(kept),
            normals=None if self.normals is None else self.normals[members],
            convex=False,
        )

    def _part_of_graph(self, kept: IntArray) -> Steps[FaceGraph]:
        """Return the graph of some nodes."""
        return (yield from self.graph_in_steps()).part(kept)


def prepare_in_steps(shape: Shape, make_caster: MakeCaster) -> Steps[PreparedShape]:
    """Normalize and orient a shape and make it ready for rays.

    Parameters
    ----------
    shape : TriangleMesh or PointCloud
        In any units. It may be open, non-manifold or in several pieces.
    make_caster : callable
        Makes a `RayCaster` of a `TriangleMesh`, when the first ray is cast.

    Returns
    -------
    Steps of PreparedShape

    Raises
    ------
    DecompositionError
        If the surface has no area, or is too large or too small to compute with.
    """
    yield Progress("Surface", 0.0)
    if isinstance(shape, PointCloud):
        return (yield from _prepare_cloud(shape, make_caster))
    mesh = yield from within(shape.normalized_in_steps(), 0.0, 0.2)
    yield Progress("Surface", 0.2)
    if flat := flat_mesh(mesh):
        return _prepare_flat(shape, mesh, flat, make_caster)
    return (yield from within(_prepare_mesh(shape, mesh, make_caster), 0.2, 1.0))


def _prepare_mesh(
    shape: TriangleMesh, mesh: TriangleMesh, make_caster: MakeCaster
) -> Steps[PreparedShape]:
    """Prepare a mesh, given normalized, too: shells, orientation, what rays see.

    Polygons keep their numbers. Triangles have those of `mesh`, or of the bare mesh, as
    in shells; `bare.rows` leads from one to the other. Equal meshes are one object.

    ========= =============== ================================ ======== ================
    mesh      made by         triangles                        vertices read for
    ========= =============== ================================ ======== ================
    bare.mesh `bare_mesh`     neither doubled ones nor walls   as given shells
    turned    `oriented`      of the bare mesh, outwards       as given convexity
    targets   `set_apart`     of the bare mesh, outwards       moved    rays and samples
    whole     `wound_as`      all, outwards but for walls      as given the graph
    solid     `without_walls` of the whole mesh, but for walls as given hulls
    ========= =============== ================================ ======== ================

    Side 3t + i of a mesh starts at corner i of its triangle t. `Edges` sorts the sides.
    """
    bare = yield from within(bare_mesh(mesh), 0.0, 0.3)
    shells = yield from within(find_shells(bare.mesh), 0.3, 0.4)
    turned, notes = yield from within(oriented(bare.mesh, shells), 0.4, 0.6)
    targets = yield from within(set_apart(turned, shells), 0.6, 0.7)
    yield from within(targets.normals_in_steps(), 0.7, 0.8)
    whole = bare.wound_as(turned)
    convex = yield from within(is_convex(turned, shells), 0.8, 1.0)
    return PreparedShape(
        center=shape.center,
        diagonal=shape.diagonal,
        targets=targets,
        marcher=RayMarcher(targets, make_caster, shells.closed[shells.of_triangle]),
        n_nodes=mesh.n_polygons,
        nodes=np.arange(mesh.n_polygons),
        make_graph=lambda: face_graph(whole),
        solid=bare.without_walls(whole),
        notes=notes + bare.notes,
        convex=convex,
        shells=shells.of_triangle,
    )


def _prepare_flat(
    shape: TriangleMesh, mesh: TriangleMesh, flat: FlatMesh, make_caster: MakeCaster
) -> PreparedShape:
    """Prepare a flat mesh: walls along its outline carry the samples."""
    return PreparedShape(
        center=shape.center,
        diagonal=shape.diagonal,
        targets=flat.walls,
        marcher=RayMarcher(flat.walls, make_caster),
        n_nodes=mesh.n_polygons,
        nodes=np.arange(mesh.n_polygons),
        make_graph=flat.graph,
        solid=mesh,
        notes=flat.notes,
        plane=flat.normal,
    )


def _prepare_cloud(cloud: PointCloud, make_caster: MakeCaster) -> Steps[PreparedShape]:
    """Prepare a point cloud: its splats replace the surface (section 5)."""
    found = yield from splat_surface(cloud.normalized())
    return PreparedShape(
        center=cloud.center,
        diagonal=cloud.diagonal,
        targets=found.mesh,
        marcher=RayMarcher(
            found.mesh, make_caster, splat_size=found.size, tilt=found.tilt
        ),
        n_nodes=len(found.points),
        nodes=found.nodes,
        make_graph=lambda: neighbor_graph(found.points, found.normals, found.areas),
        solid=found.mesh,
        notes=found.notes,
        normals=found.found_normals,
    )
