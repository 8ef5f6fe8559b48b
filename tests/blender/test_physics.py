"""Hulls in a physics engine: MuJoCo reads what the command line writes."""

import bpy
import numpy as np
import pytest
import shapes
from hand_made import mesh_object
from scipy.spatial import cKDTree
from weak_convex_decomposition.core.sampling import sample_surface
from weak_convex_decomposition.core.shapes import TriangleMesh
from weak_convex_decomposition.operators.command_line import main

mujoco = pytest.importorskip(
    "mujoco", reason="MuJoCo is missing; make test installs it"
)

ERROR = 0.05
SMALL = 0.03
MODELS = {
    "chair": shapes.chair,
    "mug": shapes.mug,
    "bowl": shapes.bowl,
    "dumbbell": shapes.dumbbell,
}


def simulated(tmp_path, name, loose):
    """Return a model on z = 0 in CoACD's units, and its hulls as MuJoCo reads them."""
    mesh = MODELS[name]()
    low, high = mesh.vertices.min(axis=0), mesh.vertices.max(axis=0)
    foot = np.r_[(low + high)[:2] / 2, low[2]]
    places = (mesh.vertices - foot) / ((high - low).max() / 2)
    mesh_object(name, places.tolist(), mesh.triangles.tolist())
    model, file = tmp_path / f"{name}.blend", tmp_path / f"{name}.xml"
    bpy.ops.wm.save_as_mainfile(filepath=str(model), copy=True)
    words = [model, "--hulls", file, "--samples=200", "--parts=4", "--quiet"]
    assert main([str(word) for word in words]) == 0
    spec = mujoco.MjSpec.from_file(str(file))
    if not loose:
        spec.delete(spec.worldbody.first_body().first_joint())
    return TriangleMesh(places, mesh.triangles, mesh.polygons), spec


def run(spec, seconds):
    model = spec.compile()
    data = mujoco.MjData(model)
    mujoco.mj_step(model, data, int(seconds / model.opt.timestep))
    assert np.isfinite(data.qpos).all()
    return data


def add_floor(spec):
    spec.worldbody.add_geom(type=mujoco.mjtGeom.mjGEOM_PLANE, size=[9, 9, 1])


def add_ball(spec, place, radius, name):
    """Add a ball that meets hulls and no other ball."""
    body = spec.worldbody.add_body(pos=place, name=name)
    body.add_geom(
        type=mujoco.mjtGeom.mjGEOM_SPHERE, size=[radius, 0, 0], contype=2, conaffinity=1
    )
    return body


@pytest.mark.parametrize("name", ["chair", "mug", "dumbbell"])
def test_compounds_come_to_rest(tmp_path, name):
    _, spec = simulated(tmp_path, name, loose=True)
    add_floor(spec)
    body = spec.worldbody.first_body()
    body.pos, body.quat = (0, 0, 0.2), (0.99, 0.1, 0.1, 0)
    n_hulls = len(spec.geoms) - 1
    data = run(spec, 4)
    assert n_hulls >= 2
    assert np.abs(data.qvel).max() < 0.02
    assert data.ncon >= 3
    assert -0.05 < data.qpos[2] < 1.5
    assert min(contact.dist for contact in data.contact) > -0.01


@pytest.mark.parametrize("name", ["chair", "mug", "dumbbell"])
def test_small_balls_rest_on_the_surface(tmp_path, name):
    mesh, spec = simulated(tmp_path, name, loose=False)
    low, high = mesh.vertices.min(axis=0), mesh.vertices.max(axis=0)
    spots = np.linspace(low[:2], high[:2], 8)[1:-1]
    for x in spots[:, 0]:
        for y in spots[:, 1]:
            ball = add_ball(spec, (x, y, high[2] + 0.1), SMALL, f"{x} {y}")
            # On rails: what rolls off tells nothing.
            ball.add_joint(type=mujoco.mjtJoint.mjJNT_SLIDE, axis=[0, 0, 1])
    data = run(spec, 1.5)
    samples = sample_surface(mesh, 20000, np.random.default_rng(0))
    balls = data.xpos[-(len(spots) ** 2) :]
    balls = balls[balls[:, 2] > low[2]]  # others fell past the model
    assert len(balls) > 10
    away, nearest = cKDTree(samples.positions).query(balls)
    ahead = (balls - samples.positions[nearest]) * samples.normals[nearest]
    gaps = np.where(ahead.sum(axis=1) < 0, -away, away) - SMALL
    assert np.abs(gaps).max() < ERROR


@pytest.mark.parametrize(("name", "floor"), [("bowl", 0.08), ("mug", 0.12)])
def test_vessels_hold_a_ball(tmp_path, name, floor):
    mesh, spec = simulated(tmp_path, name, loose=False)
    radius, rim = 0.3, mesh.vertices[:, 2].max()
    inside = 0.0 if name == "bowl" else 0.5 * (mesh.vertices[:, 0].min() + 0.7)
    ball = add_ball(spec, (inside, 0, rim + radius), radius, "ball")
    ball.add_freejoint()
    data = run(spec, 2)
    assert data.qpos[2] == pytest.approx(radius + floor, abs=0.12)
