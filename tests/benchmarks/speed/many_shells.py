"""Seconds of shapes of many shells, beside the median model of the benchmark.

    make bench-shells PSB=directory

Medians of three runs, in seconds of the processor with default settings. Every
fourth model of the Princeton benchmark counts, in the same process: machines are not
always equally fast.
"""

import statistics
import sys
import time
from pathlib import Path

import bpy  # noqa: F401  # the ray caster needs Blender
import checkout  # noqa: F401  # makes the package importable
import large_shapes
import shapes
from princeton import read_model
from weak_convex_decomposition.core.cache import ShapeCache
from weak_convex_decomposition.core.decomposition import decompose_in_steps
from weak_convex_decomposition.core.parameters.parts import Parameters
from weak_convex_decomposition.core.steps.progress import run
from weak_convex_decomposition.operators.bridge.rays.bvh import BvhRayCaster

SHAPES = {
    "one sphere": lambda: shapes.sphere(4),
    "70 boxes and pipes": large_shapes.building,
    "2000 loose boxes": large_shapes.loose_pieces,
    "20 nested spheres": large_shapes.nested_spheres,
    "10 equal spheres": lambda: large_shapes.copies(shapes.sphere(3), 10),
    "doubled faces": lambda: large_shapes.with_doubled_faces(shapes.sphere(4)),
    "thin slabs": large_shapes.slabs,
}


class Counting(BvhRayCaster):
    """Counts the rays that are cast."""

    n_rays = 0

    def first_hit(self, origins, directions, reach):
        Counting.n_rays += len(origins)
        return super().first_hit(origins, directions, reach)


def timed(mesh):
    """Return the seconds that a mesh takes, its rays and its number of parts."""
    Counting.n_rays, before = 0, time.process_time()
    found = run(decompose_in_steps(mesh, Parameters(), ShapeCache(Counting)))
    return time.process_time() - before, Counting.n_rays, found.n_parts


def main(directory):
    """Print the median model, and a row for each shape."""
    numbers = sorted(int(path.stem) for path in (directory / "off").glob("*.off"))
    models = [read_model(directory, number) for number in numbers[::4]]
    timed(models[0])  # loads libraries
    median = statistics.median(timed(model)[0] for model in models)
    print(f"median of {len(models)} models: {median:.2f} s")
    titles = ("seconds", "medians", "triangles", "rays", "parts")
    print(f"{'':20}{''.join(f'{title:>10}' for title in titles)}")
    for name, make in SHAPES.items():
        mesh = make()
        seconds, n_rays, n_parts = sorted(timed(mesh) for _ in range(3))[1]
        times = f"{seconds:10.2f}{seconds / median:10.1f}"
        print(f"{name:20}{times}{len(mesh.triangles):10,}{n_rays:10,}{n_parts:10}")


if __name__ == "__main__":
    main(Path(sys.argv[1]))
