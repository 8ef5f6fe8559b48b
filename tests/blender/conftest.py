"""Factory settings and the registered add-on around each test."""

import bpy
import pytest
import weak_convex_decomposition as package


@pytest.fixture(autouse=True)
def blender():
    bpy.ops.wm.read_factory_settings(use_empty=True)
    package.register()
    yield
    package.unregister()


@pytest.fixture
def suzanne():
    bpy.ops.mesh.primitive_monkey_add()
    return bpy.context.active_object
