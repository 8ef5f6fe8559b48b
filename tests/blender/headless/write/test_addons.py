"""Formats of Blender's add-ons are written where these are switched off, too."""

import addon_utils
import bpy
import pytest
from hand_made import add_ring, build_hulls
from weak_convex_decomposition.core.parameters.bodies import BodyParameters
from weak_convex_decomposition.operators.headless.formats import FBX, GLTF, enable
from weak_convex_decomposition.operators.headless.write.hull_files import save_hulls
from weak_convex_decomposition.operators.headless.write.model_files import save


@pytest.fixture
def switched_off():
    """Switch the add-ons off for a test."""
    for addon in (GLTF, FBX):
        addon_utils.disable(addon)
    yield
    for addon in (GLTF, FBX):
        addon_utils.enable(addon)


@pytest.mark.parametrize("ending", [".glb", ".fbx"])
def test_models(tmp_path, suzanne, switched_off, ending):
    save(tmp_path / f"a{ending}", None)
    assert (tmp_path / f"a{ending}").stat().st_size > 10_000


def test_hulls(tmp_path, switched_off):
    hulls = build_hulls([add_ring("Ring")], max_hulls=2)
    save_hulls(tmp_path / "a.glb", hulls, None, BodyParameters())
    assert (tmp_path / "a.glb").stat().st_size > 1000


def test_settings_of_the_user_stay(tmp_path, suzanne, switched_off):
    chosen = {addon.module for addon in bpy.context.preferences.addons}
    save(tmp_path / "a.glb", None)
    now = {addon.module for addon in bpy.context.preferences.addons}
    assert now == chosen


def test_an_addon_that_is_missing_is_a_reason():
    with pytest.raises(RuntimeError, match="add-on io_nothing is missing"):
        enable("io_nothing")
