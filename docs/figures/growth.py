"""Seconds and memory of a decomposition against the number of triangles.

    PYTHONPATH=tests/support python docs/figures/growth.py
    python docs/figures/growth_plot.py

A lumpy ring of quads, from 4,000 to 4,000,000 triangles, each in a process of its own.
Seconds are of the processor, after imports, without Blender's reading and writing. The
longest step is what a window waits for at once. More triangles: `--triangles 10000000`.
`--rivals .venv-hulls/bin/python` adds CoACD and V-HACD, as `make bench-hulls` installs
them, up to the first size that takes too long. The second command draws the table that
tests/benchmarks/results/growth.txt keeps.
"""

import argparse
import resource
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import bpy  # noqa: F401  # the ray caster needs Blender
import checkout  # noqa: F401  # makes the package importable
import numpy as np
from large_shapes import lumpy_ring
from weak_convex_decomposition.core.cache import ShapeCache
from weak_convex_decomposition.core.decomposition import decompose_in_steps
from weak_convex_decomposition.core.parameters.parts import Parameters
from weak_convex_decomposition.core.steps.progress import run
from weak_convex_decomposition.operators.bridge.rays.bvh import BvhRayCaster

SIZES = (4_000, 16_000, 64_000, 250_000, 1_000_000, 4_000_000)
# Stages that have a column; all others are counted together as the parts.
STAGES = ("Surface", "Ray tree", "Lines of sight")
# Other tools, as hull_tools.py names them, and the seconds that they may take.
RIVALS = {"CoACD": "coacd-0.05", "V-HACD": "vhacd"}
PATIENCE = 600
HULL_TOOLS = Path(__file__).parents[2] / "tests/benchmarks/hulls/hull_tools.py"


def measure(n_triangles: int) -> None:
    """Print a row of the table: one decomposition, by stage."""
    run(decompose_in_steps(lumpy_ring(400), Parameters(samples=100), new_cache()))
    mesh, seconds = lumpy_ring(n_triangles), dict.fromkeys((*STAGES, "Parts"), 0.0)
    stage, before, longest = "Surface", time.process_time(), 0.0
    for progress in decompose_in_steps(mesh, Parameters(), new_cache()):
        now = time.process_time()
        seconds[stage] += now - before
        longest = max(longest, now - before)
        stage = progress.stage if progress.stage in STAGES else "Parts"
        before = now
    seconds[stage] += time.process_time() - before
    peak = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024
    columns = "".join(f"{seconds[name]:15.2f}" for name in seconds)
    total = sum(seconds.values())
    row = f"{len(mesh.triangles):11,}{total:9.2f}{columns}{longest:9.2f}{peak:9.0f}"
    sys.stdout.write(f"{row}\n")


def print_rivals(python: str, sizes: list[int]) -> None:
    """Print the seconds of other tools on the same shapes."""
    for name, tool in RIVALS.items():
        for size in sizes:
            mesh = lumpy_ring(size)
            with tempfile.TemporaryDirectory() as folder:
                given, made = Path(folder, "mesh.npz"), Path(folder, "hulls.npz")
                np.savez(given, vertices=mesh.vertices, triangles=mesh.triangles)
                command = [python, str(HULL_TOOLS), tool, str(given), str(made)]
                try:
                    subprocess.run(
                        command, check=True, capture_output=True, timeout=PATIENCE
                    )
                except (subprocess.TimeoutExpired, subprocess.CalledProcessError):
                    break
                with np.load(made) as arrays:
                    seconds = float(arrays["seconds"])
            sys.stdout.write(f"{name:10}{len(mesh.triangles):11,}{seconds:9.2f}\n")
            sys.stdout.flush()


def new_cache() -> ShapeCache:
    """Return an empty cache."""
    return ShapeCache(BvhRayCaster)


def main() -> int:
    """Measure each size in a process of its own, and print the table."""
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--triangles", type=int, nargs="*", default=SIZES)
    parser.add_argument("--one", type=int, help="measure one size in this process")
    parser.add_argument("--rivals", help="a Python that has CoACD and V-HACD")
    arguments = parser.parse_args()
    if arguments.one:
        measure(arguments.one)
        return 0
    names = "".join(f"{name:>15}" for name in (*STAGES, "Parts"))
    sys.stdout.write(f"{'triangles':>11}{'seconds':>9}{names}{'longest':>9}{'MB':>9}\n")
    sys.stdout.flush()
    for size in arguments.triangles:
        subprocess.run([sys.executable, __file__, "--one", str(size)], check=True)
    if arguments.rivals:
        print_rivals(arguments.rivals, arguments.triangles)
    return 0


if __name__ == "__main__":
    sys.exit(main())
