"""Cuts the faces of random meshes of few faces, and checks what cuts must keep.

    make bench-cuts CUTS=200

Checked are the shape (no gap, area, volume), UV maps, colors, weights, shape keys,
creases and seams, and that Clear gives back the mesh to the last bit.
"""

import sys
import time

import bpy  # first: it brings bmesh and mathutils
from checkout import PACKAGE

# isort: split
import weak_convex_decomposition as package
from random_work.low_poly import check_kept, figures, low_poly
from snapshot import snapshot


def run(seed):
    """Return how many faces a mesh has, and how many pieces; raise if one is wrong."""
    bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)
    obj = low_poly(seed)
    before, known, n_faces = snapshot(obj), figures(obj), len(obj.data.polygons)
    bpy.ops.wcd.decompose(seams="CUT")
    n_pieces = len(obj.data.polygons)
    check_kept(obj, known, n_faces)
    bpy.ops.wcd.clear()
    assert snapshot(obj) == before, "Clear"
    return n_faces, n_pieces


def main(n_meshes):
    """Check so many meshes, and print what was wrong."""
    package.register()
    wrong, n_cut, started = {}, 0, time.process_time()
    for seed in range(n_meshes):
        try:
            n_faces, n_pieces = run(seed)
            n_cut += n_pieces > n_faces
        except AssertionError as error:
            wrong[seed] = str(error).split("\n")[0]
    seconds = time.process_time() - started
    print(f"{n_meshes} meshes, {n_cut} with cut faces, {seconds:.0f} s: {PACKAGE}")
    for seed, reason in wrong.items():
        print(f"mesh {seed}: {reason}")
    return bool(wrong)


if __name__ == "__main__":
    sys.exit(main(int(sys.argv[1]) if sys.argv[1:] else 200))
