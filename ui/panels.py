"""The panels on settings and results in the sidebar."""

from __future__ import annotations

from typing import Any, ClassVar

import bpy

from ..core.results.psi import quality_word
from ..operators.bridge.parts.read import loss_of
from ..operators.bridge.parts.rows import noted_refusal
from ..operators.bridge.read.shown_mesh import differs
from ..operators.bridge.work.libraries import load_while_idle
from ..operators.running import modal as running
from ..operators.running.modal import Running
from ..operators.settings import ADVANCED, FRONT, draw
from ..operators.viewport.shown_figures import is_of_now, shown_figures
from .parts_table import draw_table
from .sidebar import (
    LABELS,
    Sidebar,
    hull_rows_of_now,
    line,
    paragraph,
    rank_text,
    result_of,
    width_of,
)


def notes_of(obj: bpy.types.Object | None) -> list[str]:
    """Return the sentences that came with results on an object, each once.

    They are drawn because the status bar shows only the last report. A result of a mesh
    that has changed since has none. A sentence of its own says that parts were lost.
    """
    result, figures = result_of(obj), shown_figures(obj)
    has_lost = figures is None and "k" in result  # which only parts have
    lost = [loss_of(obj)] if obj and has_lost else []
    results = [result] if figures and not figures.problem else []
    if obj and is_of_now(obj, measured := result.get("measured", {})):
        results.append(measured)
    if obj and hull_rows_of_now(obj):
        results.append(result["hulls"])
    notes = [note for noted in results for note in noted.get("notes", ())]
    return list(dict.fromkeys(lost + notes))


class WCD_PT_main(Sidebar, bpy.types.Panel):
    """The settings that matter, and the buttons."""

    bl_label = "Convex Parts"

    def draw_header_preset(self, context: bpy.types.Context) -> None:
        """Draw the menu of presets."""
        self.layout.emboss = "NONE"
        self.layout.ui_units_x = 1.6  # room for the icon and its arrow
        self.layout.operator_menu_enum(
            "wcd.use_preset", "preset", text="", icon="PRESET"
        )

    def draw(self, context: bpy.types.Context) -> None:
        """Draw the panel."""
        load_while_idle()
        layout = self.layout
        settings = context.scene.wcd
        _draw_parts(layout, settings)
        draw(layout, settings, [name for name in FRONT if name != "parts"])
        if shown_figures(context.active_object):
            draw(layout, settings, ("keep_edits",))
        if differs(context.active_object):
            draw(layout, settings, ("mesh",))
        row = layout.row(align=True)
        row.use_property_split = False
        row.scale_y = 1.4
        if running.current:
            _progress(row, running.current)
        else:
            row = row.split(factor=0.7, align=True)
            row.operator("wcd.decompose", text="Decompose", icon="MOD_EXPLODE")
            live = row.row(align=True)
            live.active = bpy.ops.wcd.decompose.poll()
            live.prop(settings, "live", toggle=True)
        row = layout.row(align=True)
        row.operator("wcd.measure", text="Measure")
        row.operator("wcd.clear", text="Clear")


class WCD_PT_parts(Sidebar, bpy.types.Panel):
    """The result on the active object."""

    bl_label = "Result"
    bl_parent_id = "WCD_PT_main"

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        """Return whether there is a result to show."""
        obj = context.active_object
        if "measured" in result_of(obj) or shown_figures(obj) is not None:
            return True
        return bool(notes_of(obj))

    def draw(self, context: bpy.types.Context) -> None:
        """Draw the panel."""
        layout = self.layout
        obj = context.active_object
        result = result_of(obj)
        for note in notes_of(obj):
            paragraph(layout, note, context)
        if "measured" in result:
            line(layout, "Convexity", rank_text(obj, result["measured"]))
        figures = shown_figures(obj)
        if figures is None:
            return
        if figures.problem:
            paragraph(layout, f"Out of date. {figures.problem}", context)
            layout.operator("wcd.refresh_parts", text="Refresh", icon="FILE_REFRESH")
        else:
            _draw_quality(layout, result)
        if obj.wcd_parts:
            draw_table(layout, obj, width_of(context))
            reason = noted_refusal(obj)
            if reason:
                paragraph(layout, f"{reason}.", context)
            layout.operator("wcd.rename_parts", text="Rename All", icon="SORTALPHA")


class WCD_PT_advanced(Sidebar, bpy.types.Panel):
    """The settings few users touch."""

    bl_label = "Advanced"
    bl_parent_id = "WCD_PT_main"
    bl_options: ClassVar[set[str]] = {"DEFAULT_CLOSED"}

    def draw(self, context: bpy.types.Context) -> None:
        """Draw the panel."""
        draw(self.layout, context.scene.wcd, (*ADVANCED, "colors"))


def _progress(row: bpy.types.UILayout, run: Running) -> None:
    """Draw the progress of a computation, and the button that stops it."""
    progress = run.job.progress
    split = row.split(factor=0.7)
    split.progress(factor=progress.fraction, text=progress.stage, translate=False)
    split.operator("wcd.cancel", text="Cancel")


def _draw_parts(layout: bpy.types.UILayout, settings: bpy.types.AnyType) -> None:
    """Draw the number of parts: Auto, or a number and the way back to Auto."""
    split = layout.split(factor=LABELS)
    label = split.row()
    label.alignment = "RIGHT"
    label.label(text="Parts", translate=False)
    row = split.row(align=True)
    if not settings.auto_parts:
        row.prop(settings, "parts", text="")
    row.prop(settings, "auto_parts", toggle=True)


def _draw_quality(layout: bpy.types.UILayout, result: dict[str, Any]) -> None:
    """Draw the quality of the parts in a word; psi is in its tooltip."""
    alpha = result["parameters"]["alpha"]
    word = quality_word(result["psi"], result["psi_before"], alpha)
    split = layout.split(factor=LABELS)
    split.label(text="Quality", translate=False)
    row = split.row()
    row.alignment = "LEFT"
    row.operator("wcd.tell_quality", text=word, emboss=False)
