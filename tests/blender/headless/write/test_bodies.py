"""Bodies for simulators: their masses and names; they fall and rest."""

import xml.etree.ElementTree as ET
from pathlib import Path

import bpy
import mujoco
import numpy as np
import pytest
import trimesh
from hand_made import add_ring, build_hulls
from headless import simulation
from headless.command import run_wcd
from weak_convex_decomposition.core.parameters.bodies import BodyParameters
from weak_convex_decomposition.operators.headless.write.hull_files import save_hulls
from weak_convex_decomposition.operators.headless.write.placed_meshes import (
    matrix_of,
    placed,
)

DENSITY = 2700.0
SECONDS = 20
FILES = [f"{bodies}.{kind}" for bodies in ("one", "each") for kind in ("xml", "urdf")]


def add_block():
    """Add a turned block with a name that is legal only in some formats."""
    bpy.ops.mesh.primitive_cube_add(location=(-1, 0, 0.5), rotation=(0.1, 0.4, 0))
    block = bpy.context.active_object
    block.name, block.scale = "world", (0.2, 0.3, 0.4)
    return block


@pytest.fixture(scope="module")
def scene(registered, tmp_path_factory):
    """Return a folder with `FILES` and the solids of trimesh, in the world."""
    folder = tmp_path_factory.mktemp("bodies")
    objects = [add_ring('A "b"/é'), add_block()]
    hulls = build_hulls(objects, max_error=0.1)
    for name in FILES:
        parameters = BodyParameters(DENSITY, Path(name).stem.upper())
        assert save_hulls(folder / name, hulls, "Z", parameters) == ()
    return folder, [solid_of(obj) for obj in objects]


def solid_of(obj):
    """Return an object as trimesh has it."""
    vertices, triangles, _ = placed(obj, matrix_of(obj))
    solid = trimesh.Trimesh(vertices, triangles, process=False)
    solid.density = DENSITY
    assert solid.is_volume
    return solid


def loaded(path):
    """Return the spec of a file; one URDF link gets the joint that it has nowhere."""
    spec = mujoco.MjSpec.from_file(str(path))
    if path.name == "one.urdf":
        spec.worldbody.first_body().add_freejoint()
    return spec


@pytest.mark.parametrize("name", FILES)
def test_masses_are_those_of_the_solids(scene, name):
    folder, solids = scene
    if name.startswith("one"):
        solids = [trimesh.util.concatenate(solids)]
        solids[0].density = DENSITY
    found = list(simulation.placed_masses(loaded(folder / name)))
    assert len(found) == len(solids)
    for (mass, center, inertia), solid in zip(found, solids, strict=True):
        expected = solid.mass_properties
        assert mass == pytest.approx(expected["mass"], rel=1e-5)
        assert center == pytest.approx(expected["center_mass"], abs=1e-5)
        top = np.abs(expected["inertia"]).max()
        assert inertia == pytest.approx(expected["inertia"], abs=1e-5 * top)


@pytest.mark.parametrize("name", FILES)
def test_bodies_fall_and_rest(scene, name):
    spec = loaded(scene[0] / name)
    floor = spec.worldbody.add_geom(type=mujoco.mjtGeom.mjGEOM_PLANE, size=[9, 9, 1])
    floor.pos, floor.condim, floor.friction = (0, 0, -1), 6, (1, 0.01, 0.01)
    model = spec.compile()
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    start = data.xipos[1:, 2].copy()
    mujoco.mj_step(model, data, int(SECONDS / model.opt.timestep))
    assert (data.xipos[1:, 2] < start - 0.3).all()
    assert (data.xipos[1:, 2] > -1).all()
    assert np.abs(data.qvel).max() < 0.02
    assert model.nv == 6 * (model.nbody - 1)


def test_the_model_is_seen_and_does_not_touch(scene):
    folder, solids = scene
    model = loaded(folder / "each.xml").compile()
    geoms = [model.geom(number) for number in range(model.ngeom)]
    seen = [geom for geom in geoms if not (geom.contype[0] or geom.conaffinity[0])]
    assert {geom.group[0] for geom in seen} == {2}
    n_faces = sum(model.mesh_facenum[geom.dataid[0]] for geom in seen)
    assert n_faces == sum(len(solid.faces) for solid in solids)
    robot = ET.parse(folder / "each.urdf").getroot()
    files = [m.get("filename") for m in robot.findall(".//visual/geometry/mesh")]
    assert sum(len(trimesh.load(folder / file).faces) for file in files) == n_faces


def test_names_are_legal_and_distinct(scene):
    folder, _ = scene
    for name in FILES:
        root = ET.parse(folder / name).getroot()
        for kind in ("link", "body", "joint", "geom", "mesh", "collision", "visual"):
            names = [e.get("name") for e in root.iter(kind) if e.get("name")]
            assert len(set(names)) == len(names), (name, kind)
            assert not any(c in each for each in names for c in "/\"'<&"), names
    robot = ET.parse(folder / "each.urdf").getroot()
    links = [link.get("name") for link in robot.iter("link")]
    assert links == ["world", "A _b__é", "world_2"]


def test_open_surfaces_weigh_what_their_hulls_weigh(tmp_path):
    bpy.ops.mesh.primitive_cube_add(size=2)
    cube = bpy.context.active_object
    bpy.ops.object.mode_set(mode="EDIT")
    bpy.ops.mesh.select_all(action="DESELECT")
    bpy.ops.object.mode_set(mode="OBJECT")
    cube.data.polygons[0].select = True
    bpy.ops.object.mode_set(mode="EDIT")
    bpy.ops.mesh.delete(type="ONLY_FACE")
    bpy.ops.object.mode_set(mode="OBJECT")
    hulls = build_hulls([cube], max_hulls=1)
    (note,) = save_hulls(tmp_path / "a.xml", hulls, "Z", BodyParameters())
    assert "or encloses nothing: Cube" in note
    ((mass, center, _),) = simulation.placed_masses(loaded(tmp_path / "a.xml"))
    assert mass == pytest.approx(8000, rel=0.01)
    assert center == pytest.approx([0, 0, 0], abs=0.01)


@pytest.mark.parametrize(("place", "is_said"), [(0.5, True), (3.0, False)])
def test_shells_that_overlap_are_said_to_count_twice(tmp_path, place, is_said):
    for x in (0, place):
        bpy.ops.mesh.primitive_cube_add(location=(x, 0, 0))
    bpy.ops.object.select_all(action="SELECT")
    bpy.ops.object.join()
    pair = bpy.context.active_object
    hulls = build_hulls([pair])
    notes = save_hulls(tmp_path / "a.xml", hulls, "Z", BodyParameters())
    said = [f"count twice, so unite them first: {pair.name}." in note for note in notes]
    assert said == [True] * is_said


def test_what_is_too_light_is_said(tmp_path):
    block = add_block()
    block.scale = (1e-6,) * 3
    hulls = build_hulls([block])
    (note,) = save_hulls(tmp_path / "a.xml", hulls, "Z", BodyParameters())
    assert "too little for simulators" in note


def test_the_command_line_has_density_and_bodies(tmp_path, capsys):
    add_block().name = "block"
    bpy.ops.mesh.primitive_cube_add(location=(9, 0, 0))
    model = tmp_path / "two.blend"
    bpy.ops.wm.save_as_mainfile(filepath=str(model), copy=True)
    words = [
        model,
        "--hulls",
        tmp_path / "h.xml",
        "--samples=100",
        "--parts=2",
        "--quiet",
    ]
    assert run_wcd(*words, "--density=10", "--bodies=each") == 0
    masses = [
        mass for mass, _, _ in simulation.placed_masses(loaded(tmp_path / "h.xml"))
    ]
    assert sorted(masses) == pytest.approx([10 * 8 * 0.2 * 0.3 * 0.4, 80], rel=1e-5)
    assert run_wcd(*words, "--density=0") == 2
    assert "Density is 0" in capsys.readouterr().err


def test_a_face_whose_slot_is_gone_is_seen_too(tmp_path):
    block = add_block()
    block.data.materials.append(bpy.data.materials.new("Gold"))
    block.data.polygons[0].material_index = 3
    save_hulls(tmp_path / "a.xml", build_hulls([block]), "Z", BodyParameters())
    seen = trimesh.load(tmp_path / "a_xml" / "visual_001.obj")
    assert len(seen.faces) == 12


def test_no_material_is_as_gray_as_a_new_one(tmp_path):
    for material in (None, bpy.data.materials.new("Gray")):
        bpy.ops.mesh.primitive_cube_add()
        block = bpy.context.active_object
        block.data.materials.append(material)
    objects = bpy.data.objects[:]
    save_hulls(tmp_path / "a.xml", build_hulls(objects), "Z", BodyParameters())
    geoms = ET.parse(tmp_path / "a.xml").getroot().iter("geom")
    colors = [geom.get("rgba") for geom in geoms if geom.get("rgba")]
    assert len(colors) == 2
    for color in colors:  # 0.8 in sRGB
        expected = [0.9063317537] * 3 + [1.0]
        assert [float(word) for word in color.split()] == pytest.approx(expected)
