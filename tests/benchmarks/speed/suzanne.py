"""Seconds, steps and memory of a decomposition of Suzanne, by stage.

    make bench-speed

Medians of several runs with default settings, after imports; 2 subdivisions are the
15,744 triangles that docs/quality.md speaks of, 4 make 251,904. A window
waits for one step at a time: those of all runs are told by stage. The ratio compares
the processor time of a run with that of 100,000 rays of BVHTree between points inside
the same mesh. Re-cuts follow, each right after a run with default settings, all in
seconds of the processor.
"""

import argparse
import os
import resource
import statistics
import sys
import time
from dataclasses import replace

import bpy
import checkout  # noqa: F401  # makes the package importable
import numpy as np
import weak_convex_decomposition as package
from hand_made import subdivided_suzanne
from mathutils.bvhtree import BVHTree
from weak_convex_decomposition.core.geometry.sampling import sample_surface
from weak_convex_decomposition.core.parameters.parts import Parameters
from weak_convex_decomposition.core.steps.progress import run
from weak_convex_decomposition.operators.bridge.parts.write import write_parts
from weak_convex_decomposition.operators.bridge.read.shape import read_shape
from weak_convex_decomposition.operators.bridge.work.computing import decompose_object
from weak_convex_decomposition.operators.bridge.work.locking import decompose_unlocked
from weak_convex_decomposition.operators.bridge.work.session_cache import forget

PARAMETERS = Parameters()
RECUTS = (
    {"parts": 2},
    {"parts": 9},
    {"parts": 13},
    {"parts": 14},
    {"parts": 20},
    {"alpha": 1.0},
    {"alpha": 3.0},
    {"smoothness": 10.0},
    {"smallest_part": 0.002},
    {"smallest_part": 0.01},
)
N_RAYS = 100_000
Steps = dict[str, list[float]]


def steps_of_a_run(obj: bpy.types.Object) -> Steps:
    """Return the seconds of each step of each stage, reading and writing included."""
    forget()
    steps: Steps = {}
    stage, before = "Reading", time.perf_counter()

    def note(following: str) -> None:
        nonlocal stage, before
        now = time.perf_counter()
        steps.setdefault(stage, []).append(now - before)
        stage, before = following, now

    work = decompose_unlocked(obj, PARAMETERS)
    note("Start")
    try:
        while True:
            note(next(work).stage)
    except StopIteration as stop:
        note("Writing")
        stop.value.write(obj)
    note("")
    return steps


def print_steps(runs: list[Steps]) -> None:
    """Print the seconds of each stage, and its longest step of any run."""
    print(f"{'':20}{'seconds':>9}{'longest step':>14}")
    for stage in runs[0]:
        seconds = statistics.median(sum(run[stage]) for run in runs)
        longest = max(max(run[stage]) for run in runs)
        print(f"{stage:20}{seconds:9.2f}{longest:14.3f}")
    total = statistics.median(sum(map(sum, run.values())) for run in runs)
    every = [step for run in runs for steps in run.values() for step in steps]
    print(f"{'all':20}{total:9.2f}{max(every):14.3f}")
    print(f"99 of 100 steps take less than {np.percentile(every, 99):.3f} s")


def ray_seconds(obj: bpy.types.Object) -> float:
    """Return what rays of Blender between points of a mesh take, one by one."""
    mesh = read_shape(obj)
    tree = BVHTree.FromPolygons(mesh.vertices.tolist(), mesh.triangles.tolist())
    samples = sample_surface(mesh, 2 * N_RAYS, np.random.default_rng(0))
    inside = samples.positions - 1e-3 * mesh.diagonal * samples.normals
    chosen = np.random.default_rng(1).permutation(len(inside)).reshape(2, -1)
    starts, ends = inside[chosen]
    lengths = np.linalg.norm(ends - starts, axis=1)
    units = (ends - starts) / lengths[:, None]
    rays = list(zip(*(a.tolist() for a in (starts, units, lengths)), strict=True))
    before = time.process_time()
    for start, unit, length in rays:
        tree.ray_cast(start, unit, length)
    return time.process_time() - before


def run_seconds(obj: bpy.types.Object) -> float:
    """Return the seconds of the processor that a run takes."""
    forget()
    before = time.process_time()
    write_parts(obj, run(decompose_object(obj, PARAMETERS)), PARAMETERS)
    return time.process_time() - before


def print_ratio(obj: bpy.types.Object, n_runs: int) -> None:
    """Print how a run compares with rays on the same mesh."""
    pairs = [(run_seconds(obj), ray_seconds(obj)) for _ in range(n_runs)]
    ratio = statistics.median(whole / rays for whole, rays in pairs)
    of_run, of_rays = map(statistics.median, zip(*pairs, strict=True))
    print(
        f"\nprocessor: a run {of_run:.2f} s, {N_RAYS:,} rays {of_rays:.2f} s,"
        f" ratio {ratio:.1f}"
    )


def recut_seconds(
    obj: bpy.types.Object, change: dict[str, float], rough: bool
) -> float:
    """Return what other settings take after a run with default ones, writing too."""
    forget()
    run(decompose_object(obj, PARAMETERS))
    parameters, before = replace(PARAMETERS, **change), time.process_time()
    found = run(decompose_object(obj, parameters, rough=rough))
    write_parts(obj, found, parameters)
    return time.process_time() - before


def print_recuts(obj: bpy.types.Object, n_runs: int) -> None:
    """Print the seconds of each change of the settings."""
    print(f"\n{'re-cut':20}{'first look':>12}{'parts':>9}")
    for change in RECUTS:
        look, parts = (
            statistics.median(recut_seconds(obj, change, rough) for _ in range(n_runs))
            for rough in (True, False)
        )
        ((name, value),) = change.items()
        print(f"{name + ' ' + str(value):20}{look:12.2f}{parts:9.2f}", flush=True)


def main() -> int:
    """Time the runs and print the table."""
    package.register()  # objects have a table of parts then
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--runs", type=int, default=5)
    parser.add_argument("--subdivisions", type=int, default=2)
    arguments = parser.parse_args()
    bpy.ops.wm.read_factory_settings(use_empty=True)
    obj = subdivided_suzanne(arguments.subdivisions)
    run(decompose_object(obj, Parameters(samples=100)))  # loads libraries
    runs = [steps_of_a_run(obj) for _ in range(arguments.runs)]
    print(f"$ python {' '.join(sys.argv)}")
    print(
        f"bpy {bpy.app.version_string}, Python {sys.version.split()[0]},"
        f" NumPy {np.__version__}, {os.cpu_count()} cores"
    )
    n_triangles = len(read_shape(obj).triangles)
    print(f"{n_triangles:,} triangles, medians of {len(runs)} runs\n")
    print_steps(runs)
    print_ratio(obj, arguments.runs)
    print_recuts(obj, arguments.runs)
    peak = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024
    print(f"\npeak memory of the process, Blender and all: {peak:.0f} MB")
    return 0


if __name__ == "__main__":
    sys.exit(main())
