import subprocess
import sys

import bpy
import pytest
import weak_convex_decomposition as package
from conftest import ROOT


def ours():
    names = {name for name in dir(bpy.types) if "WCD_" in name or "wcd" in name}
    return names, dir(bpy.ops.wcd), hasattr(bpy.types.Scene, "wcd")


def test_registering_twice_leaves_nothing():
    there = ours()
    for _ in range(2):
        package.unregister()
        assert ours() == (set(), [], False)
        package.register()
        assert ours() == there


def test_the_sidebar_is_there():
    panel = bpy.types.WCD_PT_main
    assert panel.bl_category == "Convex Parts"
    assert panel.bl_space_type == "VIEW_3D"
    assert panel.bl_region_type == "UI"
    assert "DEFAULT_CLOSED" in bpy.types.WCD_PT_advanced.bl_options


def test_the_menus_have_the_submenu_as_long_as_we_are_registered():
    homes = (bpy.types.VIEW3D_MT_object, bpy.types.VIEW3D_MT_edit_mesh)

    def additions():
        return [
            function
            for home in homes
            for function in home.draw._draw_funcs
            if "weak_convex" in function.__module__
        ]

    assert len(additions()) == 2
    for _ in range(10):
        package.unregister()
        assert additions() == []
        package.register()
    assert len(additions()) == 2


def test_a_script_may_register_once_more():
    there = ours()
    package.register()
    assert ours() == there
    package.unregister()
    package.unregister()
    assert ours() == (set(), [], False)
    package.register()


@pytest.mark.parametrize("name", ["depsgraph_update_post", "load_pre", "undo_post"])
def test_lists_of_handlers_may_have_been_emptied(name):
    handlers, there = getattr(bpy.app.handlers, name), ours()
    watching = [each for each in handlers if "weak_convex" in each.__module__]
    others = [each for each in handlers if each not in watching]
    handlers.clear()
    package.unregister()
    assert ours() == (set(), [], False)
    package.register()
    assert ours() == there
    assert set(handlers) == set(watching) != set()
    handlers.extend(others)


@pytest.mark.parametrize("name", ["depsgraph_update_post", "load_pre", "undo_post"])
def test_another_file_leaves_the_handlers(name):
    handlers = getattr(bpy.app.handlers, name)
    watching = [each for each in handlers if "weak_convex" in each.__module__]
    bpy.ops.wm.read_homefile(use_factory_startup=True)
    assert set(watching) <= set(handlers)
    assert watching


@pytest.mark.parametrize("name", ["register", "unregister"])
def test_without_blender_a_sentence_tells_what_to_install(name):
    code = f"""
import sys
sys.modules["bpy"] = None
sys.path.insert(0, {str(ROOT / "tests" / "support")!r})
import checkout
import weak_convex_decomposition as package
try:
    package.{name}()
except package.DecompositionError as error:
    print(error)
"""
    done = subprocess.run(
        [sys.executable, "-c", code], capture_output=True, text=True, check=True
    )
    assert done.stdout.startswith("Blender is not installed; install its module with")
