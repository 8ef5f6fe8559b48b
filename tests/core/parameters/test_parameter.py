import re
from dataclasses import dataclass, fields
from enum import Enum

import numpy as np
import pytest
from weak_convex_decomposition.core.errors import DecompositionError
from weak_convex_decomposition.core.parameters.hulls import HullParameters
from weak_convex_decomposition.core.parameters.parameter import (
    Choice,
    ParameterInfo,
    check,
    check_fields,
    info_of,
    parameter,
)
from weak_convex_decomposition.core.parameters.parts import Parameters


@dataclass(frozen=True)
class Settings:
    count: int = parameter(3, ParameterInfo("Count", "How many", low=1, high=5))
    weight: float = parameter(0.5, ParameterInfo("Weight", "How heavy", low=0.0))
    color: str = parameter(
        "RED",
        ParameterInfo(
            "Color",
            "Which",
            choices=(Choice("RED", "Red", "As blood"), Choice("TAN", "Tan", "As")),
        ),
    )


COUNT, WEIGHT, COLOR = fields(Settings)


def test_a_field_carries_its_default_and_its_info():
    assert Settings() == Settings(3, 0.5, "RED")
    assert info_of(WEIGHT).label == "Weight"
    assert [choice.label for choice in info_of(COLOR).choices] == ["Red", "Tan"]


def test_check_lets_good_values_pass():
    for field, values in ((COUNT, (1, 5)), (WEIGHT, (0, 1e9)), (COLOR, ("TAN",))):
        for value in values:
            check(field, value)


@pytest.mark.parametrize(
    ("field", "value", "text"),
    [
        (COUNT, 6, "Count is 6; choose a value from 1 to 5."),
        (COUNT, 0, "Count is 0; choose a value from 1 to 5."),
        (COUNT, 2.5, "Count must be a whole number, not 2.5."),
        (WEIGHT, "x", "Weight must be a number, not 'x'."),
        (COLOR, "red", "Color cannot be 'red'; choose one of RED, TAN."),
        (COUNT, 10**400, "Count is out of range; choose a value from 1 to 5."),
        (WEIGHT, -(10**400), "Weight is out of range; choose a value from 0 to inf."),
        (COUNT, 2**31, "Count is 2147483648; choose a value from 1 to 5."),
        (WEIGHT, -2.5e20, "Weight is -2.5e+20; choose a value from 0 to inf."),
        (
            COLOR,
            np.array(["RED"]),
            "Color cannot be array(['RED'], dtype='<U3'); choose one of RED, TAN.",
        ),
    ],
)
def test_check_says_what_is_wrong_and_what_to_do(field, value, text):
    with pytest.raises(DecompositionError, match=f"^{re.escape(text)}$"):
        check(field, value)


def test_choices_are_kept_as_plain_texts():
    Colors = Enum("Colors", {"TAN": "TAN"}, type=str)
    for value in (Colors.TAN, np.str_("TAN")):
        settings = Settings(color=value)
        check_fields(settings)
        assert settings.color == "TAN"
        assert type(settings.color) is str


def test_every_parameter_has_a_label_a_help_and_a_good_default():
    every = [*fields(Parameters), *fields(HullParameters)]
    assert len(every) > 20
    for field in every:
        info = info_of(field)
        assert info.label[:1].isupper(), field.name
        assert info.help[:1].isupper(), field.name
        assert not info.help.endswith("."), field.name
        check(field, field.default)  # its error names the parameter


def test_bounds_give_way_by_a_share_of_themselves():
    for error in (0, 0.0, 9e-7, 1.001e6):
        with pytest.raises(DecompositionError, match="choose a value from 1e-06 to"):
            HullParameters(max_error=error, error_unit="SCENE")
    for error in (np.float32(1e-6), np.float32(1e6)):
        HullParameters(max_error=float(error), error_unit="SCENE")
    for error in (np.float32(0.001), np.float32(1.0)):
        HullParameters(max_error=float(error))
    for error in (0.00099999, 1.00001):
        with pytest.raises(
            DecompositionError, match=r"from 0\.001 to 1, or Error Unit"
        ):
            HullParameters(max_error=error)
