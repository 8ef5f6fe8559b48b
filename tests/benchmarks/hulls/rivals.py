"""Compare hulls with CoACD's and V-HACD's: python rivals.py FOLDER RESULTS PYTHON.

FOLDER is searched for meshes, but for files named in no category's first place of the
Princeton benchmark; what tools made is kept in RESULTS, so that a run can go on where
another stopped; PYTHON has bpy.
"""

import os
import subprocess
import sys
from pathlib import Path

import hull_scores
import numpy as np
import trimesh

ENDINGS = {".obj", ".off", ".ply", ".stl"}
RIVALS = ("coacd-0.05", "coacd-0.1", "vhacd")
SECONDS = 3600
# Seconds are those of a processor; threads that wait for others would count, too.
ONE_THREAD = {"OMP_NUM_THREADS": "1", "OPENBLAS_NUM_THREADS": "1"}
COLUMNS = ("hulls", "concavity", "mean", "iou", "volumes", "seconds")


def mesh_files(folder):
    """Return the meshes below a folder; of the Princeton benchmark, model 3 of each."""
    files = sorted(p for p in Path(folder).rglob("*") if p.suffix in ENDINGS)
    return [p for p in files if not p.stem.isdigit() or int(p.stem) % 20 == 3]


def hulls_by(python, tool, arrays, result, *values):
    """Return hulls and seconds, None if the tool fails."""
    script = Path(__file__).with_name("hull_tools.py")
    if not result.exists():
        words = [python, script, tool, arrays, result, *values]
        try:
            subprocess.run(
                [str(word) for word in words],
                env=os.environ | ONE_THREAD,
                check=True,
                timeout=SECONDS,
                capture_output=True,
            )
        except (subprocess.CalledProcessError, subprocess.TimeoutExpired) as error:
            print(f"{result.stem}: {tool} failed ({error})", file=sys.stderr)
            return None
    with np.load(result) as found:
        names = sorted(name for name in found.files if name != "seconds")
        return [found[name] for name in names], float(found["seconds"])


def compared(path, results, python):
    """Yield (rival, its figures, ours at its number of hulls) for a mesh."""
    mesh = trimesh.load(path, force="mesh", process=False)
    arrays = results / f"{path.stem}.npz"
    np.savez(arrays, vertices=mesh.vertices, triangles=mesh.faces)
    for rival in RIVALS:
        found = hulls_by(
            sys.executable, rival, arrays, results / f"{path.stem}-{rival}.npz"
        )
        if found is None:
            continue
        n_hulls = len(found[0])
        own = results / f"{path.stem}-ours-{n_hulls}.npz"
        ours = hulls_by(python, "ours", arrays, own, n_hulls)
        if ours is None:
            continue
        yield (
            rival,
            *(
                {**hull_scores.scores(mesh, hulls), "seconds": seconds}
                for hulls, seconds in (found, ours)
            ),
        )


def line(name, tool, figures):
    values = [
        f"{figures[c]:10.3f}" if c != "hulls" else f"{figures[c]:10.1f}"
        for c in COLUMNS
    ]
    return f"{name:16}{tool:12}" + "".join(values)


def main(folder, results, python):
    results = Path(results)
    results.mkdir(parents=True, exist_ok=True)
    rows = {rival: [] for rival in RIVALS}
    print(f"{'mesh':16}{'tool':12}" + "".join(f"{c:>10}" for c in COLUMNS))
    for path in mesh_files(folder):
        for rival, theirs, ours in compared(path, results, python):
            rows[rival].append((theirs, ours))
            print(line(path.stem, rival, theirs))
            print(line(path.stem, "ours", ours), flush=True)
    for rival, pairs in rows.items():
        if not pairs:
            continue
        for tool, side in ((rival, 0), ("ours", 1)):
            means = {c: np.mean([pair[side][c] for pair in pairs]) for c in COLUMNS}
            print(line(f"mean of {len(pairs)}", tool, means))
        ratios = [theirs["seconds"] / ours["seconds"] for theirs, ours in pairs]
        print(f"{rival} takes {np.median(ratios):.1f} times our seconds in the median")


if __name__ == "__main__":
    main(*sys.argv[1:])
