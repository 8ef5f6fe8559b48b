"""Hulls in a physics engine: compounds fall, balls rest on them and in them."""

from functools import cache

import numpy as np
import pytest
import shapes

mujoco = pytest.importorskip(
    "mujoco", reason="MuJoCo is missing; make test installs it"
)

from headless import simulation  # noqa: E402  # needs MuJoCo

ERROR = 0.05
MODELS = {
    "chair": shapes.chair,
    "mug": shapes.mug,
    "bowl": shapes.bowl,
    "dumbbell": shapes.dumbbell,
}


@pytest.fixture(scope="module")
def built(tmp_path_factory):
    """Return a function from "name.ending" to a model on the ground and its hulls."""

    @cache
    def found(file):
        mesh = simulation.on_the_ground(MODELS[file.partition(".")[0]]())
        return mesh, simulation.hull_file(tmp_path_factory.mktemp(file), file, mesh)

    return found


@pytest.mark.parametrize("name", ["chair", "mug", "dumbbell"])
def test_compounds_come_to_rest(built, name):
    _, file = built(f"{name}.xml")
    spec = simulation.in_mujoco(file, loose=True)
    assert len(simulation.hulls_in(spec)) >= 2
    data = simulation.dropped(spec, 4.5)
    assert np.abs(data.qvel).max() < 0.02
    assert -0.05 < data.qpos[2] < 1.5
    assert min(contact.dist for contact in data.contact) > -0.01
    # MuJoCo takes few points of a hull on a floor: their number tells little.
    before = data.qpos.copy()
    assert np.abs(simulation.go_on(data, 1).qpos - before).max() < 0.002
    assert data.body(1).xmat[8] > 0.999  # as it stood before it was tilted


@pytest.mark.parametrize("name", ["chair", "mug", "dumbbell"])
def test_small_balls_rest_on_the_surface(built, name):
    mesh, file = built(f"{name}.xml")
    spec = simulation.in_mujoco(file, loose=False)
    gaps = simulation.gaps_below_balls(mesh, spec)
    assert len(gaps) > 10
    assert np.abs(gaps).max() < ERROR


@pytest.mark.parametrize(("name", "floor"), [("bowl", 0.08), ("mug", 0.12)])
def test_vessels_hold_a_ball(built, name, floor):
    mesh, file = built(f"{name}.xml")
    spec = simulation.in_mujoco(file, loose=False)
    assert len(simulation.hulls_in(spec)) <= 32
    radius, rim = 0.3, mesh.vertices[:, 2].max()
    inside = 0.0 if name == "bowl" else 0.5 * (mesh.vertices[:, 0].min() + 0.7)
    ball = simulation.add_ball(spec, (inside, 0, rim + radius), radius, "ball")
    ball.add_freejoint()
    data = simulation.run(spec, 2)
    assert data.qpos[2] == pytest.approx(radius + floor, abs=0.12)


@pytest.mark.parametrize("ending", ["xml", "urdf"])
def test_simulators_read_names_and_places(built, ending):
    mesh, file = built(f"chair.{ending}")
    model = mujoco.MjModel.from_xml_path(str(file))
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    hulls = [n for n in range(model.ngeom) if model.geom_contype[n]]
    assert [model.geom(n).name for n in hulls] == [
        f"chair hull {n:02d}" for n in range(1, len(hulls) + 1)
    ]
    assert len(hulls) >= 2
    places = []
    for geom in hulls:
        start = model.mesh_vertadr[model.geom_dataid[geom]]
        count = model.mesh_vertnum[model.geom_dataid[geom]]
        turn = data.geom_xmat[geom].reshape(3, 3)
        local = model.mesh_vert[start : start + count]
        places.append(local @ turn.T + data.geom_xpos[geom])
    places = np.concatenate(places)
    low, high = mesh.vertices.min(axis=0), mesh.vertices.max(axis=0)
    assert places.min(axis=0) == pytest.approx(low, abs=0.02)
    assert places.max(axis=0) == pytest.approx(high, abs=0.02)
