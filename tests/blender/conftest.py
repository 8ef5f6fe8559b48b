"""Factory settings for each file; an empty scene and the add-on for each test."""

import bpy
import pytest
import weak_convex_decomposition as package
from edited import FAST
from hand_made import decompose_by_hand


@pytest.fixture(scope="module", autouse=True)
def factory_settings():
    """Reset the preferences, which takes five times as long as an empty scene."""
    bpy.ops.wm.read_factory_settings(use_empty=True)


@pytest.fixture(autouse=True)
def blender():
    bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)
    package.register()
    yield
    package.unregister()


@pytest.fixture
def suzanne():
    bpy.ops.mesh.primitive_monkey_add()
    return bpy.context.active_object


@pytest.fixture
def monkey(suzanne):
    """Suzanne with four bands along x as parts, the second and third ticked."""
    decompose_by_hand(suzanne, 4, **FAST)
    suzanne.wcd_parts[1].chosen = suzanne.wcd_parts[2].chosen = True
    suzanne.wcd_active_part = 1
    return suzanne
