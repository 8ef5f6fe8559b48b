"""The panel with a bar of psi for each number of parts that was tried."""

from __future__ import annotations

from typing import Any

import bpy

from .panels import WCD_PT_parts
from .sidebar import Sidebar, result_of

# Share of the width for the number of parts, and height of a row, in usual rows.
_NUMBER = 0.22
_HEIGHT = 0.8


class WCD_PT_chart(Sidebar, bpy.types.Panel):
    """Psi by number of parts."""

    bl_label = "ψ by Number of Parts"
    bl_parent_id = WCD_PT_parts.__name__

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        """Return whether more than one number of parts was tried."""
        result = result_of(context.active_object)
        return "parts" in result and len(result.get("psi_by_k", ())) > 1

    def draw(self, context: bpy.types.Context) -> None:
        """Draw a row for each number of parts."""
        result = result_of(context.active_object)
        psi_by_k = {int(k): psi for k, psi in result["psi_by_k"].items()}
        low, high = min(psi_by_k.values()), max(psi_by_k.values())
        column = self.layout.column(align=True)
        column.scale_y = _HEIGHT
        for k, psi in sorted(psi_by_k.items()):
            split = column.split(factor=_NUMBER, align=True)
            self._draw_number(split, k, result)
            share = (psi - low) / (high - low) if high > low else 1.0
            split.progress(factor=share, text=f"{psi:.3f}")

    @staticmethod
    def _draw_number(
        layout: bpy.types.UILayout, k: int, result: dict[str, Any]
    ) -> None:
        """Draw the button that chooses a number of parts; a star marks the best."""
        icon = "SOLO_ON" if k == result.get("best_k") else "NONE"
        # With deeper levels, k counts the parts of all levels.
        shown = k == result["k"] and result["parameters"].get("levels", 1) == 1
        button = layout.operator(
            "wcd.choose_part_count", text=str(k), icon=icon, depress=shown
        )
        button.parts = k
