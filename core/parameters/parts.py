"""Every info of the decomposition: its default, bounds, label and help, once."""

from __future__ import annotations

import math
from dataclasses import dataclass

from ..errors import DecompositionError
from .choices import (
    CONTAINERS,
    NORMALIZATION,
    PSI_PAIRS,
    REFINEMENT,
    SAMPLING,
    SIGHT,
)
from .parameter import ParameterInfo, parameter, settle


@dataclass(frozen=True)
class Parameters:
    """The settings of a decomposition; see each field's help.

    Raises
    ------
    DecompositionError
        If a value is out of its bounds or not one of its choices.
    """

    parts: int = parameter(
        0,
        ParameterInfo(
            "Parts",
            "Number of parts k; 0 searches for the k of largest psi",
            low=0,
            high=256,
            usual=24,
            advanced=False,
            affects_sight=False,
        ),
    )
    rays: int = parameter(
        30,
        ParameterInfo(
            "Rays",
            "Rays r that each sample casts into the shape; used by cone sight,"
            " while all pairs casts at every other sample",
            low=1,
            high=1000,
            advanced=False,
        ),
    )
    alpha: float = parameter(
        2.0,
        ParameterInfo(
            "Balance",
            "Weight alpha of pairs hidden between parts against pairs visible within"
            " parts: more splits the shape further; the paper uses 1",
            low=0.0,
            high=10.0,
            advanced=False,
            affects_sight=False,
        ),
    )
    sight: str = parameter(
        "ALL_PAIRS",
        ParameterInfo(
            "Lines of Sight",
            "Which lines of sight are looked up",
            choices=SIGHT,
            advanced=False,
        ),
    )
    sampling: str = parameter(
        "AREA",
        ParameterInfo(
            "Sampling",
            "Where the samples are, between which lines of sight run",
            choices=SAMPLING,
        ),
    )
    samples: int = parameter(
        1200,
        ParameterInfo(
            "Samples",
            "Points spread evenly over the surface",
            low=16,
            high=10000,
        ),
    )
    cone_angle: float = parameter(
        math.radians(120.0),
        ParameterInfo(
            "Cone Angle",
            "Full opening of the cone of rays; the paper uses 60 degrees",
            low=math.radians(1.0),
            high=math.pi,
            subtype="ANGLE",
        ),
    )
    psi_pairs: str = parameter(
        "UNIFORM",
        ParameterInfo(
            "Psi From",
            "Pairs of samples from which cone sight estimates psi; all pairs"
            " counts every pair",
            choices=PSI_PAIRS,
        ),
    )
    containers: str = parameter(
        "FILLED",
        ParameterInfo(
            "Containers",
            "Whether what the shape encloses, such as the hollow of a cup, is seen"
            " through",
            choices=CONTAINERS,
        ),
    )
    normalization: str = parameter(
        "LAPLACIAN",
        ParameterInfo(
            "Normalization",
            "How the matrix of lines of sight is normalized",
            choices=NORMALIZATION,
            affects_sight=False,
        ),
    )
    min_parts: int = parameter(
        2,
        ParameterInfo(
            "Fewest Parts",
            "Where the search for k begins",
            low=2,
            high=256,
            usual=24,
            affects_sight=False,
        ),
    )
    max_parts: int = parameter(
        13,
        ParameterInfo(
            "Most Parts",
            "Where the search for k ends",
            low=2,
            high=256,
            usual=24,
            affects_sight=False,
        ),
    )
    refinement: str = parameter(
        "PSI",
        ParameterInfo(
            "Refinement",
            "What k-means' clusters and their seams are refined by",
            choices=REFINEMENT,
            affects_sight=False,
        ),
    )
    smoothness: float = parameter(
        2.0,
        ParameterInfo(
            "Smoothness",
            "Weight lambda of short seams in concave creases; 0 leaves seams ragged",
            low=0.0,
            high=100.0,
            usual=10.0,
            affects_sight=False,
        ),
    )
    smallest_part: float = parameter(
        0.005,
        ParameterInfo(
            "Smallest Part",
            "Share of the area below which a connected piece joins its neighbor",
            low=0.0,
            high=0.5,
            subtype="FACTOR",
            affects_sight=False,
        ),
    )
    levels: int = parameter(
        1,
        ParameterInfo(
            "Levels",
            "How often parts are decomposed in their turn, with all samples on each, so"
            " that small ones come apart, such as fingers, at several times the time;"
            " Parts is the number on the first level",
            low=1,
            high=4,
            affects_sight=False,
        ),
    )
    seed: int = parameter(
        0,
        ParameterInfo("Seed", "Start of the random numbers", low=0, high=2**31 - 1),
    )

    def __post_init__(self) -> None:
        """Check every field, and what fields ask of each other."""
        settle(self)
        if self.min_parts > self.max_parts:
            raise DecompositionError(
                f"Fewest Parts is {self.min_parts}, above Most Parts,"
                f" {self.max_parts}; lower it or raise Most Parts."
            )
        if self.parts > self.samples:
            raise DecompositionError(
                f"{self.samples} samples cannot make {self.parts} parts;"
                " raise Samples or lower Parts."
            )
