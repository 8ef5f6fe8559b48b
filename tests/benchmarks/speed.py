"""Seconds and memory of a decomposition of Suzanne, by stage.

    make bench-speed

Medians of several runs with default settings, after imports; 2 subdivisions are the
15,744 triangles that the promises in the README speak of.
"""

import argparse
import os
import resource
import statistics
import sys
import time

import bpy
import checkout  # noqa: F401  # makes the package importable
import numpy as np
from hand_made import subdivided_suzanne
from weak_convex_decomposition.core.decomposition import decompose
from weak_convex_decomposition.core.parameters import Parameters
from weak_convex_decomposition.core.shapes import TriangleMesh
from weak_convex_decomposition.operators.bridge.ray_caster import BvhRayCaster
from weak_convex_decomposition.operators.bridge.read import read_shape


def seconds_by_stage(mesh: TriangleMesh) -> tuple[dict[str, float], float, float]:
    """Return the seconds of each stage, of all, and of the longest step."""
    stages: dict[str, float] = {}
    longest = 0.0
    started = before = time.perf_counter()
    stage = "Start"
    for progress in decompose(mesh, Parameters(), BvhRayCaster):
        now = time.perf_counter()
        stages[stage] = stages.get(stage, 0.0) + now - before
        longest = max(longest, now - before)
        stage, before = progress.stage, now
    now = time.perf_counter()
    stages[stage] = stages.get(stage, 0.0) + now - before
    return stages, now - started, max(longest, now - before)


def main() -> int:
    """Time the runs and print the table."""
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--runs", type=int, default=5)
    parser.add_argument("--subdivisions", type=int, default=2)
    arguments = parser.parse_args()
    bpy.ops.wm.read_factory_settings(use_empty=True)
    mesh = read_shape(subdivided_suzanne(arguments.subdivisions))
    runs = [seconds_by_stage(mesh) for _ in range(arguments.runs)]
    print(f"$ python {' '.join(sys.argv)}")
    print(
        f"bpy {bpy.app.version_string}, Python {sys.version.split()[0]},"
        f" NumPy {np.__version__}, {os.cpu_count()} cores"
    )
    print(f"{len(mesh.triangles):,} triangles, medians of {len(runs)} runs, seconds\n")
    for stage in runs[0][0]:
        print(f"{stage:20}{statistics.median(run[0][stage] for run in runs):7.2f}")
    print(f"{'all':20}{statistics.median(run[1] for run in runs):7.2f}")
    print(f"{'longest step':20}{statistics.median(run[2] for run in runs):7.2f}")
    peak = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024
    print(f"\npeak memory of the process, Blender and all: {peak:.0f} MB")
    return 0


if __name__ == "__main__":
    sys.exit(main())
