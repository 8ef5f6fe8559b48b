"""Files that were saved in another mode are read in Object Mode."""

import bpy
import pytest
from hand_made import activate, in_mode
from headless.command import run_wcd
from weak_convex_decomposition.operators.headless.read.load import load_file

MODES = ("EDIT", "SCULPT", "VERTEX_PAINT", "WEIGHT_PAINT")


@pytest.fixture
def two_cubes():
    """Return two selected cubes; the second is active."""
    for name in ("One", "Other"):
        bpy.ops.mesh.primitive_cube_add()
        bpy.context.active_object.name = name
    one, other = bpy.data.objects
    one.select_set(True)
    return one, other


@pytest.mark.parametrize("mode", MODES)
@pytest.mark.parametrize("ending", [".blend", ".glb", ".ply", ".usd"])
def test_files_saved_in_any_mode_go_through(tmp_path, two_cubes, mode, ending):
    in_mode(two_cubes[1], mode)
    path, output = tmp_path / "a.blend", tmp_path / f"out{ending}"
    bpy.ops.wm.save_as_mainfile(filepath=str(path), copy=True)
    words = [path, "--output", output, "--samples", "60", "--hulls", tmp_path / "h.stl"]
    assert run_wcd(*words) == 0
    faces = [len(obj.data.polygons) for obj in load_file(output, None, False).objects]
    assert sum(faces) == (24 if ending == ".glb" else 12)


def test_the_active_object_stays_so(tmp_path, two_cubes):
    one, other = two_cubes
    activate(one)
    in_mode(one, "EDIT")
    bpy.context.view_layer.objects.active = other
    other.hide_viewport = True
    path = tmp_path / "a.blend"
    bpy.ops.wm.save_as_mainfile(filepath=str(path), copy=True)
    modes = [obj.mode for obj in load_file(path, None, False).objects]
    assert modes == ["OBJECT", "OBJECT"]
    assert bpy.context.view_layer.objects.active == bpy.data.objects["Other"]
