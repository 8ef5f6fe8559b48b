"""The record of a result: JSON that people, programs and the sidebar read."""

from __future__ import annotations

import json
from typing import Any


def parse_record(noted: object) -> dict[str, Any] | None:
    """Return a record from what a custom property holds, None if it is none of ours."""
    record = parse_json(noted)
    return record if record and "version" in record else None


def parse_json(noted: object) -> dict[str, Any] | None:
    """Return the JSON object that a custom property holds, None if it holds none."""
    try:
        found = json.loads(noted) if isinstance(noted, str) else None
    except ValueError:
        return None
    return found if isinstance(found, dict) else None
