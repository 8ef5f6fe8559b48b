"""Share of the area that changes color from k to k + 1 parts, beside the least.

    PYTHONPATH=tests/support python .tools/color_change.py FILE...

Without a file, Suzanne with two subdivisions. The parts are written to an object, as
the chart does, and the colors of its faces are compared. The least possible is what an
optimal assignment of the two sets of parts leaves over.
"""

import argparse
from pathlib import Path

import bpy
import checkout  # noqa: F401  # makes the package importable
import numpy as np
import weak_convex_decomposition as package
from hand_made import activate, areas, face_values, subdivided_suzanne
from scipy.optimize import linear_sum_assignment
from weak_convex_decomposition.operators.bridge.parts.read import part_identities
from weak_convex_decomposition.operators.headless.read.load import load

COUNTS = range(3, 13)


def least_change(before: np.ndarray, after: np.ndarray, sizes: np.ndarray) -> float:
    """Return the share of the area that no names for the new parts can keep."""
    shared = np.zeros((before.max() + 1, after.max() + 1))
    np.add.at(shared, (before, after), sizes)
    kept = shared[linear_sum_assignment(-shared)].sum()
    return 1.0 - float(kept / sizes.sum())


def colors_of(obj: bpy.types.Object) -> tuple[np.ndarray, np.ndarray, set[str]]:
    """Return the part and the color of each face, and the names of the parts."""
    identities = part_identities(obj)
    numbers = face_values(obj.data, "wcd_part")
    colors = {each.number: each.color for each in identities}
    of_faces = np.array([colors[number] for number in numbers.tolist()])
    return numbers, of_faces, {each.name for each in identities}


def measure(obj: bpy.types.Object, samples: int) -> float:
    """Print a line for each number of parts; return the largest excess."""
    activate(obj)
    bpy.context.scene.wcd.samples = samples
    bpy.ops.wcd.decompose(samples=samples, parts=COUNTS[0])
    sizes, excess = areas(obj.data), []
    for k in COUNTS[1:]:
        before, old, names = colors_of(obj)
        bpy.ops.wcd.choose_part_count(parts=k)
        after, new, names_now = colors_of(obj)
        changed = sizes[(old != new).any(axis=1)].sum() / sizes.sum()
        least = least_change(before, after, sizes)
        excess.append(changed - least)
        kept = len(names & names_now)
        print(
            f"{obj.name:14}{k - 1:3} to{k:3}: changed {changed:6.1%}, least"
            f" {least:6.1%}, {kept} of {len(names)} names kept",
            flush=True,
        )
    return max(excess)


def main() -> None:
    """Measure the models on the command line."""
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("files", type=Path, nargs="*")
    parser.add_argument("--samples", type=int, default=1200)
    arguments = parser.parse_args()
    package.register()
    objects = [subdivided_suzanne(2)] if not arguments.files else []
    for path in arguments.files:
        objects += load(path, None)
        largest = measure(objects[-1], arguments.samples)
        print(f"{path.stem}: at most {largest:.2%} above the least", flush=True)
    if not arguments.files:
        print(f"at most {measure(objects[0], arguments.samples):.2%} above the least")


if __name__ == "__main__":
    main()
