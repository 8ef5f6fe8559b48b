"""CoACD as a segmenter of the Princeton Segmentation Benchmark, to compare with.

    make bench-coacd PSB=DIRECTORY SEGMENTS=FOLDER

Approximate convex decomposition (Wei et al. 2022) gives hulls; each face goes to the
hull that its center is deepest in, or nearest to. CoACD is told the median number of
the humans' parts as its largest number of hulls. FOLDER gets N.seg, a number a face,
and N.seconds, the processor time, for `rand_index.py --beside FOLDER`. Models that are
there already are left out, so that hours can be had in pieces.
"""

import argparse
import subprocess
import sys
import time
from pathlib import Path

import coacd
import numpy as np
from princeton import median_count, models, read_humans, read_model
from scipy.spatial import ConvexHull

# The default of CoACD, on a shape whose longest side is 2.
THRESHOLD = 0.05


def main() -> int:
    """Segment every model of a directory."""
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("directory", type=Path)
    parser.add_argument("segments", type=Path)
    parser.add_argument("--model", type=int, help="this one alone")
    arguments = parser.parse_args()
    if arguments.model:
        segment(arguments.directory, arguments.segments, arguments.model)
        return 0
    arguments.segments.mkdir(parents=True, exist_ok=True)
    for model in models(arguments.directory):
        if (arguments.segments / f"{model}.seconds").exists():
            continue
        # A process for each: CoACD ends some with a segmentation fault.
        done = subprocess.run([sys.executable, *sys.argv, "--model", str(model)])
        if done.returncode:
            print(f"{model}: CoACD failed with status {done.returncode}", flush=True)
    return 0


def segment(directory: Path, segments: Path, model: int) -> None:
    """Write the labels of one model, and the processor time they took."""
    coacd.set_log_level("error")
    mesh = read_model(directory, model)
    n_humans = median_count(read_humans(directory, model))
    started = time.process_time()
    hulls = coacd.run_coacd(
        coacd.Mesh(mesh.vertices, mesh.triangles),
        threshold=THRESHOLD,
        max_convex_hull=n_humans,
    )
    seconds = time.process_time() - started
    labels = nearest_hull(mesh.vertices[mesh.triangles].mean(axis=1), hulls)
    np.savetxt(segments / f"{model}.seg", labels, fmt="%d")
    (segments / f"{model}.seconds").write_text(f"{seconds:.1f}\n")
    print(f"{model}: {len(hulls)} hulls, {seconds:.1f} s", flush=True)


def nearest_hull(
    points: np.ndarray, hulls: list[tuple[np.ndarray, np.ndarray]]
) -> np.ndarray:
    """Return the hull that each point is deepest in, or least far out of."""
    heights = []
    for vertices, _ in hulls:
        planes = ConvexHull(vertices, qhull_options="QJ").equations
        heights.append((points @ planes[:, :3].T + planes[:, 3]).max(axis=1))
    return np.argmin(heights, axis=0)


if __name__ == "__main__":
    sys.exit(main())
