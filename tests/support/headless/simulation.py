"""Hulls in a physics engine: MuJoCo reads what the command line writes."""

import bpy
import mujoco
import numpy as np
from hand_made import mesh_object
from scipy.spatial import cKDTree
from weak_convex_decomposition.core.geometry.mesh import TriangleMesh
from weak_convex_decomposition.core.geometry.sampling import sample_surface
from weak_convex_decomposition.operators.headless.quiet import quiet_blender

from .command import run_wcd

# Radius of the balls that rest on a surface.
SMALL = 0.03
# It lets them fall by one unit in a second.
_DAMPING = 1.0


def on_the_ground(mesh):
    """Return a mesh standing on z = 0, centered, in CoACD's units."""
    low, high = mesh.vertices.min(axis=0), mesh.vertices.max(axis=0)
    foot = np.r_[(low + high)[:2] / 2, low[2]]
    places = (mesh.vertices - foot) / ((high - low).max() / 2)
    return TriangleMesh(places, mesh.triangles, mesh.polygons)


def hull_file(folder, name, mesh, *words):
    """Return the file of a mesh's hulls, `name` in a folder."""
    file = folder / name
    model = file.with_suffix(".blend")
    with quiet_blender():
        bpy.ops.wm.read_homefile(use_factory_startup=True, use_empty=True)
        mesh_object(file.stem, mesh.vertices.tolist(), mesh.triangles.tolist())
        bpy.ops.wm.save_as_mainfile(filepath=str(model), copy=True)
    words = [model, "--hulls", file, "--samples=200", "--parts=4", "--quiet", *words]
    assert run_wcd(*words) == 0
    return file


def in_mujoco(file, *, loose):
    """Return what MuJoCo reads of a file of hulls: a body that may fall, or stays."""
    spec = mujoco.MjSpec.from_file(str(file))
    if not loose:
        spec.delete(spec.worldbody.first_body().first_joint())
    return spec


def hulls_in(spec):
    """Return the geoms that collide; the others are only seen."""
    return [geom for geom in spec.geoms if geom.group == 3]


def run(spec, seconds):
    """Return the state after so long."""
    return go_on(mujoco.MjData(spec.compile()), seconds)


def go_on(data, seconds):
    """Return the state so much later."""
    mujoco.mj_step(data.model, data, int(seconds / data.model.opt.timestep))
    assert np.isfinite(data.qpos).all()
    return data


def placed_masses(spec):
    """Return mass, center and inertia of each body in the world, by MuJoCo."""
    model = spec.compile()
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    for body in range(1, model.nbody):
        axes = data.ximat[body].reshape(3, 3)
        inertia = axes @ np.diag(model.body_inertia[body]) @ axes.T
        yield model.body_mass[body], data.xipos[body], inertia


def dropped(spec, seconds):
    """Return the state after a compound has fallen on a floor, tilted.

    The floor brakes what rolls, as real ones do: a round cup would never stop.
    """
    floor = spec.worldbody.add_geom(type=mujoco.mjtGeom.mjGEOM_PLANE, size=[9, 9, 1])
    floor.condim, floor.friction = 6, (1, 0.01, 0.01)
    body = spec.worldbody.first_body()
    body.pos, body.quat = (0, 0, 0.2), (0.99, 0.1, 0.1, 0)
    return run(spec, seconds)


def add_ball(spec, place, radius, name):
    """Add a ball that meets hulls and no other ball."""
    body = spec.worldbody.add_body(pos=place, name=name)
    body.add_geom(
        type=mujoco.mjtGeom.mjGEOM_SPHERE, size=[radius, 0, 0], contype=2, conaffinity=1
    )
    return body


def gaps_below_balls(mesh, spec):
    """Return how far above the surface small balls come to rest, below it negative.

    They fall along rails, as what rolls off tells nothing, and slowly: fast ones get
    so deep within one step that they are pushed aside, not out.
    """
    low, high = mesh.vertices.min(axis=0), mesh.vertices.max(axis=0)
    spots = np.linspace(low[:2], high[:2], 8)[1:-1]
    for x in spots[:, 0]:
        for y in spots[:, 1]:
            ball = add_ball(spec, (x, y, high[2] + 0.1), SMALL, f"{x} {y}")
            rail = ball.add_joint(type=mujoco.mjtJoint.mjJNT_SLIDE, axis=[0, 0, 1])
            rail.damping = _DAMPING
    data = run(spec, 3)
    samples = sample_surface(mesh, 20000, np.random.default_rng(0))
    balls = data.xpos[-(len(spots) ** 2) :]
    balls = balls[balls[:, 2] > low[2]]  # others fell past the model
    away, nearest = cKDTree(samples.positions).query(balls)
    ahead = (balls - samples.positions[nearest]) * samples.normals[nearest]
    return np.where(ahead.sum(axis=1) < 0, -away, away) - SMALL
