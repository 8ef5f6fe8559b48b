"""Values that are found once and kept for the next time."""

from __future__ import annotations

from collections.abc import Callable, Hashable
from typing import Generic, TypeVar

from .progress import Steps

Key = TypeVar("Key", bound=Hashable)
Value = TypeVar("Value")


class Memo(Generic[Key, Value]):
    """Keeps the values of some keys.

    Parameters
    ----------
    most : int, optional
        Number of keys that are kept. The key used longest ago is forgotten first. All
        are kept if left out.
    """

    def __init__(self, most: int | None = None) -> None:
        self._most = most
        self._values: dict[Key, Value] = {}

    def recall(self, key: Key, make: Callable[[], Value]) -> Value:
        """Return the value of a key. The first time, `make` finds it."""
        value = self._values.pop(key) if key in self._values else make()
        self._values[key] = value
        if self._most is not None and len(self._values) > self._most:
            del self._values[next(iter(self._values))]
        return value

    def recall_steps(self, key: Key, make: Callable[[], Steps[Value]]) -> Steps[Value]:
        """Return the value of a key. The first time, the steps of `make` find it."""
        value = self._values[key] if key in self._values else (yield from make())
        return self.recall(key, lambda: value)
