from dataclasses import asdict
from types import SimpleNamespace

import bpy
import pytest
from computed import decompose, measure
from edited import record_of
from hand_made import face_values, give_user_data
from snapshot import snapshot
from weak_convex_decomposition.core.parameters.parts import Parameters
from weak_convex_decomposition.core.parameters.presets import PRESETS
from weak_convex_decomposition.operators.bridge.rays.bvh import BvhRayCaster
from weak_convex_decomposition.operators.bridge.read.shape import read_shape
from weak_convex_decomposition.operators.scene_settings import WCD_OT_use_preset
from weak_convex_decomposition.operators.settings import parameters_from

FAST = {"samples": 300}


@pytest.fixture
def cube():
    bpy.ops.mesh.primitive_cube_add()
    return bpy.context.active_object


@pytest.fixture
def dumbbell():
    """Two boxes joined by a thin bar, in one mesh of overlapping shells."""
    bpy.ops.mesh.primitive_cube_add(location=(-3, 0, 0))
    bpy.ops.mesh.primitive_cube_add(location=(3, 0, 0))
    bpy.ops.mesh.primitive_cube_add(scale=(3, 0.2, 0.2))
    bpy.ops.object.select_all(action="SELECT")
    bpy.ops.object.join()
    return bpy.context.active_object


def test_the_operator_gives_what_the_core_gives(suzanne):
    chosen = {**FAST, "alpha": 0.4, "seed": 3, "cone_angle": 1.0, "sight": "CONE"}
    mesh = read_shape(suzanne)
    expected = decompose(mesh, Parameters(**chosen), make_caster=BvhRayCaster)
    assert bpy.ops.wcd.decompose(**chosen) == {"FINISHED"}
    assert (face_values(suzanne.data, "wcd_part") == expected.labels).all()
    record = record_of(suzanne)
    assert record["parameters"] == asdict(Parameters(**chosen))
    assert record["psi"] == pytest.approx(expected.psi, abs=1e-12)
    assert record["psi_by_k"].keys() == {str(k) for k in expected.psi_by_k}
    ranks = [part["convexity_rank"] for part in record["parts"]]
    assert ranks == pytest.approx(expected.ranks.tolist(), abs=1e-12)


def test_a_cube_is_one_part(cube):
    bpy.ops.wcd.decompose(**FAST)
    assert set(face_values(cube.data, "wcd_part")) == {0}
    assert len(cube.vertex_groups) == len(cube.material_slots) == 1
    (part,) = record_of(cube)["parts"]
    assert part["convexity_rank"] == pytest.approx(1.0, abs=1e-3)
    assert part["area"] == pytest.approx(24.0, rel=1e-5)


def test_a_dumbbell_falls_apart_in_edit_mode_too(dumbbell):
    bpy.ops.wcd.decompose(**FAST, parts=3)
    labels = face_values(dumbbell.data, "wcd_part")
    bpy.ops.wcd.clear()
    bpy.ops.object.mode_set(mode="EDIT")
    bpy.ops.wcd.decompose(**FAST, parts=3)
    assert dumbbell.mode == "EDIT"
    bpy.ops.object.mode_set(mode="OBJECT")
    assert (face_values(dumbbell.data, "wcd_part") == labels).all()
    assert len(set(labels)) == 3


def test_default_properties_are_the_default_parameters(suzanne):
    assert parameters_from(bpy.context.scene.wcd) == Parameters()
    bpy.ops.wcd.decompose(**FAST)
    record = record_of(suzanne)
    assert record["parameters"] == asdict(Parameters(**FAST))


def test_operator_and_clear_bring_the_object_back(suzanne):
    give_user_data(suzanne)
    before = snapshot(suzanne)
    bpy.ops.wcd.decompose(**FAST)
    bpy.ops.wcd.decompose(**FAST, parts=3)
    bpy.ops.wcd.measure(**FAST)
    assert bpy.ops.wcd.clear() == {"FINISHED"}
    assert snapshot(suzanne) == before


def test_same_seed_same_parts(suzanne):
    bpy.ops.wcd.decompose(**FAST, seed=5)
    first = snapshot(suzanne)
    bpy.ops.wcd.decompose(**FAST, seed=5)
    assert snapshot(suzanne) == first


def test_measure_stores_what_the_core_gives(suzanne):
    expected = measure(
        read_shape(suzanne), Parameters(**FAST), make_caster=BvhRayCaster
    )
    assert bpy.ops.wcd.measure(**FAST) == {"FINISHED"}
    measured = record_of(suzanne)["measured"]
    assert measured["convexity_rank"] == pytest.approx(expected.rank)
    assert measured["standard_error"] == pytest.approx(expected.standard_error)
    assert measured["samples"] == expected.n_samples
    assert measured["parameters"]["samples"] == 300


def test_measurement_and_decomposition_keep_each_other(suzanne):
    bpy.ops.wcd.measure(**FAST)
    measured = record_of(suzanne)["measured"]
    bpy.ops.wcd.decompose(**FAST)
    assert record_of(suzanne)["measured"] == measured
    bpy.ops.wcd.measure(**FAST)
    record = record_of(suzanne)
    assert record["measured"] == measured
    assert record["parts"]


def test_clear_takes_a_measurement_back(suzanne):
    before = snapshot(suzanne)
    bpy.ops.wcd.measure(**FAST)
    bpy.ops.wcd.clear()
    assert snapshot(suzanne) == before


def test_decomposing_is_one_undo_step(suzanne):
    before = snapshot(suzanne)
    bpy.ops.ed.undo_push(message="before")
    bpy.ops.wcd.decompose("EXEC_DEFAULT", True, **FAST)  # True: as a window does
    after = snapshot(suzanne)
    bpy.ops.ed.undo()
    assert snapshot(bpy.context.active_object) == before
    bpy.ops.ed.redo()
    assert snapshot(bpy.context.active_object) == after


def test_operators_have_one_undo_step_each():
    for name in ("decompose", "measure", "clear"):
        cls = getattr(bpy.types, f"WCD_OT_{name}")
        assert {"REGISTER", "UNDO"} <= cls.bl_options


def test_a_preset_sets_every_setting_of_the_scene():
    settings = bpy.context.scene.wcd
    settings.seed, settings.alpha = 5, 7.0
    for each in PRESETS:
        assert bpy.ops.wcd.use_preset(preset=each.identifier) == {"FINISHED"}
        found = asdict(parameters_from(settings))
        angle = found.pop("cone_angle")
        expected = asdict(each.parameters())
        assert angle == pytest.approx(expected.pop("cone_angle"))
        assert found == expected
        tooltip = WCD_OT_use_preset.description(
            bpy.context, SimpleNamespace(preset=each.identifier)
        )
        assert tooltip == each.help
