"""Which form our notes have. What was edited by hand may have another.

A form is a type, a list of the form of all members, a dict of those of keys, a tuple of
forms of which one has to fit, or a function that tells. Keys with "?" may be missing.
"""

from __future__ import annotations

from typing import Any, TypeAlias

Form: TypeAlias = Any


def has_form(noted: Any, form: Form) -> bool:
    """Return whether JSON has a form."""
    if isinstance(form, dict):
        is_dict = isinstance(noted, dict)
        return is_dict and all(_has_key(noted, *each) for each in form.items())
    if isinstance(form, list):
        is_list = isinstance(noted, list)
        return is_list and all(has_form(each, form[0]) for each in noted)
    if isinstance(form, tuple):
        return any(has_form(noted, each) for each in form)
    return isinstance(noted, form) if isinstance(form, type) else bool(form(noted))


def _has_key(noted: dict[str, Any], name: str, form: Form) -> bool:
    key = name.removesuffix("?")
    return has_form(noted[key], form) if key in noted else key != name


def _is_color(noted: Any) -> bool:
    return has_form(noted, [_NUMBER]) and len(noted) >= 3


def _is_psi_by_k(noted: Any) -> bool:
    return has_form(noted, dict) and all(
        k.isdecimal() and has_form(psi, _NUMBER) for k, psi in noted.items()
    )


NONE = type(None)
_NUMBER = (int, float)
_FIGURE = (int, float, NONE)
_COMMON = {"measured_on?": [_NUMBER], "notes?": [str]}
_PART = {"number": int, "name": str, "color": _is_color, "material": (str, NONE)}
_PART |= {"faces": int, "convexity_rank": _FIGURE, **_COMMON}
_MEASURED = {"convexity_rank": _NUMBER, "standard_error": _NUMBER, **_COMMON}
_HULL = {"name": str, "kind": str, "vertices": int, "part": (int, NONE)}
_HULL |= {"error": _NUMBER, "volume": _NUMBER}
_HULLS = {"hulls": [_HULL], "parameters?": dict, "volume_ratio": _FIGURE, **_COMMON}
# The record of an object.
RECORD = {
    "version": str,
    "parameters?": dict,
    "k?": int,
    "best_k?": int,
    "psi?": _FIGURE,
    "psi_before?": _FIGURE,
    "psi_by_k?": _is_psi_by_k,
    "parts?": [_PART],
    "measured?": _MEASURED,
    "selection?": {"faces": int, **_MEASURED},
    "hulls?": _HULLS,
    **_COMMON,
}
