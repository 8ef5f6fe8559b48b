"""Sample the surface and the inside of a mesh, to cut it and put hulls around it."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from scipy.spatial import cKDTree

from ..geometry.frames import settled
from ..geometry.mesh import TriangleMesh
from ..geometry.primitives import CollisionShape, Hull
from ..geometry.sampling import sample_surface
from ..geometry.welding import distinct_points
from ..solids.mass import mass_of_surface
from ..solids.shells import Shells, find_shells
from ..steps.arrays import FloatArray, IntArray
from ..steps.progress import Progress, Steps, within
from ..steps.rows import used_rows
from .chords import chords_along
from .measure.buried import unburied
from .measure.inside import InsideTest, inside_test
from .measure.line_crossings import line_crossings

# Number of samples on the surface.
_SAMPLES = 6000
# Number of chords that tell about how much of a shape is inside.
_SOME_CHORDS = 20_000
# A volume below this is noise, such as that of a two-sided sheet, and counts as 0; the
# longest side is 2.
_NO_VOLUME = 1e-6
# Shells with this overlap, or more, count as apart from each other.
_NO_OVERLAP = 1 - 1e-6


@dataclass(frozen=True, eq=False)
class Solid:
    """A mesh with samples of its surface and chords through its inside.

    Attributes
    ----------
    mesh : TriangleMesh
        Oriented: normals point outwards.
    surface : TriangleMesh
        What of it is not buried in other shells.
    vertices : (V, 3) float
        Distinct corners of its triangles.
    samples : (N, 3) float
        Points spread evenly over the surface.
    triangles : (N,) int
        Triangle that each sample lies on.
    chords : (C, 3) float
        A point of each of short chords along each axis.
    volumes : (C,) float
        Volume around each chord.
    spacing : float
        Distance between neighboring samples.
    shells : Shells
        Those of the mesh.
    overlap : float
        Its volume along the chords, as a share of the sum of those of its shells.
    inside : InsideTest
        Tells what is inside.
    """

    mesh: TriangleMesh
    surface: TriangleMesh
    vertices: FloatArray
    samples: FloatArray
    triangles: IntArray
    chords: FloatArray
    volumes: FloatArray
    spacing: float
    shells: Shells
    overlap: float
    inside: InsideTest

    @property
    def volume(self) -> float:
        """Volume of the solid along the chords, which pieces of it add up to."""
        return float(self.volumes.sum())

    @property
    def true_volume(self) -> float:
        """Volume of the solid: exact if it is closed and no shells overlap.

        However thin it is: lines may miss a wire. What overlaps is measured along them.
        """
        mass = None
        if self.closed:
            mass = mass_of_surface(self.mesh.vertices, self.mesh.triangles, 1.0)
        return mass.mass * self.overlap if mass else self.volume

    @cached_property
    def closed(self) -> bool:
        """Whether all shells are closed, so that any line tells what is inside."""
        return bool(self.shells.closed.all())

    @cached_property
    def corners(self) -> FloatArray:
        """Corners of the triangles, (T, 3, 3)."""
        return self.mesh.vertices[self.mesh.triangles]

    @cached_property
    def triangle_bounds(self) -> tuple[FloatArray, FloatArray]:
        """Lowest and highest coordinates of each triangle of the surface, (N, 3)."""
        corners = self.surface.vertices[self.surface.triangles]
        return corners.min(axis=1), corners.max(axis=1)

    @cached_property
    def _some_chords(self) -> tuple[FloatArray, FloatArray]:
        """Points of chords chosen by chance, and volumes around them."""
        if len(self.chords) <= _SOME_CHORDS:
            return self.chords, self.volumes
        rng = np.random.default_rng(0)
        rows = rng.choice(len(self.chords), _SOME_CHORDS, replace=False)
        volumes = self.volumes[rows]
        return self.chords[rows], volumes * (self.volume / volumes.sum())

    @cached_property
    def samples_of_chords(self) -> IntArray:
        """Row of the sample that is nearest to each chord, (C,)."""
        return cKDTree(self.samples).query(self.chords)[1]

    def volume_in(self, shape: CollisionShape) -> float:
        """Return about how much of a collision shape is inside.

        Parameters
        ----------
        shape : CollisionShape
        """
        low, high = shape.bounds
        chords, volumes = self._some_chords
        near = ((low <= chords) & (chords <= high)).all(axis=1)
        within = shape.heights(chords[near]) <= 0
        return float(volumes[near][within].sum())

    def main_part(self, parts: IntArray, hull: Hull) -> int:
        """Return the part of most of the surface samples in a hull.

        Parameters
        ----------
        parts : (T,) int
            Row of the part of each triangle.
        hull : Hull

        Returns
        -------
        int
        """
        if not parts.any():  # there is only part 0
            return 0
        low, high = hull.bounds
        near = ((low <= self.samples) & (self.samples <= high)).all(axis=1)
        near[near] = hull.heights(self.samples[near]) <= 0
        return int(np.bincount(parts[self.triangles[near]], minlength=1).argmax())


def solid_of(mesh: TriangleMesh, seed: int, scale: float = 1.0) -> Steps[Solid]:
    """Sample the surface and the inside of a mesh.

    The volume is measured along lines parallel to each axis. Unlike the cells of a
    grid, such lines miss no thin wall across them. In an open mesh, a line counts as
    inside between a front face that it enters and a back face that it leaves.

    Parameters
    ----------
    mesh : TriangleMesh
        Oriented: normals point outwards.
    seed : int
        Seed of the random surface samples.
    scale : float
        Makes its longest side 2.

    Returns
    -------
    Steps of Solid
    """
    mesh = replace(mesh, vertices=mesh.vertices * scale)
    corners = mesh.vertices[mesh.triangles]
    used = yield from within(used_rows(mesh.triangles, len(mesh.vertices)), 0.0, 0.0)
    yield Progress("Solid", 0.0)
    vertices = distinct_points(mesh.vertices[used])[0]
    yield Progress("Solid", 0.0)
    measured = _chords_in(corners, vertices)
    chords, volumes, overlap = yield from within(measured, 0.0, 1.0)
    shells = yield from within(find_shells(mesh), 1.0, 1.0)
    surface, rows, closed = mesh, np.arange(len(corners)), shells.closed.all()
    if closed and overlap < _NO_OVERLAP:
        surface, rows = yield from within(unburied(mesh, shells), 1.0, 1.0)
    inside = yield from within(inside_test(corners, 1 if closed else 3), 1.0, 1.0)
    yield Progress("Solid", 1.0)
    samples = sample_surface(surface, _SAMPLES, np.random.default_rng(seed))
    return Solid(
        mesh,
        surface,
        vertices,
        samples.positions,
        rows[samples.triangles],
        chords,
        volumes,
        float(settled(np.sqrt(surface.areas.sum() / _SAMPLES))),
        shells,
        overlap,
        inside,
    )


def _chords_in(
    corners: FloatArray, vertices: FloatArray
) -> Steps[tuple[FloatArray, FloatArray, float]]:
    """Return chords, volumes and the overlap, as in `Solid`."""
    crossings, along = (yield from line_crossings(corners)), []
    for axis in range(3):
        yield Progress("Solid", axis / 3)
        along.append(chords_along(crossings, vertices, axis))
    found = (np.concatenate(each) for each in zip(*along, strict=True))
    chords, volumes, depths = found
    volumes = volumes / 3
    sum_of_shells = float((volumes * depths).sum())  # the same on any number of cores
    overlap = float(volumes.sum()) / sum_of_shells if sum_of_shells else 1.0
    if volumes.sum() < _NO_VOLUME:
        chords, volumes = chords[:0], volumes[:0]
    return chords, volumes, overlap
