"""Factory settings and the add-on for each file; an empty scene for each test."""

import bpy
import pytest
import weak_convex_decomposition as package
from edited import FAST
from hand_made import decompose_by_hand
from weak_convex_decomposition import operators


@pytest.fixture(scope="module", autouse=True)
def registered():
    """Reset the preferences and register: each takes longer than an empty scene."""
    bpy.ops.wm.read_factory_settings(use_empty=True)
    package.register()
    yield
    package.unregister()


@pytest.fixture(autouse=True)
def blender(registered):
    bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)
    yield
    operators.stop()


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
