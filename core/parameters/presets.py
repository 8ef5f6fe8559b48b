"""Named sets of parameters."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

from ..errors import DecompositionError
from .parameter import Choice, ParameterInfo
from .parts import Parameters


@dataclass(frozen=True)
class Preset(Choice):
    """A set of parameters with a name.

    Attributes
    ----------
    changes : dict of str to value
        Fields of `Parameters` that differ from their defaults.
    """

    changes: dict[str, Any]

    def parameters(self, **changes: Any) -> Parameters:
        """Return these parameters but for some `changes` of one's own."""
        return Parameters(**(self.changes | changes))


PRESETS = (
    Preset("DEFAULT", "Default", "What gives the best parts of most shapes", {}),
    Preset(
        "DENSE",
        "Many Samples",
        "Rays in wide cones from many samples, for shapes with many thin parts",
        {"sight": "CONE", "samples": 6000},
    ),
    Preset(
        "CHARACTER",
        "Character",
        "More parts, for limbs that are hidden from each other, and smaller ones, such"
        " as fingers: Balance 4 instead of 2, Smallest Part 0.002 instead of 0.005",
        {"alpha": 4.0, "smallest_part": 0.002},
    ),
    Preset(
        "MECHANICAL",
        "Mechanical",
        "Short and straight seams, as between the members of a tool: Smoothness 10"
        " instead of 2",
        {"smoothness": 10.0},
    ),
    Preset(
        "SCAN",
        "Scan",
        "For rough surfaces, whose bumps hide points that see each other: Balance 1"
        " instead of 2; clean surfaces get too few parts by it",
        {"alpha": 1.0},
    ),
    Preset(
        "PAPER",
        "Paper",
        "The settings of Asafi, Goren and Cohen-Or 2013, for comparison",
        {
            "sampling": "FACES",
            "sight": "CONE",
            "rays": 30,
            "cone_angle": math.radians(60.0),
            "psi_pairs": "RAYS",
            "containers": "HOLLOW",
            "alpha": 1.0,
            "refinement": "EMBEDDING",
        },
    ),
)

PRESET_INFO = ParameterInfo(
    "Preset", "Settings to start from, which others then change", choices=PRESETS
)


def preset(identifier: str) -> Preset:
    """Return the preset of that identifier.

    Raises
    ------
    DecompositionError
        If there is none.
    """
    for found in PRESETS:
        if found.identifier == identifier:
            return found
    names = ", ".join(each.identifier for each in PRESETS)
    raise DecompositionError(f"There is no preset {identifier!r}; choose from {names}.")
