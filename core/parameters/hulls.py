"""Defines the parameters of collision hulls, with default, bounds, label and help."""

from __future__ import annotations

import math
from dataclasses import dataclass

from ..errors import DecompositionError
from .hull_names import NAMINGS, hull_names
from .parameter import Choice, ParameterInfo, check_fields, is_within, parameter

SHAPES = (
    Choice("HULL", "Convex Hull", "The smallest convex shape around it"),
    Choice("BOX", "Box", "A box of small volume, in any orientation"),
    Choice("CAPSULE", "Capsule", "A cylinder with round ends"),
    Choice("SPHERE", "Sphere", "The smallest sphere around it"),
    Choice("CYLINDER", "Cylinder", "A cylinder of small volume"),
)

# Bounds of a relative error.
RELATIVE_ERRORS = 0.001, 1.0


@dataclass(frozen=True)
class HullParameters:
    """The settings of collision hulls.

    The label, meaning and bounds of each field are in its `ParameterInfo`, which
    `info_of` returns. Tooltips, command line and manual take them from there.

    Raises
    ------
    DecompositionError
        If a value is out of its bounds or not one of its choices, or if the template
        cannot be filled in.

    Examples
    --------
    >>> from weak_convex_decomposition import HullParameters
    >>> HullParameters(shape="BOX", max_hulls=8).max_error
    0.05
    """

    shape: str = parameter(
        "HULL",
        ParameterInfo(
            "Shape",
            "Kind of collision shape that is put around each piece",
            choices=SHAPES,
        ),
    )
    pieces: str = parameter(
        "BY_ERROR",
        ParameterInfo(
            "Pieces",
            "Pieces of the model that get a collision shape each",
            choices=(
                Choice(
                    "BY_ERROR",
                    "By Error",
                    "Cut the solid by planes until every hull is within Largest Error;"
                    " needs no parts",
                ),
                Choice(
                    "PARTS",
                    "Parts",
                    "Use the parts as they are, one shape for each. If there are more"
                    " than Most Hulls, parts are joined where this adds least volume",
                ),
            ),
        ),
    )
    max_error: float = parameter(
        0.05,
        ParameterInfo(
            "Largest Error",
            "How far a shape may stray from the solid, at most: higher values give"
            " fewer shapes, which fit less closely. Neighbors whose common shape is"
            " within it are joined",
            low=1e-6,
            high=1e6,
            usual=1.0,
            used_with=("pieces", "BY_ERROR"),
        ),
    )
    error_unit: str = parameter(
        "RELATIVE",
        ParameterInfo(
            "Error Unit",
            "Unit of Largest Error, and of the errors of the shapes",
            choices=(
                Choice(
                    "RELATIVE",
                    "Relative",
                    "1 is half of the longest side of the object's bounding box, as in"
                    " CoACD's concavity. Largest Error is from 0.001 to 1",
                ),
                Choice(
                    "SCENE",
                    "Scene",
                    "Lengths in the scene, with the object's scale. Scripts that give"
                    " arrays have lengths in the unit of the vertices",
                ),
            ),
        ),
    )
    max_hulls: int = parameter(
        32,
        ParameterInfo(
            "Most Hulls",
            "Largest number of hulls. If more are needed to stay within Largest Error,"
            " pieces are joined where this causes the least error",
            low=1,
            high=256,
        ),
    )
    max_vertices: int = parameter(
        64,
        ParameterInfo(
            "Most Vertices",
            "Largest number of vertices of a hull: higher values fit more closely; a"
            " hull with fewer vertices lies within the exact hull",
            low=4,
            high=1024,
            used_with=("shape", "HULL"),
        ),
    )
    margin: float = parameter(
        0.0,
        ParameterInfo(
            "Margin",
            "Distance by which the faces of collision shapes move outwards, in units of"
            " the mesh (in its proportions in the scene, at its own volume): higher"
            " values make the shapes larger, negative values smaller",
            low=-1000.0,
            high=1000.0,
        ),
    )

    naming: str = parameter(
        "PLAIN",
        ParameterInfo(
            "Naming",
            "How the objects of hulls are named",
            choices=NAMINGS,
        ),
    )
    template: str = parameter(
        "{name}_{n:02d}",
        ParameterInfo(
            "Template",
            "Pattern of names, used if Naming is By Template: {name} is the name of the"
            " object, {n} the number of the hull, {kind} its shape, {prefix} Unreal's"
            " prefix",
            used_with=("naming", "TEMPLATE"),
        ),
    )

    def __post_init__(self) -> None:
        """Check every field, and that the template gives each hull another name."""
        check_fields(self)
        low, high = RELATIVE_ERRORS
        if self.error_unit == "RELATIVE" and not is_within(self.max_error, low, high):
            raise DecompositionError(
                f"Largest Error is {self.max_error:g}; choose a value from {low:g} to"
                f" {high:g}, or Error Unit = Scene for lengths."
            )
        hull_names(self.naming, self.template, "name", ("HULL", "HULL"))

    def unit_of_errors(self, half_side: float) -> float:
        """Return how much an error of 1 is in the chosen unit, where 1 is relative.

        Parameters
        ----------
        half_side : float
            Half of the longest side of the shape, in units of the scene.

        Returns
        -------
        float
            `half_side` for lengths in the scene, 1 for relative errors.

        Raises
        ------
        DecompositionError
            If Largest Error counts, and is a length that is too small for the shape.
        """
        if self.error_unit == "RELATIVE":
            return 1.0
        least = RELATIVE_ERRORS[0] * half_side
        if self.pieces != "PARTS" and not is_within(self.max_error, least, math.inf):
            raise DecompositionError(
                f"Largest Error = {self.max_error:g} is too small for this shape;"
                f" choose at least {least:.4g}, a thousandth of half its longest side."
            )
        return half_side
