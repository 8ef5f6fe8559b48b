"""Stated errors of hulls against measured ones: hull_errors.py FOLDER [SHAPE...].

The measurement shares no code with the hulls: dense samples, Blender's exact distances
from triangles, and rays that count surfaces. FOLDER is searched for meshes; of the
Princeton benchmark, model 3 of each category is taken.
"""

import sys
import time
from pathlib import Path

import bpy  # noqa: F401  # mathutils comes with it
import checkout  # noqa: F401  # makes the package importable
import numpy as np
import weak_convex_decomposition as package
from definitions import heights_above_shape
from headless.loading import load
from mathutils import Vector
from mathutils.bvhtree import BVHTree
from mathutils.geometry import intersect_ray_tri, normal
from scipy.spatial import cKDTree
from weak_convex_decomposition.core.hulls.measure.inside import AXES
from weak_convex_decomposition.core.hulls.outline import outline_of
from weak_convex_decomposition.operators.bridge.read.shape import read_shape

SHAPES = ("HULL", "BOX", "SPHERE", "CYLINDER", "CAPSULE")
ENDINGS = {".obj", ".off", ".ply", ".stl"}
ON_SHAPE, ON_MESH, IN_BOX, INSIDE_TESTS = 20_000, 200_000, 20_000, 10_000
# Errors below this, relative to half of the longest side, are rounding.
LEAST = 0.002
# The lines that say what is inside: in an open mesh, others say otherwise.
LINES = [Vector(axis) for axis in AXES]
STEP = 1e-5
# From a point to one beside it.
BESIDE = np.array([7e-4, -5e-4, 3e-4])


def mesh_files(folder):
    """Return the meshes below a folder, small ones first.

    Of the Princeton benchmark, model 3 of each category is taken.
    """
    files = [p for p in Path(folder).rglob("*") if p.suffix in ENDINGS]
    files.sort(key=lambda p: (p.stat().st_size, p))
    return [p for p in files if not p.stem.isdigit() or int(p.stem) % 20 == 3]


def spread(corners, count, seed):
    """Return points spread over triangles (T, 3, 3), and the triangle of each."""
    rng = np.random.default_rng(seed)
    a, b, c = np.moveaxis(corners, 1, 0)
    areas = np.linalg.norm(np.cross(b - a, c - a), axis=1)
    rows = rng.choice(len(corners), count, p=areas / areas.sum())
    u, v = np.sort(rng.random((2, count)), axis=0)
    weights = np.stack([u, v - u, 1 - v], axis=1)
    return np.einsum("nc,ncd->nd", weights, corners[rows]), rows


class Ruler:
    """Measures shapes against a mesh, scaled so that its longest side is 2."""

    def __init__(self, mesh):
        self.center = mesh.center
        self.unit = np.ptp(mesh.bounds, axis=0).max() / 2
        self.corners = (mesh.vertices[mesh.triangles] - self.center) / self.unit
        self.tree = tree_of(self.corners)
        self.vectors = [[Vector(corner) for corner in each] for each in self.corners]
        self.facing = [normal(each) for each in self.vectors]
        self.points, self.rows = spread(self.corners, ON_MESH, 1)

    def is_inside(self, point):
        """Return whether most rays, both ways, leave more surfaces than they enter."""
        ways = [way for line in LINES for way in (line, -line)]
        return 2 * sum(self.surfaces_left(point, way) > 0 for way in ways) > len(ways)

    def is_outside(self, point):
        """Return whether a point and one beside it are outside.

        A ray through an edge may slip between its two faces.
        """
        return not (self.is_inside(point) or self.is_inside(point + BESIDE))

    def surfaces_left(self, point, way):
        """Return how many more surfaces a ray leaves than it enters."""
        place, count = Vector(point), 0
        while True:
            hit, facing, _, _ = self.tree.ray_cast(place, way)
            if hit is None:
                return count
            at_once = self.tree.find_nearest_range(hit, STEP)
            if len(at_once) > 1:  # faces that lie on each other, or share an edge
                met = {row for _, _, row, _ in at_once if self.is_met(row, place, way)}
                normals = [self.facing[row] for row in met]
            else:
                normals = [facing]
            count += sum(1 if each.dot(way) > 0 else -1 for each in normals)
            place = hit + STEP * way

    def is_met(self, row, place, way):
        """Return whether a ray crosses a triangle."""
        return intersect_ray_tri(*self.vectors[row], way, place) is not None

    def error(self, shape):
        """Return the error of a shape: both distances, and the volume term."""
        shape = shape.moved(1 / self.unit, -self.center / self.unit)
        heights = heights_above_shape(shape, self.points)
        within = heights <= 0.01
        own = self.corners[np.unique(self.rows[within])]
        outline = outline_of(shape)
        places, _ = spread(outline.corners, ON_SHAPE, 2)
        near = tree_of(own) if within.any() else self.tree
        away = np.array([near.find_nearest(place)[3] for place in places])
        if within.any():  # not what such triangles have outside of the shape
            rough = cKDTree(self.points[within]).query(places)[0]
            away = np.maximum(away, rough - 0.02)
        far = 0.0
        for row in np.argsort(-away):
            if away[row] < LEAST or self.is_outside(places[row]):
                far = away[row]
                break
        error = max(far, self.depth(heights), LEAST)
        if volume_term(shape.volume) <= error:  # that of what is outside is less
            return error
        return max(error, volume_term(self.volume_outside(shape, outline)))

    def depth(self, heights):
        """Return how deep the surface lies within a shape, but for what is buried."""
        for row in np.argsort(heights):
            if -heights[row] < LEAST or not self.is_buried(row):
                return -heights[row]
        return 0.0

    def is_buried(self, row):
        """Return whether both sides of the surface are inside at one of the points."""
        beside = 1e-3 * self.facing[self.rows[row]]
        point = Vector(self.points[row])
        return self.is_inside(point + beside) and self.is_inside(point - beside)

    def volume_outside(self, shape, outline):
        """Return the volume of the shape outside the mesh."""
        low, high = outline.vertices.min(axis=0), outline.vertices.max(axis=0)
        points = low + (high - low) * np.random.default_rng(3).random((IN_BOX, 3))
        points = points[heights_above_shape(shape, points) <= 0]
        some = points[:INSIDE_TESTS]
        return shape.volume * np.mean([not self.is_inside(point) for point in some])

    def uncovered(self, shapes):
        """Return the largest distance of the mesh from all shapes, where it is bare."""
        scaled = [s.moved(1 / self.unit, -self.center / self.unit) for s in shapes]
        points = self.points[::10]
        heights = np.array([heights_above_shape(s, points) for s in scaled])
        bare = points[heights.min(axis=0) > LEAST]
        trees = [tree_of(outline_of(shape).corners) for shape in scaled]
        return max(
            (min(t.find_nearest(p)[3] for t in trees) for p in bare), default=0.0
        )


def volume_term(volume):
    """Return R_v of CoACD for a volume."""
    return 0.3 * np.cbrt(3 * volume / 4 / np.pi)


def tree_of(corners):
    rows = np.arange(3 * len(corners)).reshape(-1, 3)
    return BVHTree.FromPolygons(corners.reshape(-1, 3).tolist(), rows.tolist())


def main(folder, *kinds):
    worst = {}
    print(
        f"{'mesh':18}{'shape':10}{'shapes':>7}{'stated':>8}{'measured':>9}{'ratio':>7}{'bare':>7}{'volumes':>9}{'seconds':>9}"
    )
    for path in mesh_files(folder):
        (obj, *_) = load(path, "Y")
        mesh = read_shape(obj)
        ruler = Ruler(mesh)
        for kind in kinds or SHAPES:
            started = time.process_time()
            found = package.build_hulls(mesh, shape=kind)
            seconds = time.process_time() - started
            measured = np.array([ruler.error(shape) for shape in found.shapes])
            ratios = measured / np.maximum(found.errors, LEAST)
            worst[kind] = max(worst.get(kind, 0.0), ratios.max())
            print(
                f"{path.stem[:17]:18}{kind:10}{found.n_hulls:7}{found.errors.max():8.4f}"
                f"{measured.max():9.4f}{ratios.max():7.3f}{ruler.uncovered(found.shapes):7.4f}"
                f"{found.volume_ratio:9.3f}{seconds:9.2f}",
                flush=True,
            )
    for kind, ratio in worst.items():
        print(f"largest ratio of {kind}: {ratio:.3f}")


if __name__ == "__main__":
    main(*sys.argv[1:])
