"""Values that are worth keeping: found once, and found again the next time."""

from __future__ import annotations

from collections.abc import Callable, Hashable
from typing import Any, TypeVar

from .progress import Steps

T = TypeVar("T")


class Memo:
    """Keeps the values of some keys.

    Parameters
    ----------
    most : int, optional
        Number of keys; those asked for longest ago are forgotten. All are kept if not
        given.
    """

    def __init__(self, most: int | None = None) -> None:
        self._most = most
        self._values: dict[Hashable, Any] = {}

    def recall(self, key: Hashable, make: Callable[[], T]) -> T:
        """Return the value of a key, made by `make` the first time."""
        value: T = self._values.pop(key) if key in self._values else make()
        self._values[key] = value
        if self._most is not None and len(self._values) > self._most:
            del self._values[next(iter(self._values))]
        return value

    def recall_steps(self, key: Hashable, make: Callable[[], Steps[T]]) -> Steps[T]:
        """Return the value of a key, the first time that of the steps of `make`."""
        if key in self._values:
            value: T = self._values[key]
        else:
            value = yield from make()
        return self.recall(key, lambda: value)
