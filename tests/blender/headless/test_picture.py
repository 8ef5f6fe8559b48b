import bpy
import numpy as np
import pytest
from hand_made import bands, decomposition_of, mesh_object
from weak_convex_decomposition.core.parameters.parts import Parameters
from weak_convex_decomposition.operators.bridge.parts.write import write_parts
from weak_convex_decomposition.operators.headless.write import picture, picture_scene
from weak_convex_decomposition.operators.headless.write.render_engine import EngineTrial

SIZE = 160
ENGINES = pytest.mark.parametrize("engine", ["BLENDER_WORKBENCH", "CYCLES"])


@pytest.fixture(scope="module", autouse=True)
def workbench():
    """Skip where Workbench would end the process."""
    if EngineTrial().engine() != "BLENDER_WORKBENCH":
        pytest.skip("Workbench cannot render here")


@pytest.fixture(autouse=True)
def small(monkeypatch):
    monkeypatch.setattr(picture, "SIZE", SIZE)


def block(size, location=(0, 0, 0)):
    corners = [(x, y, z) for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)]
    faces = [
        (0, 1, 3, 2),
        (4, 6, 7, 5),
        (0, 4, 5, 1),
        (2, 3, 7, 6),
        (0, 2, 6, 4),
        (1, 5, 7, 3),
    ]
    obj = mesh_object("block", np.array(corners) * size, faces)
    obj.location = location
    bpy.context.view_layer.update()
    return obj


def render(path, objects, engine="BLENDER_WORKBENCH"):
    """Return the two views, (2, height, width, 3), as numbers in 0…1."""
    picture.save_picture(path, objects, engine)
    image = bpy.data.images.load(str(path))
    pixels = np.array(image.pixels[:]).reshape(SIZE, 2, SIZE, 4).swapaxes(0, 1)
    bpy.data.images.remove(image)
    assert (pixels[..., 3] == 1.0).all()
    return pixels[..., :3]


def shows(view):
    """Return which pixels show something else than the background."""
    return np.abs(view - view[0, 0]).max(axis=-1) > 0.02


@ENGINES
def test_parts_have_their_colors_in_both_views(tmp_path, suzanne, engine):
    write_parts(suzanne, decomposition_of(bands(suzanne, 3)), Parameters())
    for view in render(tmp_path / "a.png", [suzanne], engine):
        lit = view[shows(view)]
        directions = lit / np.linalg.norm(lit, axis=1, keepdims=True)
        for part in range(3):
            linear = np.array(suzanne.wcd_parts[part].color[:3])
            color = np.where(
                linear < 0.0031, 12.92 * linear, 1.055 * linear**0.417 - 0.055
            )
            alike = directions @ (color / np.linalg.norm(color)) > 0.96
            assert alike.mean() > 0.01


FRAMED = [
    ("CYCLES", (1, 1, 1), (0, 0, 0)),
    ("BLENDER_WORKBENCH", (1, 1, 1), (0, 0, 0)),
    ("BLENDER_WORKBENCH", (20, 0.2, 0.2), (0, 0, 0)),
    ("BLENDER_WORKBENCH", (0.2, 20, 0.2), (5, 5, 5)),
    ("BLENDER_WORKBENCH", (0.2, 0.2, 20), (0, 0, 0)),
    ("BLENDER_WORKBENCH", (9, 9, 0.01), (0, 0, 0)),
    ("BLENDER_WORKBENCH", (0.001, 0.002, 0.001), (3, 0, 0)),
    ("BLENDER_WORKBENCH", (1e4, 2e4, 1e4), (0, 0, 3e4)),
]


@pytest.mark.parametrize(("engine", "size", "location"), FRAMED)
def test_the_whole_object_fills_the_frame(tmp_path, engine, size, location):
    for view in render(tmp_path / "a.png", [block(size, location)], engine):
        shown = shows(view)
        rows, columns = (
            np.nonzero(shown.any(axis=1))[0],
            np.nonzero(shown.any(axis=0))[0],
        )
        assert min(rows[0], columns[0]) >= 2
        assert max(rows[-1], columns[-1]) <= SIZE - 3
        assert max(np.ptp(rows), np.ptp(columns)) > 0.85 * SIZE


def test_several_objects_are_all_in_frame(tmp_path):
    objects = [block((1, 1, 1)), block((1, 1, 1), (8, 0, 0))]
    view = render(tmp_path / "a.png", objects)[0]
    columns = shows(view).any(axis=0)
    edges = np.count_nonzero(np.diff(columns.astype(int)) > 0)
    assert edges == 2
    assert not columns[[0, -1]].any()


def test_hidden_objects_and_cameras_of_the_file_do_not_matter(tmp_path):
    obj = block((1, 1, 1))
    plain = render(tmp_path / "a.png", [obj])
    obj.hide_render = True
    camera = bpy.data.objects.new("Camera", bpy.data.cameras.new("Camera"))
    bpy.context.scene.collection.objects.link(camera)
    bpy.context.scene.camera = camera
    bpy.context.scene.render.resolution_percentage = 10
    assert np.abs(render(tmp_path / "b.png", [obj]) - plain).max() < 0.02


def test_the_file_stays_as_it_was(tmp_path, suzanne):
    def blocks():
        return {
            (kind, block.name)
            for kind in ("objects", "meshes", "scenes", "cameras", "lights", "worlds")
            for block in getattr(bpy.data, kind)
        }

    before, scene = blocks(), bpy.context.scene
    render(tmp_path / "a.png", [suzanne])
    assert blocks() == before
    assert bpy.context.scene == scene
    assert [file.name for file in tmp_path.iterdir()] == ["a.png"]


def test_nodes_may_have_names_in_another_language():
    scene = bpy.data.scenes.new("Picture")
    scene.world = bpy.data.worlds.new("Picture")
    if scene.world.node_tree is None:  # Blender 5.0 makes nodes at once
        scene.world.use_nodes = True
    node = scene.world.node_tree.nodes["Background"]
    node.name = "Hintergrund"
    lamp = bpy.data.objects.new("Lamp", bpy.data.lights.new("Lamp", "SUN"))
    scene.collection.objects.link(lamp)
    picture_scene.set_up_engine(scene, "CYCLES")
    assert node.inputs["Color"].default_value[0] == pytest.approx(0.6)


def test_cycles_takes_over_where_workbench_ends_the_process(monkeypatch, tmp_path):
    # The loader of OpenGL drivers then finds none.
    monkeypatch.setenv("__EGL_VENDOR_LIBRARY_FILENAMES", str(tmp_path / "none"))
    monkeypatch.delenv("DISPLAY", raising=False)
    assert EngineTrial().engine() == "CYCLES"
