"""Hulls and bodies that are tiny or thin: MuJoCo reads them, or a note names them."""

import bpy
import mujoco
import numpy as np
import pytest
from hand_made import build_hulls
from weak_convex_decomposition.core.parameters.bodies import BodyParameters
from weak_convex_decomposition.operators.headless.write.hull_files import save_hulls


def save_with_crumb(path, size, place=0.0, bodies="ONE"):
    """Write hulls of a ball and of a crumb in some place; return the notes."""
    objects = []
    for name, scale, x in (("Ball", 1.0, 0.0), ("Crumb", size, place)):
        bpy.ops.mesh.primitive_ico_sphere_add(
            subdivisions=1, radius=scale, location=(x, 0, 0)
        )
        objects.append(bpy.context.active_object)
        objects[-1].name = name
    hulls = build_hulls(objects, max_hulls=1)
    return save_hulls(path, hulls, "Z", BodyParameters(bodies=bodies))


@pytest.mark.parametrize("size", [1e-5, 3e-6, 1e-7])
def test_mujoco_reads_hulls_without_much_volume(tmp_path, size):
    path = tmp_path / "a.xml"
    assert save_with_crumb(path, size) == ()
    assert path.read_text().count('inertia="shell"') == 2 + (size < 7e-6)
    model = mujoco.MjModel.from_xml_path(str(path))
    assert sum(model.geom_contype != 0) == 2


@pytest.mark.parametrize(("ending", "size"), [("xml", 1e-9), ("urdf", 5e-6)])
def test_hulls_that_it_refuses_are_named(tmp_path, ending, size):
    path = tmp_path / f"a.{ending}"
    (note,) = save_with_crumb(path, size)
    assert note.startswith("MuJoCo refuses hulls as small as these: Crumb hull 01;")
    with pytest.raises(ValueError, match="too small"):
        mujoco.MjModel.from_xml_path(str(path))


def test_a_crumb_far_from_the_origin_of_its_body_is_flat(tmp_path):
    path = tmp_path / "a.xml"
    (note,) = save_with_crumb(path, 3e-5, place=1000.0)
    assert note.endswith(
        "Crumb hull 01; make the model larger, or choose Bodies = Each."
    )
    with pytest.raises(ValueError, match="qhull"):
        mujoco.MjModel.from_xml_path(str(path))


@pytest.mark.parametrize("ending", ["xml", "urdf"])
@pytest.mark.parametrize(
    ("size", "least"), [((1, 1, 1e-5), 1.0), ((10, 3e-4, 3e-4), 7e-3)]
)
def test_thin_bodies_keep_their_inertia(tmp_path, ending, size, least):
    objects = []
    for number, turn in enumerate(np.random.default_rng(0).uniform(0, 6, (12, 3))):
        bpy.ops.mesh.primitive_cube_add(size=1, location=(20 * number, 0, 0))
        objects.append(bpy.context.active_object)
        objects[-1].scale, objects[-1].rotation_euler = size, turn
    bpy.context.view_layer.update()
    hulls = build_hulls(objects, max_hulls=1)
    parameters = BodyParameters(density=1e5 if size[0] == 1 else 8000, bodies="EACH")
    assert save_hulls(tmp_path / f"a.{ending}", hulls, "Z", parameters) == ()
    model = mujoco.MjModel.from_xml_path(str(tmp_path / f"a.{ending}"))
    assert model.body_mass.max() == pytest.approx(least, rel=0.1)
