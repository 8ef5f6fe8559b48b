"""Pictures of what parts come from: matrices sorted by part, and the embedding."""

from __future__ import annotations

from collections.abc import Callable
from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray
from scipy import sparse

from .parameters.parts import Parameters
from .parts.part_memo import PartMemo
from .results import Picture

Pixels: TypeAlias = NDArray[np.float64]

# Rows and columns of a matrix that are drawn, at most.
_MOST_ROWS = 1500
# Width of the margins in the colors of the parts, and pixels of a row if there are few.
_MARGIN = 12
_LEAST_SIZE = 600
# Of a scatter: pixels along a side, and of a dot's radius.
_SIZE = 900
_DOT = 4
# Percentiles of coordinates between which a scatter is drawn to scale.
_INNER = (3.0, 97.0)


def draw_picture(
    kind: str,
    memo: PartMemo,
    labels: NDArray[np.int64],
    parameters: Parameters,
    colors: NDArray[np.float64],
) -> Picture:
    """Draw one of `parameters.choices.PICTURES`.

    Parameters
    ----------
    kind : str
        Identifier of the picture.
    memo : PartMemo
        The visibility that the parts were found from.
    labels : (P,) int
        Part of each polygon, or point of a cloud.
    parameters : Parameters
        That parts were found with.
    colors : (K, 3) float
        sRGB of each part.
    """
    visibility = memo.visibility
    nodes = visibility.shape.labels_of_nodes(labels)
    of_samples = visibility.transfer.to_samples(nodes)
    pixels = _DRAWN[kind](memo, parameters, of_samples, colors)
    return Picture(pixels, visibility.shape.notes)


def _sight(
    memo: PartMemo,
    parameters: Parameters,
    labels: NDArray[np.int64],
    colors: NDArray[np.float64],
) -> Pixels:
    """Return the LoS matrix sorted by part: black where samples see each other."""
    rows = _by_part(labels)
    affinity = sparse.csr_array(memo.visibility.affinity)
    visible = affinity[rows][:, rows].toarray() > 0
    return _matrix(np.where(visible, 0.0, 1.0), colors[labels[rows]])


def _distances(
    memo: PartMemo,
    parameters: Parameters,
    labels: NDArray[np.int64],
    colors: NDArray[np.float64],
) -> Pixels:
    """Return the distances in the embedding sorted by part: black where none."""
    rows = _by_part(labels)
    places = _places(memo, parameters, labels)[rows]
    squares = (places**2).sum(axis=1)
    distances = squares[:, None] + squares - 2 * places @ places.T
    distances = np.sqrt(np.maximum(distances, 0.0))
    apart = labels[rows][:, None] != labels[rows]
    # A few samples are far from all others, and would leave the rest black.
    white = np.median(distances[apart if apart.any() else ~apart])
    grays = np.minimum(distances / max(white, np.finfo(float).tiny), 1.0)
    return _matrix(grays, colors[labels[rows]])


def _scatter(
    memo: PartMemo,
    parameters: Parameters,
    labels: NDArray[np.int64],
    colors: NDArray[np.float64],
) -> Pixels:
    """Return the samples in a plane of the embedding in which parts are apart."""
    places = _places(memo, parameters, labels)
    sizes = np.bincount(labels)
    totals = np.stack([np.bincount(labels, axis) for axis in places.T], axis=1)
    middles = totals[sizes > 0] / sizes[sizes > 0, None]
    _, _, axes = np.linalg.svd(middles - middles.mean(axis=0))
    flat = np.zeros((len(places), 2))
    flat[:, : len(axes)] = (places - middles.mean(axis=0)) @ axes[:2].T
    # A few samples are far from all others: they are put on the border.
    low, high = np.percentile(flat, _INNER, axis=0)
    extent = max(float((high - low).max()), np.finfo(float).tiny)
    shares = np.clip((flat - (low + high) / 2) / extent, -0.5, 0.5)
    columns, rows = np.rint(shares * (_SIZE - 4 * _DOT) + _SIZE / 2).T.astype(int)
    pixels = np.ones((_SIZE, _SIZE, 3))
    for down in range(-_DOT, _DOT + 1):
        for right in range(-_DOT, _DOT + 1):
            if down**2 + right**2 <= _DOT**2:
                pixels[_SIZE - 1 - rows + down, columns + right] = colors[labels]
    return pixels


def _places(
    memo: PartMemo, parameters: Parameters, labels: NDArray[np.int64]
) -> NDArray[np.float64]:
    """Return the coordinates of samples that told this number of parts apart."""
    n_coordinates = max(2, int(labels.max()) + 1)
    return memo.embedding(n_coordinates, parameters)[:, :n_coordinates]


def _by_part(labels: NDArray[np.int64]) -> NDArray[np.int64]:
    """Return the samples sorted by part, not more of them than can be drawn."""
    order = np.argsort(labels, kind="stable")
    n_rows = min(len(order), _MOST_ROWS)
    return order[np.arange(n_rows) * len(order) // n_rows]


def _matrix(grays: NDArray[np.float64], colors: NDArray[np.float64]) -> Pixels:
    """Return the picture of a matrix, with its rows' colors at its sides."""
    n_rows = len(grays)
    pixels = np.ones((n_rows + _MARGIN, n_rows + _MARGIN, 3))
    pixels[_MARGIN:, _MARGIN:] = grays[:, :, None]
    pixels[_MARGIN:, : _MARGIN - 2] = colors[:, None]
    pixels[: _MARGIN - 2, _MARGIN:] = colors
    times = -(-_LEAST_SIZE // n_rows)
    return pixels.repeat(times, axis=0).repeat(times, axis=1)


_DRAWN: dict[
    str,
    Callable[[PartMemo, Parameters, NDArray[np.int64], NDArray[np.float64]], Pixels],
] = {"SIGHT": _sight, "DISTANCES": _distances, "SCATTER": _scatter}
