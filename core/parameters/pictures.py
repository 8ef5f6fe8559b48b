"""Which pictures there are of what parts come from."""

from __future__ import annotations

from .parameter import Choice

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
