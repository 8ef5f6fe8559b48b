"""Drop models as compounds of hulls, and small balls on them: physics.py FILE...

Tells of each model its hulls, their largest error, its speed after 40 seconds on a
floor and how deep its contacts are, and how far above the surface balls come to rest.
Half of the longest side of a model is 1.
"""

import json
import sys
import tempfile
from pathlib import Path

import checkout  # noqa: F401  # makes the package importable
import numpy as np
import weak_convex_decomposition as package
from headless import simulation
from headless.loading import load
from weak_convex_decomposition.operators.bridge.read.shape import read_shape

SECONDS = 40
HEADING = ("model", "hulls", "error", "speed", "deepest", "balls", "lowest", "highest")


def figures(path):
    """Return the figures of a model, as HEADING has them after the name."""
    (obj,) = load(path, "Y")
    mesh = simulation.on_the_ground(read_shape(obj))
    with tempfile.TemporaryDirectory() as folder:
        report = Path(folder) / "report.json"
        words = "--report", report
        file = simulation.hull_file(Path(folder), "model.xml", mesh, *words)
        loose, fixed = (
            simulation.in_mujoco(file, loose=is_loose) for is_loose in (True, False)
        )
        hulls = json.loads(report.read_text())["inputs"][0]["objects"][0]["hulls"]
        data = simulation.dropped(loose, SECONDS)
        gaps = simulation.gaps_below_balls(mesh, fixed)
    return (
        len(hulls["hulls"]),
        hulls["largest_error"],
        np.abs(data.qvel).max(),
        min(contact.dist for contact in data.contact),
        len(gaps),
        gaps.min(),
        gaps.max(),
    )


def main(*files):
    package.register()
    print("".join(f"{word:>14}" for word in HEADING))
    for file in map(Path, files):
        values = figures(file)
        cells = [f"{v:14d}" if isinstance(v, int) else f"{v:14.3f}" for v in values]
        print(f"{file.stem:>14}" + "".join(cells), flush=True)


if __name__ == "__main__":
    main(*sys.argv[1:])
