"""Defines the parameters of files for simulators: density, and what is a body."""

from __future__ import annotations

from dataclasses import dataclass

from .parameter import Choice, ParameterInfo, check_fields, parameter


@dataclass(frozen=True)
class BodyParameters:
    """The settings of .urdf and .xml files, which simulators read.

    The label, meaning and bounds of each field are in its `ParameterInfo`, which
    `info_of` returns. Command line and manual take them from there.

    Raises
    ------
    DecompositionError
        If a value is out of its bounds or not one of its choices.
    """

    density: float = parameter(
        1000.0,
        ParameterInfo(
            "Density",
            "Mass of a cubic unit of the model in .urdf and .xml files: kilograms per"
            " cubic meter, as simulators take a unit for a meter; water has 1000",
            low=0.001,
            high=1e15,
        ),
    )
    bodies: str = parameter(
        "ONE",
        ParameterInfo(
            "Bodies",
            "What moves by itself in .urdf and .xml files",
            choices=(
                Choice("ONE", "One", "All objects together are one rigid body"),
                Choice(
                    "EACH",
                    "Each",
                    "Each object is a body of its own that moves freely, with the"
                    " object's origin and rotation as its frame",
                ),
            ),
        ),
    )

    def __post_init__(self) -> None:
        """Check every field."""
        check_fields(self)
