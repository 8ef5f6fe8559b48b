import contextlib
import math
from dataclasses import fields, replace

import numpy as np
import pytest
from weak_convex_decomposition.core.errors import DecompositionError
from weak_convex_decomposition.core.parameters.parameter import info_of
from weak_convex_decomposition.core.parameters.parts import Parameters

FIELDS = {field.name: field for field in fields(Parameters)}
NUMBERS = {name: f for name, f in FIELDS.items() if not info_of(f).choices}
CHOICES = {name: f for name, f in FIELDS.items() if info_of(f).choices}
REALS = {name: f for name, f in NUMBERS.items() if isinstance(f.default, float)}
# Every part number is allowed together with every other value of one field.
ROOMY = Parameters(samples=10000, min_parts=2, max_parts=256)


def sentence(error):
    text = str(error.value)
    assert text[0].isupper() or text[0].isdigit()
    assert text.endswith(".")
    return text


@pytest.mark.parametrize("name", NUMBERS)
def test_the_bounds_themselves_are_allowed(name):
    info = info_of(NUMBERS[name])
    kind = type(NUMBERS[name].default)
    for bound in (info.low, info.high):
        others = {"parts": 0} if name == "samples" else {}
        others |= {"min_parts": 2} if name == "max_parts" else {}
        others[name] = kind(bound)
        assert getattr(replace(ROOMY, **others), name) == bound


@pytest.mark.parametrize("name", NUMBERS)
@pytest.mark.parametrize("side", ["low", "high"])
def test_a_number_out_of_bounds_is_refused_by_name(name, side):
    info = info_of(NUMBERS[name])
    bound = getattr(info, side)
    step = 1 if name not in REALS else 0.01 * max(1.0, abs(bound))
    with pytest.raises(DecompositionError) as error:
        replace(ROOMY, **{name: bound + (step if side == "high" else -step)})
    text = sentence(error)
    assert text.startswith(f"{info.label} is ")
    assert f"from {info.low:g} to {info.high:g}" in text


@pytest.mark.parametrize("name", REALS)
def test_bounds_survive_single_precision(name):
    info = info_of(REALS[name])
    for bound in (info.low, info.high, REALS[name].default):
        replace(ROOMY, **{name: float(np.float32(bound))})


@pytest.mark.parametrize("name", NUMBERS)
@pytest.mark.parametrize("value", [math.nan, math.inf, "many", None, True, 2 + 0j])
def test_what_is_not_a_number_is_refused(name, value):
    with pytest.raises(DecompositionError, match="must be a") as error:
        replace(ROOMY, **{name: value})
    assert info_of(NUMBERS[name]).label in sentence(error)


@pytest.mark.parametrize("name", NUMBERS.keys() - REALS.keys())
def test_whole_numbers_have_no_fractions(name):
    with pytest.raises(DecompositionError, match="whole number"):
        replace(ROOMY, **{name: NUMBERS[name].default + 0.5})


def test_a_whole_number_is_refused_as_a_float_or_becomes_an_integer():
    with contextlib.suppress(DecompositionError):
        assert type(Parameters(parts=3.0).parts) is int


@pytest.mark.parametrize("name", CHOICES)
def test_choices_are_allowed_and_others_refused(name):
    info = info_of(CHOICES[name])
    for choice in info.choices:
        replace(ROOMY, **{name: choice.identifier})
    for wrong in ("NONSENSE", info.choices[0].identifier.lower(), 0, None):
        with pytest.raises(DecompositionError) as error:
            replace(ROOMY, **{name: wrong})
        text = sentence(error)
        assert text.startswith(f"{info.label} cannot be")
        assert all(choice.identifier in text for choice in info.choices)


def test_fewest_parts_above_most_parts_are_refused():
    Parameters(min_parts=5, max_parts=5)
    with pytest.raises(DecompositionError, match="Fewest Parts") as error:
        Parameters(min_parts=6, max_parts=5)
    assert "Most Parts" in sentence(error)


def test_more_parts_than_samples_are_refused():
    Parameters(parts=100, samples=100)
    with pytest.raises(DecompositionError, match="100 samples") as error:
        Parameters(parts=101, samples=100)
    assert "101 parts" in sentence(error)


def test_parameters_cannot_be_changed():
    with pytest.raises(AttributeError):
        Parameters().parts = 3
