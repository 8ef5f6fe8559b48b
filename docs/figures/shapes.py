"""Make gallery.png, the picture of the README, from shapes made on the spot.

    python .pictures/make_gallery.py

Suzanne is Blender's own primitive; the others are metaballs, a skin modifier and
boxes. The command line decomposes and renders them.
"""

import subprocess
import sys
import tempfile
from pathlib import Path

import bpy
import numpy as np

HERE = Path(__file__).resolve().parent
SIDE = 440  # pixels of a view in the gallery
TOWARDS_CAMERA = 0.4  # radians: the camera stands to the right of the front
# Elements of the bear: center and radius; mirrored ones have both signs of x.
BEAR = [
    ((0, 0, 0), 2.1),
    ((0, -0.1, 2.2), 1.8),
    ((0, -1.1, 2.0), 0.8),
    *(((s * 1.0, 0, 3.15), 0.9) for s in (-1, 1)),
    *(
        ((s * (1.3 + t), -0.3 * t, 0.6 - 0.1 * t), 0.8)
        for s in (-1, 1)
        for t in (0, 0.6, 1.2)
    ),
    *(
        ((s * (0.8 + 0.2 * t), -0.6 * t, -1.1 - t), 0.95)
        for s in (-1, 1)
        for t in (0, 0.7, 1.4)
    ),
]
# Joints of the dog: place and radius of the skin; then its bones.
DOG = {
    "hip": ((0, 1.3, 0), 0.5),
    "chest": ((0, -1.0, 0.1), 0.55),
    "neck": ((0, -1.7, 0.9), 0.3),
    "head": ((0, -1.9, 1.35), 0.45),
    "nose": ((0, -2.8, 1.2), 0.22),
    "tail": ((0, 2.1, 0.6), 0.16),
    "tip": ((0, 2.6, 1.3), 0.1),
}
BONES = ["hip chest", "chest neck", "neck head", "head nose", "hip tail", "tail tip"]
# Boxes of the chair: center and size.
CHAIR = [
    ((0, 0, 0), (2, 2, 0.3)),
    ((0, 0.85, 1.35), (2, 0.3, 2.6)),
    *(((x, y, -1.1), (0.3, 0.3, 2.1)) for x in (-0.8, 0.8) for y in (-0.8, 0.8)),
]


def suzanne() -> None:
    """Make Blender's monkey with two subdivisions."""
    bpy.ops.mesh.primitive_monkey_add(rotation=(0, 0, TOWARDS_CAMERA))
    subdivide(2)


def bear() -> None:
    """Make a bear of metaballs."""
    ball = bpy.data.metaballs.new("bear")
    ball.resolution = ball.render_resolution = 0.09
    for center, radius in BEAR:
        element = ball.elements.new()
        element.co, element.radius = center, radius
    add(ball).rotation_euler.z = TOWARDS_CAMERA
    bpy.ops.object.convert(target="MESH")


def dog() -> None:
    """Make a dog of bones and a skin modifier."""
    joints, bones = dict(DOG), [tuple(bone.split()) for bone in BONES]
    for x in (-0.7, 0.7):
        for end, y in (("hip", 1.4), ("chest", -1.1)):
            knee, paw = f"{end} {x} knee", f"{end} {x} paw"
            joints[knee] = ((x * 0.75, y, -0.55), 0.24)
            joints[paw] = ((x, y, -2.0), 0.2)
            bones += [(end, knee), (knee, paw)]
    names = list(joints)
    mesh = bpy.data.meshes.new("dog")
    edges = [(names.index(a), names.index(b)) for a, b in bones]
    mesh.from_pydata([joints[name][0] for name in names], edges, [])
    obj = add(mesh)
    obj.modifiers.new("Skin", "SKIN").use_smooth_shade = False
    for vertex, name in zip(mesh.skin_vertices[0].data, names, strict=True):
        vertex.radius = (joints[name][1],) * 2
    mesh.skin_vertices[0].data[0].use_root = True
    subdivide(3)
    bpy.ops.object.modifier_apply(modifier="Skin")


def chair() -> None:
    """Make a chair of boxes that run into each other."""
    for center, size in CHAIR:
        bpy.ops.mesh.primitive_cube_add(size=1, location=center, scale=size)
    bpy.ops.object.select_all(action="SELECT")
    bpy.ops.object.join()
    bpy.ops.object.mode_set(mode="EDIT")
    bpy.ops.mesh.select_all(action="SELECT")
    bpy.ops.mesh.subdivide(number_cuts=11)
    bpy.ops.object.mode_set(mode="OBJECT")


def add(data: bpy.types.ID) -> bpy.types.Object:
    """Return a new active object for `data`."""
    obj = bpy.data.objects.new(data.name, data)
    bpy.context.collection.objects.link(obj)
    bpy.context.view_layer.objects.active = obj
    obj.select_set(True)
    return obj


def subdivide(levels: int) -> None:
    """Subdivide the active object when it is exported."""
    modifier = bpy.context.object.modifiers.new("Subdivision", "SUBSURF")
    modifier.levels = modifier.render_levels = levels


def pixels(path: Path) -> np.ndarray:
    """Return the left view of a picture, (SIDE, SIDE, 4)."""
    image = bpy.data.images.load(str(path))
    image.scale(2 * SIDE, SIDE)
    return np.array(image.pixels, np.float32).reshape(SIDE, 2 * SIDE, 4)[:, :SIDE]


def main() -> None:
    """Make the shapes, have them decomposed, and put the pictures side by side."""
    with tempfile.TemporaryDirectory() as name:
        folder, inputs = Path(name), []
        for make in (suzanne, bear, dog, chair):
            bpy.ops.wm.read_factory_settings(use_empty=True)
            make()
            inputs.append(folder / f"{make.__name__}.obj")
            bpy.ops.wm.obj_export(filepath=str(inputs[-1]), export_materials=False)
        picture = folder / "{name}.png"
        subprocess.run(
            [sys.executable, HERE.parent, *inputs, "--picture", picture], check=True
        )
        row = np.hstack([pixels(path.with_suffix(".png")) for path in inputs])
    image = bpy.data.images.new("gallery", row.shape[1], row.shape[0])
    image.pixels.foreach_set(row.ravel())
    image.filepath_raw = str(HERE / "gallery.png")
    image.file_format = "PNG"
    image.save()


if __name__ == "__main__":
    main()
