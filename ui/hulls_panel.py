"""The panel on collision hulls."""

from __future__ import annotations

import re
from collections.abc import Sequence
from os.path import commonprefix
from typing import Any, ClassVar

import bpy

from ..operators.settings import HULLS, draw, other_error
from ..operators.viewport.shown_figures import is_of_now, shown_figures
from .sidebar import (
    OUT_OF_DATE,
    Sidebar,
    draw_choices,
    hull_rows_of,
    in_powers,
    line,
    result_of,
    width_of,
)

# Letters of an error that its column has room for; and the width of the sidebar, at
# interface scale 1, below which there is no room for numbers of vertices beside it.
_LETTERS = 7
_WITH_VERTICES = 265
# Share of the width of a row, without its buttons, for the color.
_SWATCH = 0.14


class WCD_PT_hulls(Sidebar, bpy.types.Panel):
    """Collision hulls: settings, button and result."""

    bl_label = "Collision Hulls"
    bl_parent_id = "WCD_PT_main"
    bl_options: ClassVar[set[str]] = {"DEFAULT_CLOSED"}

    def draw(self, context: bpy.types.Context) -> None:
        """Draw the panel."""
        layout = self.layout
        settings = context.scene.wcd
        draw(layout, settings, HULLS)
        obj = context.active_object
        figures = shown_figures(obj)
        if settings.pieces == "PARTS" and figures:
            _shapes_of_parts(layout, obj, {each.number for each in figures.identities})
        draw(layout, settings, ("look",))
        other = other_error(settings, obj) if obj else None
        if other:
            line(layout, *other)
        layout.operator("wcd.build_hulls", text="Build Hulls", icon="MESH_CUBE")
        hulls = hull_rows_of(obj) if obj else []
        if not hulls:
            return
        result = result_of(obj)["hulls"]
        current = is_of_now(obj, result)
        largest = f"{max(hull['error'] for hull in hulls):.3g}"
        line(layout, "Largest Error", largest if current else OUT_OF_DATE)
        complete = current and len(hulls) == len(result["hulls"])
        if result["volume_ratio"] and complete:
            line(layout, "Volume Ratio", f"{result['volume_ratio']:.2f}")
        draw_choices(layout, "wcd.make_rigid", "kind", icon="PHYSICS")
        layout.operator("wcd.remove_hulls", text="Remove Hulls", icon="TRASH")
        _list_hulls(layout, hulls, current, width_of(context))


def _shapes_of_parts(
    layout: bpy.types.UILayout, obj: bpy.types.Object, here: set[int]
) -> None:
    """Draw the choice of a shape for each part that has faces."""
    column = layout.column(align=True)
    for row in obj.wcd_parts:
        if row.number in here:
            column.prop(row, "hull_shape", text=row.name, translate=False)


def _list_hulls(
    layout: bpy.types.UILayout,
    hulls: Sequence[dict[str, Any]],
    current: bool,
    width: float,
) -> None:
    """Draw the list of hulls; their errors only if these are `current`."""
    box = layout.box().column(align=True)
    heading = box.row(align=True)
    n_figures = 2 if width >= _WITH_VERTICES else 1
    _columns(heading.split(factor=_SWATCH), "Hull", ("Verts", "Error")[-n_figures:])
    for _ in range(2):  # room for the buttons of the rows below
        heading.label(text="", icon="BLANK1")
    names = [hull["name"] for hull in hulls]
    for hull, name in zip(hulls, endings(names), strict=True):
        figures = str(hull["vertices"]), error_text(hull["error"]) if current else "–"
        row = box.row(align=True)
        material = worn(hull["object"])
        _columns(row.split(factor=_SWATCH), name, figures[-n_figures:], material)
        shape = row.operator_menu_enum(
            "wcd.refit_hull", "shape", text="", icon="MESH_CUBE"
        )
        shape.hull = hull["name"]
        remove = row.operator("wcd.remove_hull", text="", icon="X", emboss=False)
        remove.hull = hull["name"]


def error_text(error: float) -> str:
    """Return the text for the error of a hull, which may be any length in the scene."""
    text = f"{error:.3g}"
    is_short = len(text) <= _LETTERS and "e" not in text
    return text if is_short else in_powers(error, 1)


def worn(hull: bpy.types.Object) -> bpy.types.Material | None:
    """Return the material that a hull is seen in, None if it has none."""
    return next((slot.material for slot in hull.material_slots), None)


def endings(names: Sequence[str]) -> list[str]:
    """Return names without the beginning that all share; there is no room for it."""
    if len(names) < 2:
        return list(names)
    shared = commonprefix(names)  # noqa: RUF071  # letters are meant, not folders
    start = len(re.sub(r"\w*$", "", shared.replace("_", " ")))
    return [name[start:] for name in names]


def _columns(
    split: bpy.types.UILayout,
    name: str,
    figures: Sequence[str],
    material: bpy.types.Material | None = None,
) -> None:
    """Draw the columns of a row of the list of hulls, or of its heading.

    The color is only shown: other things may have the same material, and a part gets
    its color in the list of parts.
    """
    swatch = split.row()
    swatch.enabled = False
    if material is None:
        swatch.label(text="")
    else:
        swatch.prop(material, "diffuse_color", text="")
    split = split.split(factor=0.34)
    split.label(text=name, translate=False)
    numbers = split.split(factor=0.46) if figures[1:] else split
    for text in figures:
        cell = numbers.row()
        cell.alignment = "RIGHT"
        cell.label(text=text, translate=False)
