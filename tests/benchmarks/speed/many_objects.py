"""Seconds for a file of many small objects, hulls alone and with parts.

    make bench-objects OBJECTS=1000

The files have cubes, or cubes, cones, tori, coarse monkeys, L-shapes, cylinders and
ico-spheres in turn. Each has a mesh and proportions of its own. In the file of props,
each has a mesh of its own, too, but those of one kind are equal but for the objects'
sizes and rotations, as in scenes. They are written to build/many_objects/, where the
outputs can be looked at.
"""

import math
import os
import subprocess
import sys
import time
from itertools import product
from pathlib import Path

import bpy  # first: it brings bmesh and mathutils

# isort: split
import bmesh
import numpy as np
from checkout import ROOT
from mathutils import Matrix

FOLDER = ROOT / "build/many_objects"
LIMITS = {"cubes": 60, "mixed": 120, "props": 120}
COARSE = 0.2  # share of the monkey's faces that stays
ROW = 40


def cube(bm):
    bmesh.ops.create_cube(bm, size=2)


def cone(bm):
    bmesh.ops.create_cone(bm, cap_ends=True, segments=16, radius1=1, radius2=0, depth=2)


def torus(bm, around=12, across=6, thin=0.35):
    """Add a torus of quads."""
    turns = [2 * math.pi * i / around for i in range(around)]
    tilts = [2 * math.pi * i / across for i in range(across)]
    rings = [
        [
            bm.verts.new(
                (
                    (1 + thin * math.cos(tilt)) * math.cos(turn),
                    (1 + thin * math.cos(tilt)) * math.sin(turn),
                    thin * math.sin(tilt),
                )
            )
            for tilt in tilts
        ]
        for turn in turns
    ]
    for i, j in product(range(around), range(across)):
        one, other = rings[i], rings[(i + 1) % around]
        k = (j + 1) % across
        bm.faces.new((one[j], other[j], other[k], one[k]))


def monkey(bm):
    bmesh.ops.create_monkey(bm)


def l_shape(bm):
    """Add an L of two hexagons and six quads."""
    outline = [(-1, -1), (1, -1), (1, 0), (0, 0), (0, 1), (-1, 1)]
    low, high = ([bm.verts.new((*p, z)) for p in outline] for z in (-0.5, 0.5))
    bm.faces.new(low[::-1])
    bm.faces.new(high)
    for i in range(6):
        j = (i + 1) % 6
        bm.faces.new((low[i], low[j], high[j], high[i]))


def cylinder(bm):
    bmesh.ops.create_cone(bm, cap_ends=True, segments=16, radius1=1, radius2=1, depth=2)


def ico_sphere(bm):
    bmesh.ops.create_icosphere(bm, subdivisions=2, radius=1)


KINDS = {
    "cubes": (cube,),
    "mixed": (cube, cone, torus, monkey, l_shape, cylinder, ico_sphere),
}
KINDS["props"] = KINDS["mixed"]


def make_scene(kind, count, path):
    """Save a file of objects in rows."""
    bpy.ops.wm.read_factory_settings(use_empty=True)
    rng = np.random.default_rng(0)
    for number in range(count):
        make = KINDS[kind][number % len(KINDS[kind])]
        name = f"{make.__name__} {number:04d}"
        mesh = bpy.data.meshes.new(name)
        bm = bmesh.new()
        make(bm)
        factors = rng.uniform(0.7, 1.3, 3)
        if kind != "props":
            bm.transform(Matrix.Diagonal((*factors, 1)))
        bm.to_mesh(mesh)
        bm.free()
        obj = bpy.data.objects.new(name, mesh)
        if kind == "props":
            obj.scale, obj.rotation_euler = [factors[0]] * 3, 2 * math.pi * factors
        bpy.context.collection.objects.link(obj)
        if make is monkey:
            coarsen(obj)
        obj.location = (3 * (number % ROW), 3 * (number // ROW), 0)
    bpy.ops.wm.save_as_mainfile(filepath=str(path), copy=True)


def coarsen(obj):
    """Give an object the mesh that Decimate makes of it."""
    obj.modifiers.new("Decimate", "DECIMATE").ratio = COARSE
    evaluated = obj.evaluated_get(bpy.context.evaluated_depsgraph_get())
    obj.data = bpy.data.meshes.new_from_object(evaluated)
    obj.modifiers.clear()


def seconds_of(*arguments):
    """Run the command line; return its seconds, and those of the processor."""
    before, started = os.times(), time.perf_counter()
    command = [sys.executable, ".", *map(str, arguments), "--quiet"]
    subprocess.run(command, cwd=ROOT, check=True)
    after = os.times()
    used = sum(after[2:4]) - sum(before[2:4])  # of processes that have ended
    return time.perf_counter() - started, used


def main(count):
    """Print a row for each file and each output."""
    FOLDER.mkdir(parents=True, exist_ok=True)
    print(f"{'objects':>14}{'output':>8}{'seconds':>9}{'processor':>11}{'limit':>7}")
    for kind, limit in LIMITS.items():
        path = FOLDER / f"{kind}.blend"
        make_scene(kind, count, path)
        for option, ending in (("output", "parts.blend"), ("hulls", "hulls.glb")):
            file: Path = FOLDER / f"{kind}-{ending}"
            wall, used = seconds_of(path, f"--{option}", file)
            figures = f"{wall:9.1f}{used:11.1f}{limit:7}"
            print(f"{count:>8,} {kind:5}{option:>8}{figures}", flush=True)


if __name__ == "__main__":
    main(int(sys.argv[1]) if len(sys.argv) > 1 else 1000)
