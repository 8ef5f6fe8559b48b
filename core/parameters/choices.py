"""The choices of parameters that are not numbers, and of pictures."""

from __future__ import annotations

from .parameter import Choice

SIGHT = (
    Choice(
        "ALL_PAIRS",
        "All Pairs",
        "Between every two samples: the definition itself",
    ),
    Choice(
        "CONE",
        "Cone",
        "Rays in a cone around the inward normal, as in the paper:"
        " sparse, for many samples",
    ),
)

SAMPLING = (
    Choice(
        "AREA",
        "By Area",
        "Spread evenly over the surface, as many as Samples says",
    ),
    Choice(
        "FACES",
        "By Faces",
        "One on each triangle, small meshes being subdivided to 3000, as in the paper",
    ),
)

PSI_PAIRS = (
    Choice(
        "UNIFORM",
        "Uniform Pairs",
        "Pairs drawn at random: an estimate without bias",
    ),
    Choice(
        "RAYS",
        "Ray Hits",
        "Pairs that the cone's rays found, as in the paper: biased"
        " towards near and visible pairs",
    ),
)

CONTAINERS = (
    Choice(
        "FILLED",
        "Filled",
        "The enclosed outside counts as inside, so that thin walls around"
        " it stay whole; shapes that enclose nothing are not affected",
    ),
    Choice(
        "HOLLOW",
        "Hollow",
        "Lines of sight run through the inside alone, as in the paper",
    ),
)

NORMALIZATION = (
    Choice("LAPLACIAN", "Laplacian", "Symmetric, by both degrees"),
    Choice("STOCHASTIC", "Stochastic", "Each row sums to one"),
)

REFINEMENT = (
    Choice(
        "PSI",
        "Psi",
        "Samples change their part, and seams move, where psi gains by it",
    ),
    Choice(
        "EMBEDDING",
        "Embedding",
        "Clusters stay as they are and seams keep to them, as in the paper",
    ),
)

# Pictures of what parts come from.
PICTURES = (
    Choice(
        "SIGHT",
        "Lines of Sight",
        "The matrix of samples, sorted by part: black where two see each other. Parts"
        " that are convex are black squares",
    ),
    Choice(
        "DISTANCES",
        "Distances",
        "Distances of samples in the embedding, sorted by part: black where there is"
        " none. Parts that are well apart are dark squares on light ground",
    ),
    Choice(
        "SCATTER",
        "Embedding",
        "The samples in the embedding, seen where it extends most, in the colors of"
        " their parts",
    ),
)
