"""The panel with a bar for each number of parts that was tried: its gain in psi.

The bars compare psi before seams are cut, for no more than one number is cut. Psi of
the parts, in the panel above, is after that. So bars are shares of the largest gain,
and psi itself is shown once.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import bpy

from ..core.results.psi import good_numbers
from ..operators.bridge.stored.names import HAND_LAYER
from ..operators.bridge.stored.noted_parts import psi_by_k_of
from .panels import WCD_PT_parts
from .sidebar import Sidebar, paragraph, result_of, width_of

# Most bars: of more numbers, those that are nearest to the best one.
_MOST_BARS = 26
# Least share of the width for the number of parts, and height of a row, in usual rows.
_NUMBER = 0.22
_HEIGHT = 0.8
# Widths at interface scale 1: of a star with two digits; of the sidebar beside a row.
_STAR, _EDGES = 50, 53
# Largest share of the gain that the best number lacks by tolerance or sampling error.
_MOST_TOLERATED = 0.1


class WCD_PT_chart(Sidebar, bpy.types.Panel):
    """Gain in psi by number of parts."""

    bl_label = "Gain by Number of Parts"
    bl_parent_id = WCD_PT_parts.__name__

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        """Return whether more than one number of parts was tried."""
        result = result_of(context.active_object)
        return "parts" in result and len(result.get("psi_by_k", ())) > 1

    def draw(self, context: bpy.types.Context) -> None:
        """Draw a row for each number of parts, and say which are good and why."""
        obj = context.active_object
        result, by_hand = result_of(obj), HAND_LAYER in obj.data.attributes
        psi_by_k = psi_by_k_of(result)
        gains, best = gains_of(psi_by_k), result["best_k"]
        good = good_numbers(psi_by_k, best)
        details = None if by_hand else details_of(result)  # edits count as neither
        for text in (offer_of(good), reason_for(best, gains), details):
            if text:
                paragraph(self.layout, text, context, icon="SOLO_ON")
        column, width = self.layout.column(align=True), width_of(context)
        column.scale_y = _HEIGHT
        nearest = sorted(gains, key=lambda k: abs(k - best))[:_MOST_BARS]
        for k in sorted(nearest):
            gain = gains[k]
            split = column.split(factor=share_of_numbers(width), align=True)
            icon = "SOLO_ON" if k == best else "SOLO_OFF" if k in good else "NONE"
            _draw_number(split, k, result, icon)
            split.progress(factor=gain, text=f"{gain:.0%}", translate=False)


def _draw_number(
    layout: bpy.types.UILayout, k: int, result: dict[str, Any], icon: str
) -> None:
    """Draw the button that chooses a number of parts."""
    shown = k == result["k"] and not has_details(result)
    button = layout.operator(
        "wcd.choose_part_count", text=str(k), icon=icon, depress=shown
    )
    button.parts = k


def share_of_numbers(width: float) -> float:
    """Return the share of a row that shows its number with a star uncut."""
    return max(_NUMBER, _STAR / max(width - _EDGES, _STAR))


def gains_of(psi_by_k: Mapping[int, float]) -> dict[int, float]:
    """Return the length of each bar: 0 for the lowest psi, 1 for the highest."""
    low, high = min(psi_by_k.values()), max(psi_by_k.values())
    return {
        k: (psi - low) / (high - low) if high > low else 1.0
        for k, psi in sorted(psi_by_k.items())
    }


def offer_of(good: Sequence[int]) -> str | None:
    """Return which numbers of parts are good, coarse to fine, if several are."""
    if len(good) < 2:
        return None
    return f"Coarse to fine: {', '.join(map(str, good[:-1]))} or {good[-1]} parts."


def has_details(result: Mapping[str, Any]) -> bool:
    """Return whether parts were split further: then no bar tells their number."""
    parameters = result["parameters"]
    if parameters["levels"] == 0:
        return not parameters["parts"] and result["k"] > result["best_k"]
    return bool(parameters["levels"] > 1)


def details_of(result: Mapping[str, Any]) -> str | None:
    """Return how many parts more there are because some of them hide details."""
    if result["parameters"]["levels"] or not has_details(result):
        return None
    more = result["k"] - result["best_k"]
    return f"{result['best_k']} parts of the whole, and {more} more in their details."


def reason_for(best: int, gains: Mapping[int, float]) -> str | None:
    """Return why the best number of parts has not the longest bar, if it has not."""
    longest = max(gains, key=gains.__getitem__)
    if best not in gains or gains[longest] <= gains[best]:
        return None
    lead = gains[longest] - gains[best]
    more = f"{lead:.0%}"
    if lead > _MOST_TOLERATED:  # only parts between loops of creases may lack so much
        return f"{best} is best: {longest} gain {more} more, but ignore creases."
    more = "less than 1%" if more == "0%" else f"only {more}"
    if longest > best:
        return f"{best} is best: {longest} gain {more} more."
    return f"{best} is best: {longest} gain {more} more, but split less evenly."
