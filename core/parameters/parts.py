"""Defines the parameters of a decomposition, with default, bounds, label and help."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import partial

from ..errors import DecompositionError
from . import choices
from .parameter import ParameterInfo, check_fields, parameter

# A number of parts that bounds the search.
_searched = partial(ParameterInfo, low=2, high=256, affects_sight=False)


@dataclass(frozen=True)
class Parameters:
    """The settings of a decomposition.

    The label, meaning and bounds of each field are in its `ParameterInfo`, which
    `info_of` returns. Tooltips, command line and manual take them from there.

    Raises
    ------
    DecompositionError
        If a value is out of its bounds or not one of its choices, if `min_parts` is
        above `max_parts`, or if there are more `parts` than `samples`.

    Examples
    --------
    >>> from weak_convex_decomposition import Parameters
    >>> Parameters(parts=6, alpha=1.0).samples
    1200
    """

    parts: int = parameter(
        0,
        ParameterInfo(
            "Parts",
            "Number of parts (k). 0 is Auto: as many as the shape suggests by psi, a"
            " score that counts pairs of points that see each other within parts or are"
            " hidden between parts. Set a number where you know how many you want",
            low=0,
            high=256,
            usual=24,
            advanced=False,
            affects_sight=False,
        ),
    )
    rays: int = parameter(
        0,
        ParameterInfo(
            "Rays",
            "Most rays (r) that each sample casts: fewer are quicker and less exact. It"
            " matters for large meshes and for shapes of many shells, which take"
            " longest. 0 casts as many as Lines of Sight needs: about 50 in blocks, 30"
            " in a cone, or all between all pairs",
            low=0,
            high=1000,
            advanced=False,
        ),
    )
    alpha: float = parameter(
        2.0,
        ParameterInfo(
            "Detail",
            "More Detail splits the shape into more parts. It matters where the number"
            " of parts is Auto: raise it if limbs are missing, lower it if there are"
            " too many small parts. Weight alpha (α) in psi of hidden pairs between"
            " parts, relative to visible pairs within parts; the paper uses 1",
            low=0.0,
            high=10.0,
            advanced=False,
            affects_sight=False,
        ),
    )
    sight: str = parameter(
        "BLOCKS",
        ParameterInfo(
            "Lines of Sight",
            "Which pairs of samples are tested for a line of sight, a straight line"
            " between them inside the shape",
            choices=choices.SIGHT,
        ),
    )
    sampling: str = parameter(
        "AREA",
        ParameterInfo(
            "Sampling",
            "Where samples are placed, the points between which lines of sight run",
            choices=choices.SAMPLING,
        ),
    )
    samples: int = parameter(
        1200,
        ParameterInfo(
            "Samples",
            "Number of points spread evenly over the surface: more show smaller details"
            " and take longer. Meshes of fewer than 600 triangles take down to a third"
            " of them, but 400 at least; not used if Sampling is By Faces",
            low=16,
            high=10000,
            used_with=("sampling", "AREA"),
        ),
    )
    cone_angle: float = parameter(
        math.radians(120.0),
        ParameterInfo(
            "Cone Angle",
            "Full opening angle of the cone of rays: higher values spread rays wider;"
            " only used if Lines of Sight is Cone; the paper uses 60 degrees",
            low=math.radians(1.0),
            high=math.pi,
            subtype="ANGLE",
            used_with=("sight", "CONE"),
        ),
    )
    psi_pairs: str = parameter(
        "UNIFORM",
        ParameterInfo(
            "Psi From",
            "Pairs of samples that psi, the score of the parts, is estimated from; only"
            " used if Lines of Sight is Cone, since the other kinds count every pair",
            choices=choices.PSI_PAIRS,
            used_with=("sight", "CONE"),
        ),
    )
    containers: str = parameter(
        "FILLED",
        ParameterInfo(
            "Containers",
            "Whether lines of sight may cross the hollow that a shape encloses, such as"
            " that of a cup",
            choices=choices.CONTAINERS,
        ),
    )
    normalization: str = parameter(
        "LAPLACIAN",
        ParameterInfo(
            "Normalization",
            "How the matrix of lines of sight is scaled before samples are clustered",
            choices=choices.NORMALIZATION,
            affects_sight=False,
        ),
    )
    min_parts: int = parameter(
        2,
        _searched(
            "Fewest Parts",
            "Smallest number of parts that the search tries",
            used_with=("parts", 0),
        ),
    )
    max_parts: int = parameter(
        50,
        _searched(
            "Most Parts",
            "Largest number of parts that the search tries: 13 first, more if needed",
            used_with=("parts", 0),
        ),
    )
    refinement: str = parameter(
        "PSI",
        ParameterInfo(
            "Refinement",
            "How parts and their seams are improved after samples are clustered",
            choices=choices.REFINEMENT,
            affects_sight=False,
        ),
    )
    smoothness: float = parameter(
        2.0,
        ParameterInfo(
            "Smoothness",
            "Higher values give shorter seams that follow concave creases; 0 leaves"
            " seams ragged. Weight lambda of the length of seams",
            low=0.0,
            high=100.0,
            usual=10.0,
            affects_sight=False,
        ),
    )
    seams: str = parameter(
        "KEEP",
        ParameterInfo(
            "Seams",
            "Whether seams may run through faces: for meshes of few, large faces",
            choices=choices.SEAMS,
            affects_sight=False,
        ),
    )
    bends: str = parameter(
        "CUT",
        ParameterInfo(
            "Bends",
            "Whether a limb or a ring is divided where it bends",
            choices=choices.BENDS,
            affects_sight=False,
        ),
    )
    smallest_part: float = parameter(
        0.005,
        ParameterInfo(
            "Smallest Part",
            "Pieces with a smaller share of the surface area join a neighbor: higher"
            " values leave fewer small parts",
            low=0.0,
            high=0.5,
            subtype="FACTOR",
            affects_sight=False,
        ),
    )
    levels: int = parameter(
        0,
        ParameterInfo(
            "Levels",
            "Each level after the first splits the parts again, with all samples on one"
            " part at a time, which takes several times as long. Parts is the number of"
            " parts on the first level. 0 is Auto: if Parts is Auto too, parts that"
            " hide details are split again, such as an arm with fingers, a head with"
            " antennae or a leg with a knee",
            low=0,
            high=4,
            affects_sight=False,
        ),
    )
    seed: int = parameter(
        0,
        ParameterInfo(
            "Seed",
            "Start of the random numbers: other values place samples elsewhere",
            low=0,
            high=2**31 - 1,
        ),
    )

    def __post_init__(self) -> None:
        """Check every field, and the fields whose values limit each other."""
        check_fields(self)
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
