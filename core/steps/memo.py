"""Values that are computed once and kept."""

from __future__ import annotations

from collections.abc import Callable, Hashable
from functools import wraps
from hashlib import blake2b
from typing import Generic, TypeVar

import numpy as np
from numpy.typing import NDArray

from .progress import Steps, T

Key = TypeVar("Key", bound=Hashable)
Value = TypeVar("Value")
Owner = TypeVar("Owner")


def digest(labels: NDArray[np.integer | np.bool_]) -> bytes:
    """Return a hash of labels or of a mask, to be used as a key.

    Parameters
    ----------
    labels : (P,) int or bool
        Not negative.

    Returns
    -------
    bytes
    """
    # Most labels fit into a byte: the fewer bytes, the quicker.
    narrow = np.min_scalar_type(int(labels.max(initial=0)))
    return blake2b(labels.astype(narrow).data).digest()


def computed_once(make: Callable[[Owner], Steps[T]]) -> Callable[[Owner], Steps[T]]:
    """Keep what is computed of an object in steps: with that object, from then on.

    Parameters
    ----------
    make : callable
        Takes the object alone, as a method does, and returns the steps.

    Returns
    -------
    callable
        Returns steps with the same value; none are left once it is known.
    """
    key = f"{make.__module__}.{make.__name__}"

    @wraps(make)
    def recall(owner: Owner) -> Steps[T]:
        if key not in owner.__dict__:
            owner.__dict__[key] = yield from make(owner)
        return owner.__dict__[key]

    return recall


class Memo(Generic[Key, Value]):
    """Stores computed values by key.

    Parameters
    ----------
    most : int, optional
        Most keys that are kept; the least recently used key is dropped first. Without
        `most`, all keys are kept.
    """

    def __init__(self, most: int | None = None) -> None:
        self._most = most
        self._values: dict[Key, Value] = {}

    def __contains__(self, key: Key) -> bool:
        """Return whether the value of a key is stored."""
        return key in self._values

    def __getitem__(self, key: Key) -> Value:
        """Return the value of a key that is stored."""
        return self._values[key]

    def recall(self, key: Key, make: Callable[[], Value]) -> Value:
        """Return the value of a key, and compute it if it is not stored.

        Parameters
        ----------
        key : hashable
        make : callable
            Returns the value. It is called only if the key is not stored.

        Returns
        -------
        value
        """
        value = self._values.pop(key) if key in self._values else make()
        self._values[key] = value
        if self._most is not None and len(self._values) > self._most:
            del self._values[next(iter(self._values))]
        return value

    def recall_steps(self, key: Key, make: Callable[[], Steps[Value]]) -> Steps[Value]:
        """Return the value of a key, and compute it in steps if it is not stored.

        Parameters
        ----------
        key : hashable
        make : callable
            Returns the steps that compute the value. It is called only if the key is
            not stored.

        Returns
        -------
        Steps of the value
        """
        value = self._values[key] if key in self._values else (yield from make())
        return self.recall(key, lambda: value)
