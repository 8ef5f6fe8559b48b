"""Pictures as arrays: put together, and written as small PNG files."""

from __future__ import annotations

import struct
import zlib
from pathlib import Path

import numpy as np
from scipy.spatial import cKDTree
from sklearn.cluster import MiniBatchKMeans

BACKGROUND = 0.96
_N_COLORS = 200
_GAP = 12  # pixels between panels


def beside(panels: list[np.ndarray]) -> np.ndarray:
    """Return panels in a row, centered on a common height."""
    height = max(len(panel) for panel in panels)
    columns = [np.full((height, _GAP, 3), BACKGROUND)]
    for panel in panels:
        columns += [_padded(panel, height, panel.shape[1]), columns[0]]
    return np.concatenate(columns, axis=1)


def below(rows: list[np.ndarray]) -> np.ndarray:
    """Return rows one below the other, centered on a common width."""
    width = max(row.shape[1] for row in rows)
    return np.concatenate([_padded(row, len(row), width) for row in rows])


def resized(pixels: np.ndarray, size: int, darkest: bool = False) -> np.ndarray:
    """Return a square picture of `size` pixels a side: averages, or darkest pixels."""
    if not darkest:
        edges = np.linspace(0, len(pixels), size + 1).round().astype(int)
        rows = np.add.reduceat(pixels, edges[:-1]) / np.diff(edges)[:, None, None]
        columns = np.add.reduceat(rows, edges[:-1], axis=1)
        return columns / np.diff(edges)[None, :, None]
    step = len(pixels) // size
    tiles = pixels[: step * size, : step * size].reshape(size, step, size, step, 3)
    tiles = tiles.swapaxes(1, 2).reshape(size, size, step * step, 3)
    chosen = tiles.sum(axis=3).argmin(axis=2)[:, :, None, None]
    return np.take_along_axis(tiles, chosen, axis=2)[:, :, 0]


def _padded(pixels: np.ndarray, height: int, width: int) -> np.ndarray:
    """Return a picture in the middle of a larger one."""
    large = np.full((height, width, 3), BACKGROUND)
    top, left = (height - len(pixels)) // 2, (width - pixels.shape[1]) // 2
    large[top : top + len(pixels), left : left + pixels.shape[1]] = pixels
    return large


def save(path: Path, pixels: np.ndarray) -> None:
    """Write a picture, (H, W, 3) in 0…1, as a PNG file with a palette."""
    height, width, _ = pixels.shape
    flat = np.rint(np.clip(pixels, 0, 1) * 255).astype(np.uint8).reshape(-1, 3)
    palette, places = _quantized(flat)
    rows = np.zeros((height, width + 1), dtype=np.uint8)  # filter 0 in each row
    rows[:, 1:] = places.reshape(height, width)
    header = struct.pack(">IIBBBBB", width, height, 8, 3, 0, 0, 0)
    chunks = [
        (b"IHDR", header),
        (b"PLTE", palette.tobytes()),
        (b"IDAT", zlib.compress(rows.tobytes(), 9)),
        (b"IEND", b""),
    ]
    data = b"\x89PNG\r\n\x1a\n"
    for kind, body in chunks:
        check = zlib.crc32(kind + body)
        data += struct.pack(">I", len(body)) + kind + body + struct.pack(">I", check)
    path.write_bytes(data)


def _quantized(flat: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return a palette, (K, 3) uint8, and the entry of each pixel."""
    colors, which, counts = np.unique(
        flat, axis=0, return_inverse=True, return_counts=True
    )
    if len(colors) > _N_COLORS:
        # Rare colors are edges and details: they count more than their area.
        fit = MiniBatchKMeans(_N_COLORS, random_state=0, n_init=1, batch_size=4096)
        fit.fit(colors, sample_weight=np.sqrt(counts))
        palette = np.rint(fit.cluster_centers_).astype(np.uint8)
    else:
        palette = colors
    _, nearest = cKDTree(palette).query(colors)
    return palette, nearest[which.ravel()].astype(np.uint8)
