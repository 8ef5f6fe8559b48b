"""Every info of collision hulls: default, bounds, label and help, once."""

from __future__ import annotations

from dataclasses import dataclass

from .hull_names import NAMINGS, hull_names
from .parameter import Choice, ParameterInfo, parameter, settle


@dataclass(frozen=True)
class HullParameters:
    """The settings of collision hulls; see each field's help.

    Raises
    ------
    DecompositionError
        If a value is out of its bounds or not one of its choices.
    """

    shape: str = parameter(
        "HULL",
        ParameterInfo(
            "Shape",
            "What is put around each piece",
            choices=(
                Choice("HULL", "Convex Hull", "The smallest convex shape around it"),
                Choice("BOX", "Box", "A box of small volume, turned any way"),
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
            "What the shapes are put around",
            choices=(
                Choice(
                    "BY_ERROR",
                    "By Error",
                    "The solid, cut by planes until every hull is within Largest"
                    " Error; needs no parts",
                ),
                Choice(
                    "PARTS",
                    "Parts",
                    "The parts as they are, one shape each; joined, those that add"
                    " least volume first, where there are more than Most Hulls",
                ),
            ),
            advanced=False,
        ),
    )
    max_error: float = parameter(
        0.05,
        ParameterInfo(
            "Largest Error",
            "How far a hull may stray from the shape, where half of the shape's longest"
            " side is 1: CoACD's concavity. Hulls that exceed it are split further,"
            " neighbors within it are joined",
            low=0.001,
            high=1.0,
            advanced=False,
        ),
    )
    max_hulls: int = parameter(
        32,
        ParameterInfo(
            "Most Hulls",
            "Number of hulls at most; where it is too small for Largest Error, those"
            " are joined that stray least",
            low=1,
            high=256,
            advanced=False,
        ),
    )
    max_vertices: int = parameter(
        64,
        ParameterInfo(
            "Most Vertices",
            "Vertices of a hull at most; fewer lie within the exact hull",
            low=4,
            high=1024,
        ),
    )
    margin: float = parameter(
        0.0,
        ParameterInfo(
            "Margin",
            "Distance by which the faces of shapes are moved outwards, inwards if"
            " negative, in the units of the mesh",
            low=-1000.0,
            high=1000.0,
        ),
    )

    naming: str = parameter(
        "PLAIN",
        ParameterInfo(
            "Naming",
            "How hulls are named",
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
            "Names of hulls with Naming by Template: {name} stands for the object, {n}"
            " for the number of the hull, {kind} for its shape, {prefix} for Unreal's"
            " prefix",
        ),
    )

    def __post_init__(self) -> None:
        """Check every field, and that the template tells hulls apart."""
        settle(self)
        hull_names(self.naming, self.template, "name", ("HULL", "HULL"))
