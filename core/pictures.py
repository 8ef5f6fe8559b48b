"""Diagrams of a decomposition: matrices sorted by part, and the embedding (fig. 7)."""

from __future__ import annotations

import numpy as np
from scipy import sparse

from .geometry.labels import sums_by_label
from .parameters.parts import Parameters
from .parts.part_memo import PartMemo
from .results.views import Picture
from .sight.pair_visibility import Matrix
from .steps.arrays import FloatArray, IntArray
from .steps.one_thread import on_one_thread
from .steps.progress import Progress, Steps, run

# Largest number of rows and columns of a matrix that are drawn.
_MOST_ROWS = 1500
# Width in rows of the margins that show the colors of the parts.
_MARGIN = 12
# Rows of a small matrix are repeated until it has this many pixels along a side.
_LEAST_SIZE = 600
# Pixels along a side of the scatter plot, and radius of a dot in pixels.
_SIZE = 900
_DOT = 4
# Percentiles of coordinates that the scatter plot spans; dots beyond lie on its border.
_INNER = (3.0, 97.0)


def draw_picture(
    kind: str,
    memo: PartMemo,
    labels: IntArray,
    parameters: Parameters,
    colors: FloatArray,
) -> Picture:
    """Draw one of the pictures that `parameters.choices.PICTURES` lists.

    Parameters
    ----------
    kind : str
        Identifier of the picture.
    memo : PartMemo
        The visibility that the parts were found from.
    labels : (P,) int
        Part of each polygon, or of each point of a cloud, in 0…K − 1.
    parameters : Parameters
        The parameters that the parts were found with.
    colors : (K, 3) float
        sRGB of each part, from 0 to 1.

    Returns
    -------
    Picture
    """
    visibility = memo.visibility
    of_samples = visibility.shape.labels_of_nodes(labels)[visibility.nodes]
    steps = _pixels(kind, memo, parameters, of_samples, colors)
    return Picture(run(steps), visibility.shape.notes)


@on_one_thread
def _pixels(
    kind: str,
    memo: PartMemo,
    parameters: Parameters,
    labels: IntArray,
    colors: FloatArray,
) -> Steps[FloatArray]:
    """Return the pixels of a picture.

    If no parts were found before, `memo` keeps the embedding that the picture makes.
    Parts are found from it later, so it must not depend on the number of cores.
    """
    yield Progress("Picture", 0.0)
    if kind == "SIGHT":
        return _sight(memo.visibility.affinity, labels, colors)
    # One coordinate for each part; a plane for a single one.
    n_coordinates = max(2, int(labels.max()) + 1)
    places = memo.embedding(n_coordinates, parameters)[:, :n_coordinates]
    draw = _distances if kind == "DISTANCES" else _scatter
    return draw(places, labels, colors)


def _sight(affinity: Matrix, labels: IntArray, colors: FloatArray) -> FloatArray:
    """Return the LoS matrix sorted by part: visible pairs are black."""
    rows = _by_part(labels)
    visible = sparse.csr_array(affinity)[rows][:, rows].toarray() > 0
    return _matrix(np.where(visible, 0.0, 1.0), colors[labels[rows]])


def _distances(places: FloatArray, labels: IntArray, colors: FloatArray) -> FloatArray:
    """Return distances of samples in the embedding, sorted by part: 0 is black."""
    rows = _by_part(labels)
    places = places[rows]
    squares = (places**2).sum(axis=1)
    distances = squares[:, None] + squares - 2 * places @ places.T
    distances = np.sqrt(np.maximum(distances, 0.0))
    apart = labels[rows][:, None] != labels[rows]
    # White is the median, not the maximum: a few far samples would turn the rest black.
    white = np.median(distances[apart if apart.any() else ~apart])
    grays = np.minimum(distances / max(white, np.finfo(float).tiny), 1.0)
    return _matrix(grays, colors[labels[rows]])


def _scatter(places: FloatArray, labels: IntArray, colors: FloatArray) -> FloatArray:
    """Return a plot of the samples in the plane of the embedding that spreads parts.

    The plane is spanned by the principal axes of the parts' centers.
    """
    sizes = np.bincount(labels)
    totals = sums_by_label(places, labels, len(sizes))
    middles = totals[sizes > 0] / sizes[sizes > 0, None]
    _, _, axes = np.linalg.svd(middles - middles.mean(axis=0))
    flat = np.zeros((len(places), 2))
    flat[:, : len(axes)] = (places - middles.mean(axis=0)) @ axes[:2].T
    # A few samples are far from all others: draw them on the border.
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


def _by_part(labels: IntArray) -> IntArray:
    """Return samples sorted by part, evenly thinned to at most `_MOST_ROWS`."""
    order = np.argsort(labels, kind="stable")
    n_rows = min(len(order), _MOST_ROWS)
    return order[np.arange(n_rows) * len(order) // n_rows]


def _matrix(grays: FloatArray, colors: FloatArray) -> FloatArray:
    """Return the pixels of a matrix, with part colors on the left and top margins."""
    n_rows = len(grays)
    pixels = np.ones((n_rows + _MARGIN, n_rows + _MARGIN, 3))
    pixels[_MARGIN:, _MARGIN:] = grays[:, :, None]
    pixels[_MARGIN:, : _MARGIN - 2] = colors[:, None]
    pixels[: _MARGIN - 2, _MARGIN:] = colors
    times = -(-_LEAST_SIZE // n_rows)
    return pixels.repeat(times, axis=0).repeat(times, axis=1)
