"""The versions of a record: that of the present parts, and those before.

In Edit Mode, undo brings back faces, but no custom property. So a record keeps what it
was before each edit there, and the version that fits the faces counts.
"""

from __future__ import annotations

from typing import Any

from .identity import Identity

# What a record was before the edits of Edit Mode, the latest first.
PAST = "past"
# Where the entry of a part keeps the fingerprint of the faces it was measured on.
MEASURED_ON = "measured_on"
_KEPT = 64
# What a record says of parts.
_OF_PARTS = (
    "parameters",
    "mesh",
    "seed",
    "k",
    "psi",
    "psi_before",
    "psi_by_k",
    "best_k",
    "parts",
    "notes",
)


def versions_of(record: dict[str, Any]) -> list[dict[str, Any]]:
    """Return all versions of a record, the latest first."""
    return [record, *record.get(PAST, ())]


def past_with(record: dict[str, Any]) -> list[dict[str, Any]]:
    """Return the past of a record together with the record itself."""
    versions = versions_of(record)[:_KEPT]
    return [{key: each[key] for key in _OF_PARTS if key in each} for each in versions]


def entries_of(record: dict[str, Any], number: int) -> list[dict[str, Any]]:
    """Return all entries of a part, the latest first."""
    return [
        entry
        for version in versions_of(record)
        for entry in version.get("parts", ())
        if entry["number"] == number
    ]


def change_entries(record: dict[str, Any], number: int, change: dict[str, Any]) -> bool:
    """Change all entries of a part; return whether there is one."""
    entries = entries_of(record, number)
    for entry in entries:
        entry.update(change)
    return bool(entries)


def identities_of(record: dict[str, Any]) -> tuple[Identity, ...]:
    """Return who the parts of a record are, in its order; then those of its past."""
    entries: dict[int, dict[str, Any]] = {}
    for version in versions_of(record):
        for entry in version.get("parts", ()):
            entries.setdefault(entry["number"], entry)
    return tuple(
        Identity(number, each["name"], _color(each["color"]))
        for number, each in entries.items()
    )


def psi_by_k_of(record: dict[str, Any]) -> dict[int, float]:
    """Return psi by the number of parts; JSON makes these numbers texts."""
    return {int(k): psi for k, psi in record.get("psi_by_k", {}).items()}


def n_faces_of(record: dict[str, Any]) -> int:
    """Return how many faces, or points, had parts when they were noted."""
    return sum(part["faces"] for part in record.get("parts", ()))


def _color(noted: list[float]) -> tuple[float, float, float]:
    red, green, blue = noted[:3]
    return red, green, blue
