"""What a record says of the parts: who they are, and what psi was."""

from __future__ import annotations

from typing import Any

from .identity import Identity, rgb


def entry_of(record: dict[str, Any], number: int) -> dict[str, Any] | None:
    """Return the entry of a part, None if there is none."""
    parts = record.get("parts", ())
    return next((entry for entry in parts if entry["number"] == number), None)


def identities_of(record: dict[str, Any]) -> tuple[Identity, ...]:
    """Return who the parts of a record are, in its order."""
    return tuple(
        Identity(each["number"], each["name"], rgb(each["color"]))
        for each in record.get("parts", ())
    )


def psi_by_k_of(record: dict[str, Any]) -> dict[int, float]:
    """Return psi by the number of parts; JSON makes these numbers texts."""
    return {int(k): psi for k, psi in record.get("psi_by_k", {}).items()}


def n_faces_of(record: dict[str, Any]) -> int:
    """Return how many faces, or points, had parts when they were noted."""
    return sum(part["faces"] for part in record.get("parts", ()))
