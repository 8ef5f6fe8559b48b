"""Defines named sets of parameters for kinds of models."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

from ..errors import DecompositionError
from .parameter import Choice, ParameterInfo
from .parts import Parameters


@dataclass(frozen=True)
class Preset(Choice):
    """A named set of parameters.

    Attributes
    ----------
    changes : dict of str to value
        Values of the fields of `Parameters` that the preset sets.
    """

    changes: dict[str, Any]

    def parameters(self, **changes: Any) -> Parameters:
        """Return the parameters of this preset, some of them overridden.

        Parameters
        ----------
        **changes : int, float or str
            Fields of `Parameters` with values that replace those of the preset.

        Returns
        -------
        parameters : Parameters

        Raises
        ------
        DecompositionError
            If a value is out of its bounds or not one of its choices.
        """
        return Parameters(**(self.changes | changes))


PRESETS = (
    Preset("DEFAULT", "Default", "The settings that suit most shapes best", {}),
    Preset(
        "DENSE",
        "Many Samples",
        "For shapes with many thin parts: rays in wide cones, from 6000 samples instead"
        " of 1200",
        {"sight": "CONE", "samples": 6000},
    ),
    Preset(
        "CHARACTER",
        "Character",
        "For bodies with limbs and fingers: more parts, and smaller ones. Detail 4"
        " instead of 2, Smallest Part 0.002 instead of 0.005",
        {"alpha": 4.0, "smallest_part": 0.002},
    ),
    Preset(
        "MECHANICAL",
        "Mechanical",
        "For tools and machines: shorter and straighter seams. Smoothness 10 instead"
        " of 2",
        {"smoothness": 10.0},
    ),
    Preset(
        "SCAN",
        "Scan",
        "For rough surfaces, whose bumps hide points from each other: Detail 1 instead"
        " of 2. Clean surfaces get too few parts with it",
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
            "levels": 1,
        },
    ),
)

PRESET_INFO = ParameterInfo(
    "Preset",
    "A set of settings to start from; options for single settings override it",
    choices=PRESETS,
)


def preset(identifier: str) -> Preset:
    """Return the preset with an identifier.

    Parameters
    ----------
    identifier : str
        For example 'CHARACTER'.

    Returns
    -------
    Preset

    Raises
    ------
    DecompositionError
        If no preset has that identifier.
    """
    for found in PRESETS:
        if found.identifier == identifier:
            return found
    names = ", ".join(each.identifier for each in PRESETS)
    raise DecompositionError(f"There is no preset {identifier!r}; choose from {names}.")
