"""The Princeton Segmentation Benchmark: its files, its measure, what was published.

Its layout is off/N.off and seg/Benchmark/N/N_k.seg, one number a face.
"""

import statistics
from pathlib import Path

import checkout  # noqa: F401  # makes the package importable
import numpy as np
from weak_convex_decomposition.core.geometry.mesh import TriangleMesh

# fmt: off
CATEGORIES = (
    "Human", "Cup", "Glasses", "Airplane", "Ant", "Chair", "Octopus", "Table",
    "Teddy", "Hand", "Plier", "Fish", "Bird", "Spring", "Armadillo", "Bust", "Mech",
    "Bearing", "Vase", "FourLeg",
)
# fmt: on
# Of the whole benchmark, by Chen, Golovinskiy and Funkhouser 2009. All but the
# humans' own are quoted from memory and approximate.
PUBLISHED = (
    ("Humans among themselves", 0.103, "recomputed"),
    ("Randomized Cuts", 0.152, "k given"),
    ("Normalized Cuts", 0.172, "k given"),
    ("Shape Diameter", 0.175, "automatic"),
    ("Core Extraction", 0.210, "automatic"),
    ("Fitting Primitives", 0.214, "k given"),
    ("Random Walks", 0.218, "k given"),
    ("K-Means", 0.251, "k given"),
)


def models(directory: Path) -> list[int]:
    """Return the numbers of all models, in order."""
    return sorted(int(path.stem) for path in (directory / "off").glob("*.off"))


def category(model: int) -> str:
    """Return the name of a model's category: there are twenty of each."""
    return CATEGORIES[(model - 1) // 20]


def read_model(directory: Path, model: int) -> TriangleMesh:
    """Return the mesh of a model; the files hold triangles and no comments.

    Blender has no part in it: CoACD does not run in one process with bpy.
    """
    words = (directory / "off" / f"{model}.off").read_text().split()
    n_vertices, n_triangles = int(words[1]), int(words[2])
    start = 4 + 3 * n_vertices
    vertices = np.array(words[4:start], dtype=float).reshape(-1, 3)
    rows = np.array(words[start : start + 4 * n_triangles], dtype=int).reshape(-1, 4)
    return TriangleMesh(vertices, rows[:, 1:], np.arange(n_triangles))


def read_humans(directory: Path, model: int) -> list[np.ndarray]:
    """Return the labels of the faces by every human who segmented a model."""
    folder = directory / "seg/Benchmark" / str(model)
    return [np.loadtxt(path, dtype=int) for path in sorted(folder.glob("*.seg"))]


def median_count(humans: list[np.ndarray]) -> int:
    """Return the median number of parts of some segmentations."""
    return int(np.median([len(np.unique(human)) for human in humans]))


def mean_error(labels: np.ndarray, humans: list[np.ndarray]) -> float:
    """Return the Rand Index error of some labels, the mean over humans."""
    return statistics.fmean(rand_index_error(labels, human) for human in humans)


def overlaps(labels: np.ndarray, others: np.ndarray) -> np.ndarray:
    """Return how many faces have each two of the labels 0…K - 1 and 0…L - 1, (K, L)."""
    shape = int(labels.max()) + 1, int(others.max()) + 1
    pairs = np.ravel_multi_index((labels, others), shape)
    return np.bincount(pairs, minlength=shape[0] * shape[1]).reshape(shape)


def rand_index_error(labels: np.ndarray, truth: np.ndarray) -> float:
    """Return the share of pairs of faces on which two segmentations disagree."""
    _, labels = np.unique(labels, return_inverse=True)
    _, truth = np.unique(truth, return_inverse=True)
    table = overlaps(labels, truth).astype(float)
    ours, theirs = table.sum(axis=1), table.sum(axis=0)
    agreed = (table**2).sum()
    pairs = len(labels) * (len(labels) - 1) / 2
    return (((ours**2).sum() + (theirs**2).sum()) / 2 - agreed) / pairs
