"""Draw docs/pictures/growth.svg from the table that growth.py printed.

    python docs/figures/growth_plot.py

On the left seconds against triangles, with the other tools, both on logarithmic axes;
on the right the share of each stage.
"""

import math
import re
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
TABLE = ROOT / "tests/benchmarks/results/growth.txt"
PICTURE = ROOT / "docs/pictures/growth.svg"

# Of the two plots, in points: left, top, width and height.
LINES, SHARES = (64, 40, 400, 300), (560, 40, 300, 300)
COLORS = ("#0b6e4f", "#c8553d", "#3d5a98")
STAGES = {
    "Surface": "#7a9e9f",
    "Ray tree": "#c8553d",
    "Lines of sight": "#0b6e4f",
    "Parts": "#e0b050",
}
Points = list[tuple[int, float]]


def read() -> tuple[list[list[float]], dict[str, Points]]:
    """Return the rows of the table, and triangles and seconds of each other tool."""
    rows, rivals = [], {}
    for line in TABLE.read_text(encoding="utf-8").splitlines():
        words = line.replace(",", "").split()
        if len(words) == 8 and all(re.fullmatch(r"[\d.]+", word) for word in words):
            rows.append([float(word) for word in words])
        elif re.match(r"(CoACD|V-HACD) +\d", line):
            rivals.setdefault(words[0], []).append((int(words[1]), float(words[2])))
    return rows, rivals


def text(x: float, y: float, words: str, anchor: str = "middle") -> str:
    """Return words at a place."""
    return f'<text x="{x:.0f}" y="{y:.0f}" text-anchor="{anchor}">{words}</text>'


def line(points: list[tuple[float, float]], color: str, width: float = 1) -> str:
    """Return a line through points."""
    places = " ".join(f"{x:.1f},{y:.1f}" for x, y in points)
    return (
        f'<polyline points="{places}" fill="none" stroke="{color}"'
        f' stroke-width="{width}"/>'
    )


def short(number: float) -> str:
    """Return a number of triangles in few letters."""
    millions = number / 1e6
    return f"{millions:.0f}M" if millions > 0.9 else f"{number / 1e3:.0f}k"


def seconds_plot(curves: dict[str, Points]) -> list[str]:
    """Return the left plot: a line for each tool."""
    left, top, width, height = LINES
    every = [point for points in curves.values() for point in points]
    low, high = (math.log10(f(x for x, _ in every)) for f in (min, max))
    first = math.floor(math.log10(min(y for _, y in every)))
    last = math.ceil(math.log10(max(y for _, y in every)))

    def place(x: float, y: float) -> tuple[float, float]:
        across = (math.log10(x) - low) / (high - low)
        up = (math.log10(y) - first) / (last - first)
        return left + width * across, top + height * (1 - up)

    found = [text(left + width / 2, top + height + 40, "triangles")]
    for power in range(first, last + 1):
        y = place(10**low, 10.0**power)[1]
        found += [line([(left, y), (left + width, y)], "#ccc")]
        found += [text(left - 6, y + 4, f"{10.0**power:g} s", "end")]
    for power in range(math.ceil(low), math.floor(high) + 1):
        x = place(10.0**power, 10**first)[0]
        found += [line([(x, top), (x, top + height)], "#ccc")]
        found += [text(x, top + height + 18, short(10.0**power))]
    for color, (name, points) in zip(COLORS, curves.items(), strict=False):
        places = [place(*point) for point in points]
        found += [line(places, color, 2.5)]
        x, y = places[-1]
        end = x > left + width - 60
        found += [text(x - 4 if end else x + 6, y - 8, name, "end" if end else "start")]
    return found


def shares_plot(rows: list[list[float]]) -> list[str]:
    """Return the right plot: a bar for each size, of the stages' shares."""
    left, top, width, height = SHARES
    step, found = width / len(rows), []
    for number, row in enumerate(rows):
        x, y, stages = left + number * step, float(top), row[2 : 2 + len(STAGES)]
        for seconds, color in zip(
            reversed(stages), reversed(STAGES.values()), strict=True
        ):
            tall = height * seconds / sum(stages)
            found.append(
                f'<rect x="{x:.1f}" y="{y:.1f}" width="{0.8 * step:.1f}"'
                f' height="{tall:.1f}" fill="{color}"/>'
            )
            y += tall
        found.append(text(x + 0.4 * step, top + height + 18, short(row[0])))
    for share in (0, 50, 100):
        y = top + height * (1 - share / 100)
        found.append(text(left - 6, y + 4, f"{share} %", "end"))
    for number, (name, color) in enumerate(STAGES.items()):
        x = left + 110 * (number % 2)
        y = top + height + 34 + 18 * (number // 2)
        found.append(
            f'<rect x="{x}" y="{y - 9}" width="10" height="10" fill="{color}"/>'
        )
        found.append(text(x + 16, y, name, "start"))
    return found


def main() -> None:
    """Draw both plots."""
    rows, rivals = read()
    ours = {"Convex Parts": [(int(row[0]), row[1]) for row in rows]}
    drawn = [*seconds_plot(ours | rivals), *shares_plot(rows)]
    PICTURE.write_text(
        '<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 880 410"'
        ' font-family="sans-serif" font-size="13">\n'
        '<rect width="880" height="410" fill="#fff"/>\n'
        + "\n".join(drawn)
        + "\n</svg>\n",
        encoding="utf-8",
    )


if __name__ == "__main__":
    main()
