"""Two processes that round and share work differently write the same bytes.

They have other numbers of threads, and products of matrices for other processors, as
OpenBLAS has them on x86; elsewhere it makes no difference.

Left out: .blend has addresses of memory, .png what the renderer and its threads make of
rounding. The report has seconds.
"""

import json
import os
import re
import subprocess
import sys

import bpy
import pytest
from checkout import PACKAGE, ROOT
from headless.command import content
from weak_convex_decomposition.operators.headless.write.painted_copies import ply_copies

OUTPUTS = ("a.glb", "b.obj", "c.ply", "j.fbx", "k.usd")
HULLS = ("d.glb", "e.obj", "f.stl", "g.usd", "h.urdf", "i.xml")
RUNS = f"""
import itertools, os, sys
import checkout
import bpy
import {PACKAGE} as package
package.register()
from {PACKAGE}.operators.headless.command_line import main
os.chdir(sys.argv[1])
given = [sys.argv[2], "--samples=300", "--max-hulls=2", "--quiet"]
for hulls, output in itertools.zip_longest({HULLS}, {OUTPUTS}):
    words = ["--hulls", hulls, "--report", f"{{hulls}}.json"]
    words += ["--output", output] if output else []
    assert main([*given, *words]) == 0, hulls
sys.stdout.flush()
os._exit(0)
"""


def start(folder, n_threads, processor):
    """Start the runs, which write to a folder."""
    folder.mkdir()
    names = ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS")
    environment = {k: v for k, v in os.environ.items() if k != "OCIO"}
    environment |= dict.fromkeys(names, str(n_threads))
    environment["PYTHONPATH"] = str(ROOT / "tests" / "support")
    environment["PYTHONHASHSEED"] = str(n_threads)
    environment["OPENBLAS_CORETYPE"] = processor
    return subprocess.Popen(
        [sys.executable, "-c", RUNS, str(folder), str(folder.parent / "in.blend")],
        env=environment,
        stdout=subprocess.DEVNULL,
        stderr=subprocess.PIPE,
        text=True,
    )


@pytest.fixture
def two_runs(tmp_path):
    """Return the files of a run with one thread, and of one with two elsewhere."""
    turn = {"location": (1, 2, 3), "rotation": (0.3, 0.5, 0.1)}
    bpy.ops.mesh.primitive_torus_add(major_segments=12, minor_segments=6, **turn)
    bpy.ops.mesh.primitive_cube_add(location=(5, 0, 0))
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "in.blend"), copy=True)
    folders = [tmp_path / name for name in ("one", "two")]
    kinds = (1, "HASWELL"), (2, "NEHALEM")
    processes = [
        start(folder, *kind) for folder, kind in zip(folders, kinds, strict=True)
    ]
    errors = [process.communicate(timeout=300)[1] for process in processes]
    assert [process.returncode for process in processes] == [0, 0], errors
    return [content(folder) for folder in folders]


def without_times(report):
    """Return a report without what differs from run to run."""
    text = re.sub(rb'"(seconds|peak_memory)": [\d.]+', rb'"\1": 0', report)
    return json.loads(text)


def test_all_files_are_the_same(two_runs):
    one, two = two_runs
    assert one.keys() == two.keys() >= {*OUTPUTS, *HULLS, "b.mtl"}
    assert sum(name.startswith(("h_urdf/", "i_xml/")) for name in one) > 6
    reports = {name for name in one if name.endswith(".json") and "/" not in name}
    for name in reports:
        assert without_times(one[name]) == without_times(two[name]), name
    others = one.keys() - reports
    assert sorted(name for name in others if one[name] != two[name]) == []


def test_all_copies_for_ply_have_a_uv_map_if_one_has():
    bpy.ops.wm.read_homefile(use_factory_startup=True, use_empty=True)
    bpy.ops.mesh.primitive_torus_add()
    bpy.ops.mesh.primitive_cube_add()
    layers = bpy.context.object.data.uv_layers
    layers.remove(layers[0])
    with ply_copies():
        copies = bpy.context.selected_objects
        assert [len(copy.data.uv_layers) for copy in copies] == [1, 1]


def test_ply_has_no_uv_maps_beside_loose_vertices():
    bpy.ops.wm.read_homefile(use_factory_startup=True, use_empty=True)
    bpy.ops.mesh.primitive_torus_add()
    with ply_copies() as with_uv:
        assert with_uv
    mesh = bpy.data.meshes.new("Wire")
    mesh.from_pydata([(0, 0, 0), (1, 0, 0)], [(0, 1)], [])
    bpy.context.collection.objects.link(bpy.data.objects.new("Wire", mesh))
    bpy.context.view_layer.update()
    with ply_copies() as with_uv:
        assert not with_uv
