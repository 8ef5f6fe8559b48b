"""Lists the choices of parameters that are not numbers, and the pictures."""

from __future__ import annotations

from .parameter import Choice

SIGHT = (
    Choice(
        "BLOCKS",
        "Blocks",
        "Test a few pairs of every sample, and more only where pairs of samples near"
        " these, which face the same way, disagree: several times fewer rays than All"
        " Pairs, and parts as good",
    ),
    Choice(
        "ALL_PAIRS",
        "All Pairs",
        "Test every pair of samples, as convexity is defined",
    ),
    Choice(
        "CONE",
        "Cone",
        "Cast rays in a cone into the shape from each sample, as in the paper: fewer"
        " lines per sample, for many samples",
    ),
)

SAMPLING = (
    Choice(
        "AREA",
        "By Area",
        "Spread samples evenly over the surface; Samples sets their number",
    ),
    Choice(
        "FACES",
        "By Faces",
        "Place one sample on each triangle, as in the paper; meshes of fewer than 2000"
        " triangles are subdivided to 3000 first",
    ),
)

PSI_PAIRS = (
    Choice(
        "UNIFORM",
        "Uniform Pairs",
        "Up to 60,000 pairs drawn at random, for at most half of Rays: an unbiased"
        " estimate",
    ),
    Choice(
        "RAYS",
        "Ray Hits",
        "Pairs that the rays in cones found, as in the paper: a biased estimate, with"
        " too many near and visible pairs",
    ),
)

CONTAINERS = (
    Choice(
        "FILLED",
        "Filled",
        "Lines of sight may cross the hollow, so that the thin walls around it stay in"
        " one part; shapes without a hollow do not change",
    ),
    Choice(
        "HOLLOW",
        "Hollow",
        "Lines of sight stay inside the material, as in the paper",
    ),
)

NORMALIZATION = (
    Choice(
        "LAPLACIAN",
        "Laplacian",
        "Divide by the square roots of the sums of its row and its column",
    ),
    Choice("STOCHASTIC", "Stochastic", "Divide each row by its sum"),
)

REFINEMENT = (
    Choice(
        "PSI",
        "Psi",
        "Move samples to other parts, and move seams, where this raises psi, the score"
        " of the parts",
    ),
    Choice(
        "EMBEDDING",
        "Embedding",
        "Keep the clusters as they are, with seams close to their borders, as in the"
        " paper",
    ),
)

SEAMS = (
    Choice(
        "KEEP",
        "Keep Faces",
        "Seams follow the edges that are there; no face is cut",
    ),
    Choice(
        "CUT",
        "Cut Faces",
        "Large faces are cut where parts meet on them, in Object Mode. Clear brings the"
        " whole faces back, unless the mesh was edited since",
    ),
)

BENDS = (
    Choice(
        "CUT",
        "Cut Bends",
        "Parts end where lines of sight do: a ring becomes four parts or more",
    ),
    Choice(
        "KEEP",
        "Keep Bends",
        "Neighbors of one thickness become one part, unless there is a crease or a neck"
        " between them: rings, horseshoes and bent arms stay whole",
    ),
)

# Pictures that `pictures.draw_picture` draws.
PICTURES = (
    Choice(
        "SIGHT",
        "Lines of Sight",
        "A matrix of all pairs of samples, sorted by part: black where two samples see"
        " each other. A convex part is a black square",
    ),
    Choice(
        "DISTANCES",
        "Distances",
        "A matrix of the distances between samples in the embedding, sorted by part:"
        " black is distance 0. Distinct parts are dark squares on a light ground",
    ),
    Choice(
        "SCATTER",
        "Embedding",
        "The samples as dots in the embedding, seen from where the parts are farthest"
        " apart, in the colors of their parts",
    ),
)
