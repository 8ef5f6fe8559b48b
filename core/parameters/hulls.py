"""Defines the parameters of collision hulls, with default, bounds, label and help."""

from __future__ import annotations

from dataclasses import dataclass

from .hull_names import NAMINGS, hull_names
from .parameter import Choice, ParameterInfo, parameter, settle


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
            choices=(
                Choice("HULL", "Convex Hull", "The smallest convex shape around it"),
                Choice("BOX", "Box", "A box of small volume, in any orientation"),
                Choice("CAPSULE", "Capsule", "A cylinder with round ends"),
                Choice("SPHERE", "Sphere", "The smallest sphere around it"),
                Choice("CYLINDER", "Cylinder", "A cylinder of small volume"),
            ),
            advanced=False,
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
            advanced=False,
        ),
    )
    max_error: float = parameter(
        0.05,
        ParameterInfo(
            "Largest Error",
            "How far a hull may be from the surface: higher values give fewer hulls,"
            " which fit less closely. 1 is half of the shape's longest side, as in"
            " CoACD's concavity. Neighbors whose common hull is within it are joined",
            low=0.001,
            high=1.0,
            advanced=False,
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
            advanced=False,
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
        ),
    )
    margin: float = parameter(
        0.0,
        ParameterInfo(
            "Margin",
            "Distance by which the faces of collision shapes move outwards, in units of"
            " the mesh: higher values make the shapes larger, negative values smaller",
            low=-1000.0,
            high=1000.0,
        ),
    )

    naming: str = parameter(
        "PLAIN",
        ParameterInfo(
            "Naming",
            "How the objects of hulls are named",
            choices=tuple(
                Choice(naming.identifier, naming.label, naming.help)
                for naming in NAMINGS
            ),
            advanced=False,
        ),
    )
    template: str = parameter(
        "{name}_{n:02d}",
        ParameterInfo(
            "Template",
            "Pattern of names, used if Naming is By Template: {name} is the name of the"
            " object, {n} the number of the hull, {kind} its shape, {prefix} Unreal's"
            " prefix",
        ),
    )

    def __post_init__(self) -> None:
        """Check every field, and that the template gives each hull another name."""
        settle(self)
        hull_names(self.naming, self.template, "name", ("HULL", "HULL"))
