import bpy
import weak_convex_decomposition as package


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
