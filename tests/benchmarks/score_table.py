"""The figures of a benchmark as a table: by category, and model by model."""

import statistics
from collections.abc import Callable, Sequence
from dataclasses import dataclass

from princeton import CATEGORIES, PUBLISHED, category

GROUPS = {
    "all": CATEGORIES,
    "without cups": tuple(name for name in CATEGORIES if name != "Cup"),
    "Mech and Bearing": ("Mech", "Bearing"),
    "Bust and Fish": ("Bust", "Fish"),
}
NAME_WIDTH = 18


@dataclass(frozen=True)
class Score:
    """What was measured on one model; None where there was nothing to measure."""

    model: int
    given: float
    auto: float
    n_humans: int
    n_auto: int
    psi_before: float
    psi: float
    seconds: float
    processor_seconds: float
    asymmetry: float | None = None
    human_asymmetry: float | None = None
    fresh_psi: float | None = None
    kmeans_psi: float | None = None
    connected_psi: float | None = None
    coacd: float | None = None
    coacd_seconds: float | None = None


@dataclass(frozen=True)
class Column:
    """A figure of scores, and how it is told of several."""

    title: str
    field: str
    about: str
    form: str = ".3f"
    of_several: Callable[[Sequence[float]], float] = statistics.fmean

    @property
    def width(self) -> int:
        """Room for the title or the figures, and what keeps columns apart."""
        return max(len(self.title), 5) + 2

    def figures(self, scores: Sequence[Score]) -> list[float]:
        """Return the figures of those scores that have one."""
        found = (getattr(score, self.field) for score in scores)
        return [figure for figure in found if figure is not None]

    def cell(self, scores: Sequence[Score]) -> str:
        """Return the figure of all scores together."""
        figures = self.figures(scores)
        text = format(self.of_several(figures), self.form) if figures else "-"
        return text.rjust(self.width)


COLUMNS = (
    Column("given", "given", "Rand Index error, number of parts given"),
    Column("auto", "auto", "Rand Index error, number of parts chosen"),
    Column("CoACD", "coacd", "that of CoACD, number of parts given"),
    Column("k humans", "n_humans", "median number of the humans' parts", ".3g"),
    Column("k auto", "n_auto", "number of parts chosen", ".3g"),
    Column("psi 1", "psi_before", "psi of one part"),
    Column("psi", "psi", "psi of the parts, their number chosen, as the rest is"),
    Column("fresh", "fresh_psi", "the same by plain lines of sight of other samples"),
    Column("k-means", "kmeans_psi", "that of k-means, the best of 20, for as many"),
    Column("pieces", "connected_psi", "that of its connected pieces merged to as many"),
    Column("asymm.", "asymmetry", "area cut otherwise than its mirror image, share"),
    Column("humans'", "human_asymmetry", "that of the humans"),
    Column("of", "asymmetry", "number of models with a mirror plane", "d", len),
    Column("seconds", "seconds", "until the parts are there", ".2f", statistics.median),
    Column("CoACD's", "coacd_seconds", "processor time", ".1f", statistics.median),
)


def report(scores: Sequence[Score], heading: str) -> str:
    """Return the table by category, beside the published averages."""
    columns = [column for column in COLUMNS if column.figures(scores)]
    titles = "".join(column.title.rjust(column.width) for column in columns)

    def row(name: object, members: Sequence[Score]) -> str:
        cells = "".join(column.cell(members) for column in columns)
        return f"{name:<{NAME_WIDTH}}{cells}"

    by_category = {name: _among(scores, (name,)) for name in CATEGORIES}
    by_group = {name: _among(scores, group) for name, group in GROUPS.items()}
    return "\n".join(
        [
            heading,
            "",
            f"{'category':{NAME_WIDTH}}{titles}",
            *(row(name, members) for name, members in by_category.items() if members),
            "",
            *(row(name, members) for name, members in by_group.items() if members),
            "",
            *(f"{column.title:{NAME_WIDTH}}{column.about}" for column in columns),
            "Means; of seconds, medians.",
            *_beside_coacd(scores),
            *_below_kmeans(scores),
            "",
            "Published averages over the whole benchmark:",
            *(f"{name:24}{error:7.3f}  {how}" for name, error, how in PUBLISHED),
            "",
            f"{'model':{NAME_WIDTH}}{titles}",
            *(row(score.model, [score]) for score in scores),
        ]
    )


def _among(scores: Sequence[Score], categories: Sequence[str]) -> list[Score]:
    """Return the scores of models of some categories."""
    return [score for score in scores if category(score.model) in categories]


def _beside_coacd(scores: Sequence[Score]) -> list[str]:
    """Return the means over those models that CoACD segments."""
    both = [score for score in scores if score.coacd is not None]
    if not both:
        return []

    def mean(field: str) -> float:
        return statistics.fmean(getattr(score, field) for score in both)

    return [
        "",
        f"On the {len(both)} of {len(scores)} models that CoACD segments, means:",
        f"ours   given {mean('given'):.3f}, auto {mean('auto'):.3f},"
        f" {mean('processor_seconds'):.1f} s of processor time",
        f"CoACD  given {mean('coacd'):.3f},"
        f" {mean('coacd_seconds'):.1f} s of processor time",
    ]


def _below_kmeans(scores: Sequence[Score]) -> list[str]:
    """Return on which models the parts have less psi than k-means."""
    both = [score for score in scores if score.fresh_psi is not None]
    if not both:
        return []
    lines = ["", f"Models of {len(both)} with less psi on fresh samples than"]
    for what, field in (
        ("k-means' clusters", "kmeans_psi"),
        ("connected pieces of k-means'", "connected_psi"),
    ):
        gains = {s.model: s.fresh_psi - getattr(s, field) for s in both}
        below = {model: gain for model, gain in gains.items() if round(gain, 4) < 0}
        named = ", ".join(f"{model} ({gain:+.4f})" for model, gain in below.items())
        lines.append(f"{what:30}{len(below):3}{': ' if below else ''}{named}")
    return lines
