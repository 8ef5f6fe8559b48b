"""Writes the model with its parts, and its hulls: .blend .glb .ply .obj .usd .fbx."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path

import bpy

from ...bridge.refusals import CONVERTIBLE
from ..files.claims import check_companion, companion_of
from ..files.replacing import explaining, replacing
from ..files.whole import check_obj
from ..formats import GLTF, axes, enable, up_in
from ..quiet import quiet_blender
from ..shear import in_their_places
from .collider_marks import mark_glb
from .fbx_files import write_fbx
from .obj_files import restore_digits
from .one_scene import one_scene, written_meshes
from .painted_copies import clouds_without_parts, painted_clouds, ply_copies
from .usd_files import write_usd

# Blender 4.2 crashes if it writes curves to .obj without modifiers.
_CRASHES_ON_CURVES = bpy.app.version < (5, 0, 0)


def save(
    path: Path, up: str | None, hulls: Sequence[bpy.types.Object] = ()
) -> tuple[str, ...]:
    """Write the scene to `path` in the format of its ending.

    An existing file is replaced once the new one is complete.

    Parameters
    ----------
    path : Path
        File with one of `MODEL_ENDINGS`.
    up : {'Y', 'Z'} or None
        Axis that points up in .obj and .ply; None for the usual one of the format.
    hulls : sequence of Object, optional
        Hulls in the scene, which belong into the file.

    Returns
    -------
    tuple of str
        Sentences to the user.

    Raises
    ------
    DecompositionError
        If the file cannot be written.
    """
    ending = path.suffix.lower()
    companion = companion_of(path, is_model=True)
    companions = [companion] if companion else []
    bpy.context.view_layer.update()
    notes = clouds_without_parts(ending)
    with explaining(path, "written"):
        if companion:
            check_companion(path, companion)
        with replacing(path, *companions) as unfinished, quiet_blender():
            if ending in _WITH_HULLS:
                _WITH_HULLS[ending](unfinished, hulls)
            else:
                _EXPORTERS[ending](unfinished, up_in(ending, up))
            if companion:
                _name_materials(unfinished, companion.name)
    return notes


def _name_materials(unfinished: Path, name: str) -> None:
    """Give the .mtl file its final name in an .obj file."""
    text = unfinished.read_bytes()
    before = f"mtllib {unfinished.stem}.mtl".encode()
    unfinished.write_bytes(text.replace(before, b"mtllib " + os.fsencode(name), 1))


def _blend(path: Path, _hulls: Sequence[bpy.types.Object]) -> None:
    """Save a copy as .blend; hulls are in the scene."""
    bpy.ops.wm.save_as_mainfile(filepath=str(path), copy=True)


def _glb(path: Path, hulls: Sequence[bpy.types.Object]) -> None:
    """Export .glb; hulls are marked as colliders."""
    enable(GLTF)
    # The extras hold the record, which is the custom property "wcd" of each object.
    with (
        _smooth(hulls),
        one_scene(hulls) as objects,
        in_their_places(objects),
        painted_clouds() as with_points,
    ):
        bpy.ops.export_scene.gltf(
            filepath=str(path),
            export_format="GLB",
            export_extras=True,
            use_active_scene=True,
            use_mesh_vertices=with_points,
            export_attributes=with_points,
            # Hulls, in this file or another one, are around what is seen now; but
            # around skins as they are at rest.
            export_current_frame=True,
            export_rest_position_armature=not any(
                obj.parent_type == "BONE" for obj in objects
            ),
        )
    if hulls:
        mark_glb(path, len(hulls))


@contextmanager
def _smooth(hulls: Sequence[bpy.types.Object]) -> Iterator[None]:
    """Shade hulls smooth while they are written, flat again at the end.

    Flat faces have normals of their own: .glb would have a vertex for each corner.
    """
    meshes = {hull.data for hull in hulls}
    for mesh in meshes:
        mesh.shade_smooth()
    try:
        yield
    finally:
        for mesh in meshes:
            mesh.shade_flat()


def _usd(path: Path, hulls: Sequence[bpy.types.Object]) -> None:
    """Write .usd."""
    write_usd(path, written_meshes(), hulls)


def _obj(path: Path, up: str) -> None:
    """Export .obj."""
    with one_scene():
        if _CRASHES_ON_CURVES:
            _leave_out_curves()
        # Parts belong to the faces without modifiers.
        bpy.ops.wm.obj_export(
            filepath=str(path),
            apply_modifiers=False,
            export_material_groups=True,
            **axes(up),
        )
        # Others than these are written too, such as curves.
        meshes = [obj for obj in bpy.context.scene.objects if obj.type == "MESH"]
        check_obj(path, sum(len(obj.data.polygons) for obj in meshes))
        restore_digits(path, up)


def _leave_out_curves() -> None:
    """Leave curves, texts and their like out of the scene of exporters."""
    objects = bpy.context.scene.collection.objects
    for obj in [each for each in objects if each.type in CONVERTIBLE]:
        objects.unlink(obj)


def _ply(path: Path, up: str) -> None:
    """Export .ply with colors on the vertices."""
    with ply_copies() as with_uv:
        bpy.ops.wm.ply_export(
            filepath=str(path),
            apply_modifiers=False,
            export_selected_objects=True,
            export_uv=with_uv,
            export_colors="SRGB",
            **axes(up),
        )


_EXPORTERS: dict[str, Callable[[Path, str], None]] = {".ply": _ply, ".obj": _obj}
# One for each of `HULLS_WITHIN_ENDINGS`.
_WITH_HULLS: dict[str, Callable[[Path, Sequence[bpy.types.Object]], None]] = {
    ".blend": _blend,
    ".glb": _glb,
    ".usd": _usd,
    ".fbx": write_fbx,
}
