"""Writes collision hulls: .glb .obj .stl .usd, and .urdf .xml for simulators."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from pathlib import Path

import bpy

from ....core.parameters.bodies import BodyParameters
from ..files.output_folders import replacing_with_folder
from ..files.replacing import explaining, replacing
from ..formats import GLTF, SIMULATOR_ENDINGS, axes, enable, up_in
from ..quiet import quiet_blender
from ..shear import shear_in_meshes, without_parents
from .collider_marks import mark_glb
from .names import names_of_hulls
from .obj_files import write_hulls_obj
from .one_scene import one_scene
from .simulators.bodies import bodies_of, names_of_collisions, write_meshes
from .simulators.mjcf import write_mjcf
from .simulators.small_hulls import small_hull_notes
from .simulators.urdf import write_urdf
from .usd_files import write_usd


def save_hulls(
    path: Path,
    hulls: Sequence[bpy.types.Object],
    up: str | None,
    parameters: BodyParameters,
) -> tuple[str, ...]:
    """Write hulls to `path` in the format of its ending.

    For simulators each mesh becomes an .obj file in a folder beside `path`, and `path`
    refers to them. The folder is that of `replacing_with_folder`.

    Parameters
    ----------
    path : Path
        File with one of `HULL_ENDINGS`.
    hulls : sequence of Object
        Children of their objects.
    up : {'Y', 'Z'} or None
        Axis that points up in .obj and .stl; None for the usual one of the format.
    parameters : BodyParameters
        For simulators.

    Returns
    -------
    tuple of str
        Sentences to the user.

    Raises
    ------
    DecompositionError
        If the files cannot be written.
    """
    ending = path.suffix.lower()
    bpy.context.view_layer.update()
    with explaining(path, "written"):
        if ending in SIMULATOR_ENDINGS:
            with replacing_with_folder(path) as (unfinished, folder):
                return _save_bodies(unfinished, folder, hulls, parameters)
        with replacing(path) as unfinished:
            _EXPORTERS[ending](unfinished, hulls, up_in(ending, up))
    return ()


def names_in_file(
    ending: str, hulls: Sequence[bpy.types.Object], parameters: BodyParameters
) -> list[str]:
    """Return the name of each hull in a file that `save_hulls` writes.

    Parameters
    ----------
    ending : str
        One of `HULL_ENDINGS`.
    hulls : sequence of Object
        All that are in the file, children of their objects.
    parameters : BodyParameters
        For simulators.
    """
    if ending in SIMULATOR_ENDINGS:
        return names_of_collisions(hulls, parameters)
    if ending in _FORMS:
        return names_of_hulls(hulls, _FORMS[ending])
    return [hull.name for hull in hulls]


def _save_bodies(
    path: Path,
    folder: Path,
    hulls: Sequence[bpy.types.Object],
    parameters: BodyParameters,
) -> tuple[str, ...]:
    """Write bodies to `path`, and their meshes to `folder`."""
    urdf = path.suffix.lower() == ".urdf"
    # Robots are named by their file; "base" is what URDF calls a link without a joint.
    bodies, notes = bodies_of(hulls, "base" if urdf else path.stem, parameters)
    write_meshes(folder, bodies)
    if urdf:
        each = parameters.bodies == "EACH"
        write_urdf(path, bodies, folder.name, each)
    else:
        write_mjcf(path, bodies, folder.name)
    return (*notes, *small_hull_notes(bodies, urdf))


def _glb(path: Path, hulls: Sequence[bpy.types.Object], _up: str) -> None:
    """Export .glb with colliders."""
    enable(GLTF)
    with (
        quiet_blender(),
        shear_in_meshes(hulls),
        without_parents(hulls),
        one_scene(hulls),
    ):
        select_only(hulls)
        bpy.ops.export_scene.gltf(
            filepath=str(path),
            export_format="GLB",
            use_selection=True,
            use_active_scene=True,
            export_materials="NONE",
            # Flat normals would copy each vertex for each of its faces.
            export_normals=False,
            export_extras=True,
            export_animations=False,
            export_current_frame=True,
        )
    mark_glb(path, len(hulls))


def _stl(path: Path, hulls: Sequence[bpy.types.Object], up: str) -> None:
    """Export .stl."""
    # Hulls are hidden in renders, and Blender 5.2 and later write what is rendered.
    known = bpy.ops.wm.stl_export.get_rna_type().properties
    mode = (
        {"evaluation_mode": "DAG_EVAL_VIEWPORT"} if "evaluation_mode" in known else {}
    )
    with quiet_blender(), one_scene(hulls):
        select_only(hulls)
        bpy.ops.wm.stl_export(
            filepath=str(path), export_selected_objects=True, **axes(up), **mode
        )


def _usd(path: Path, hulls: Sequence[bpy.types.Object], _up: str) -> None:
    """Write .usd with colliders."""
    write_usd(path, [], hulls)


def select_only(objects: Sequence[bpy.types.Object]) -> None:
    """Select objects and nothing else: exporters write what is selected."""
    chosen = set(objects)
    for obj in bpy.context.view_layer.objects:
        obj.select_set(obj in chosen)


# How names are made legal, by ending; other formats take any name.
_FORMS = {".obj": "obj", ".usd": "usd"}
_EXPORTERS: dict[str, Callable[[Path, Sequence[bpy.types.Object], str], None]] = {
    ".glb": _glb,
    ".obj": write_hulls_obj,
    ".stl": _stl,
    ".usd": _usd,
}
