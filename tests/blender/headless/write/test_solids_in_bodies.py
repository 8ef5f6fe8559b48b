"""Boxes, spheres, cylinders and capsules are those of the simulator."""

import xml.etree.ElementTree as ET

import mujoco
import numpy as np
import pytest
from hand_made import add_ring, build_hulls
from mathutils import Matrix
from weak_convex_decomposition.core.parameters.bodies import BodyParameters
from weak_convex_decomposition.operators.headless.write.hull_files import save_hulls
from weak_convex_decomposition.operators.headless.write.placed_meshes import (
    matrix_of,
    placed,
)

CAPSULE_IN_URDF = ("CAPSULE", "urdf")


@pytest.mark.parametrize("shape", ["BOX", "SPHERE", "CYLINDER", "CAPSULE"])
def test_primitives_are_primitives(tmp_path, shape):
    ring = add_ring("Ring", (-2, 2, 2))
    ring.data.transform(Matrix.Scale(3, 4, (1, 0, 0)))
    (hull,) = hulls = build_hulls([ring], shape=shape, max_hulls=1, naming="UNREAL")
    for ending in ("xml", "urdf"):
        save_hulls(tmp_path / f"a.{ending}", hulls, "Z", BodyParameters(bodies="EACH"))
    vertices, _, _ = placed(hull, matrix_of(hull))
    for ending in ("xml", "urdf"):
        model = mujoco.MjModel.from_xml_path(str(tmp_path / f"a.{ending}"))
        data = mujoco.MjData(model)
        mujoco.mj_forward(model, data)
        solids = [n for n in range(model.ngeom) if model.geom(n).contype[0]]
        kinds = {mujoco.mjtGeom(model.geom_type[n]).name[7:] for n in solids}
        parts = (
            {"CYLINDER", "SPHERE"} if (shape, ending) == CAPSULE_IN_URDF else {shape}
        )
        assert kinds == parts
        gaps = np.min([distances(model, data, n, vertices) for n in solids], axis=0)
        assert np.abs(gaps).max() < 1e-5 * ring.dimensions.length


def distances(model, data, number, points):
    """Return how far points are outside a geom, negative inside."""
    turn, size = data.geom_xmat[number].reshape(3, 3), model.geom_size[number]
    local = np.abs((points - data.geom_xpos[number]) @ turn)
    kind = mujoco.mjtGeom(model.geom_type[number]).name[7:]
    if kind == "BOX":
        return (local - size).max(axis=1)
    across = np.linalg.norm(local[:, :2], axis=1)
    if kind == "CYLINDER":
        return np.maximum(across - size[0], local[:, 2] - size[1])
    half = size[1] if kind == "CAPSULE" else 0.0
    return np.hypot(across, np.maximum(local[:, 2] - half, 0)) - size[0]


def test_a_capsule_without_length_is_a_ball(tmp_path):
    ring = add_ring("Ring", (1, 1, 1))
    hulls = build_hulls([ring], shape="CAPSULE", max_hulls=1)
    save_hulls(tmp_path / "a.xml", hulls, "Z", BodyParameters())
    assert mujoco.MjModel.from_xml_path(str(tmp_path / "a.xml")).geom_size[-1, 1] == 0


def test_stretched_primitives_are_meshes(tmp_path):
    ring = add_ring("Ring", (1, 1, 1))
    hulls = build_hulls([ring], shape="SPHERE", max_hulls=1)
    ring.scale = (3, 1, 1)
    save_hulls(tmp_path / "a.xml", hulls, "Z", BodyParameters())
    root = ET.parse(tmp_path / "a.xml").getroot()
    kinds = [g.get("type") for g in root.iter("geom") if g.get("class") == "collision"]
    assert kinds == ["mesh"]
