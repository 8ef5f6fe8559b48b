"""The panel on collision hulls."""

from __future__ import annotations

import re
from collections.abc import Sequence
from os.path import commonprefix
from typing import Any, ClassVar

import bpy

from ..operators.settings import HULL_RUN, HULLS, draw, hand_over, other_error
from .panels import line
from .shown_figures import shown_figures
from .sidebar import (
    OUT_OF_DATE,
    Sidebar,
    draw_choices,
    hulls_of,
    hulls_of_now,
    result_of,
)


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
        button = layout.operator(
            "wcd.build_hulls", text="Build Hulls", icon="MESH_CUBE"
        )
        hand_over(settings, button, HULL_RUN)
        result = result_of(context.active_object).get("hulls", {})
        hulls = hulls_of(context.active_object) if result else []
        if not hulls:
            return
        current = bool(hulls_of_now(context.active_object))
        largest = f"{max(hull['error'] for hull in hulls):.3g}"
        line(layout, "Largest Error", largest if current else OUT_OF_DATE)
        complete = current and len(hulls) == len(result["hulls"])
        if result["volume_ratio"] and complete:
            line(layout, "Volume Ratio", f"{result['volume_ratio']:.2f}")
        draw_choices(layout, "wcd.make_rigid", "kind", icon="PHYSICS")
        layout.operator("wcd.remove_hulls", text="Remove Hulls", icon="TRASH")
        box = layout.box().column(align=True)
        _columns(box.row(align=True), None, "Hull", "Verts", "Error")
        names = [hull["name"] for hull in hulls]
        for hull, name in zip(hulls, endings(names), strict=True):
            obj = bpy.data.objects[hull["name"]]
            material = obj.data.materials[0] if obj.data.materials else None
            error = f"{hull['error']:.3g}" if current else "–"
            row = box.row(align=True)
            _columns(row, material, name, str(hull["vertices"]), error)
            shape = row.operator_menu_enum(
                "wcd.refit_hull", "shape", text="", icon="MESH_CUBE"
            )
            shape.hull = hull["name"]
            remove = row.operator("wcd.remove_hull", text="", icon="X", emboss=False)
            remove.hull = hull["name"]


def _shapes_of_parts(
    layout: bpy.types.UILayout, obj: bpy.types.Object, here: set[int]
) -> None:
    """Draw the choice of a shape for each part that has faces."""
    column = layout.column(align=True)
    for row in obj.wcd_parts:
        if row.number in here:
            column.prop(row, "hull_shape", text=row.name)


def endings(names: Sequence[str]) -> list[str]:
    """Return names without the beginning that all share; there is no room for it."""
    if len(names) < 2:
        return list(names)
    shared = commonprefix(names)  # noqa: RUF071  # letters are meant, not folders
    start = len(re.sub(r"\w*$", "", shared.replace("_", " ")))
    return [name[start:] for name in names]


def _columns(
    row: bpy.types.UILayout, material: Any, name: str, vertices: str, error: str
) -> None:
    """Draw a row of the list of hulls, or its heading."""
    split = row.split(factor=0.14)
    if material:
        split.prop(material, "diffuse_color", text="")
    else:
        split.label(text="")
    split = split.split(factor=0.34)
    split.label(text=name)
    numbers = split.split(factor=0.46)
    for text in (vertices, error):
        cell = numbers.row()
        cell.alignment = "RIGHT"
        cell.label(text=text)
    if not material:  # room for the buttons of the rows below
        row.label(text="", icon="BLANK1")
        row.label(text="", icon="BLANK1")
