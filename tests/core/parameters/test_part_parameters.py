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


def refusal(**values):
    """Return the sentence that refuses these values, None where they are allowed."""
    try:
        replace(ROOMY, **values)
    except DecompositionError as error:
        return str(error)
    return None


def assert_sentence(text, *words, case):
    assert text, f"{case} is allowed"
    assert text[0].isupper() or text[0].isdigit(), case
    assert text.endswith("."), case
    for word in words:
        assert word in text, f"{case}: no {word!r} in {text!r}"


def test_the_bounds_themselves_are_allowed():
    assert len(NUMBERS) > 10
    for name, field in NUMBERS.items():
        info = info_of(field)
        for bound in (info.low, info.high):
            others = {"parts": 0} if name == "samples" else {}
            others |= {"min_parts": 2} if name == "max_parts" else {}
            others[name] = type(field.default)(bound)
            assert refusal(**others) is None, f"{name} = {bound}"
            assert getattr(replace(ROOMY, **others), name) == bound, name


def test_a_number_out_of_bounds_is_refused_by_name():
    for name, field in NUMBERS.items():
        info = info_of(field)
        steps = [
            1 if name not in REALS else 0.01 * max(1.0, abs(bound))
            for bound in (info.low, info.high)
        ]
        for value in (info.low - steps[0], info.high + steps[1]):
            text = refusal(**{name: value})
            case = f"{name} = {value}"
            style = "g" if name in REALS else ".0f"
            bounds = f"from {info.low:{style}} to {info.high:{style}}"
            assert_sentence(text, bounds, case=case)
            assert text.startswith(f"{info.label} is "), case


def test_bounds_survive_single_precision():
    assert len(REALS) > 3
    for name, field in REALS.items():
        info = info_of(field)
        for bound in (info.low, info.high, field.default):
            value = float(np.float32(bound))
            assert refusal(**{name: value}) is None, f"{name} = {value}"


def test_what_is_not_a_number_is_refused():
    for name, field in NUMBERS.items():
        for value in (math.nan, math.inf, "many", None, True, 2 + 0j):
            text = refusal(**{name: value})
            label = info_of(field).label
            assert_sentence(text, "must be a", label, case=f"{name} = {value!r}")


def test_whole_numbers_have_no_fractions():
    assert NUMBERS.keys() - REALS.keys()
    for name in NUMBERS.keys() - REALS.keys():
        for value in (NUMBERS[name].default + 0.5, float(NUMBERS[name].default)):
            text = refusal(**{name: value})
            assert_sentence(text, "whole number", case=f"{name} = {value}")


def test_numbers_of_numpy_become_those_of_python():
    kept = Parameters(parts=np.int64(3), alpha=np.float32(0.5))
    assert (kept.parts, kept.alpha) == (3, 0.5)
    assert type(kept.parts) is int
    assert type(kept.alpha) is float


def test_choices_are_allowed_and_others_refused():
    assert CHOICES
    for name, field in CHOICES.items():
        info = info_of(field)
        names = [choice.identifier for choice in info.choices]
        for value in names:
            assert refusal(**{name: value}) is None, f"{name} = {value}"
        for wrong in ("NONSENSE", names[0].lower(), 0, None):
            text, case = refusal(**{name: wrong}), f"{name} = {wrong!r}"
            assert_sentence(text, f"{info.label} cannot be", *names, case=case)


def test_fewest_parts_above_most_parts_are_refused():
    assert refusal(min_parts=5, max_parts=5) is None
    text = refusal(min_parts=6, max_parts=5)
    assert_sentence(text, "Fewest Parts", "Most Parts", case="6 above 5")


def test_more_parts_than_samples_are_refused():
    assert refusal(parts=100, samples=100) is None
    text = refusal(parts=101, samples=100)
    assert_sentence(text, "100 samples", "101 parts", case="101 of 100")


def test_parameters_cannot_be_changed():
    with pytest.raises(AttributeError):
        Parameters().parts = 3
