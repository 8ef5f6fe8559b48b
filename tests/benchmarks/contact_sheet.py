"""Pictures of the benchmark's models in their parts, many on a sheet, to look at.

    make contact-sheet PSB=DIRECTORY [BENCH=--humans]

Every model is decomposed, its number of parts chosen, and drawn from the front and the
back, as the command line's --picture does. FOLDER gets N.png, and all pictures with the
models' numbers in sheet_1.png and so on.
"""

import argparse
import sys
from collections.abc import Iterator
from contextlib import closing
from dataclasses import dataclass
from pathlib import Path

import bpy
import checkout  # noqa: F401  # makes the package importable
import numpy as np
import weak_convex_decomposition as package
from hand_made import decomposition_of
from headless.loading import load
from over_models import parse, parser
from princeton import mean_error, overlaps, read_humans
from scipy.optimize import linear_sum_assignment
from weak_convex_decomposition.core.parameters.parts import Parameters
from weak_convex_decomposition.core.steps.progress import run
from weak_convex_decomposition.operators.bridge.parts.write import write_parts
from weak_convex_decomposition.operators.bridge.work.computing import decompose_object
from weak_convex_decomposition.operators.headless.write import picture
from weak_convex_decomposition.operators.headless.write.render_engine import (
    EngineTrial,
    RenderEngine,
)

# Pixels of a view, of which a picture has two; pictures on a sheet.
SIDE = 240
ACROSS, DOWN = 4, 8
# Rows of each digit, three bits in each.
DIGITS = (
    "75557", "26227", "71747", "71717", "55711",
    "74717", "74757", "71111", "75757", "75717",
)  # fmt: skip
DIGIT_SCALE = 4


@dataclass(frozen=True)
class Drawing:
    """How and where models are decomposed and drawn."""

    directory: Path
    folder: Path
    parameters: Parameters
    engine: RenderEngine
    with_human: bool

    def draw(self, model: int) -> list[Path]:
        """Write the pictures of a model's parts, and a human's; return their paths."""
        path = self.folder / f"{model}.png"
        (obj,) = load(self.directory / "off" / f"{model}.off")
        parts = run(decompose_object(obj, self.parameters))
        write_parts(obj, parts, self.parameters)
        picture.save_picture(path, [obj], self.engine)
        if not self.with_human:
            return [path]
        human = most_agreed(read_humans(self.directory, model))
        human = decomposition_of(alike(human, parts.labels))
        write_parts(obj, human, self.parameters)
        human_path = path.with_stem(f"{model}_human")
        picture.save_picture(human_path, [obj], self.engine)
        return [path, human_path]


def most_agreed(humans: list[np.ndarray]) -> np.ndarray:
    """Return the segmentation that the other humans' differ least from."""
    return min(humans, key=lambda human: mean_error(human, humans))


def alike(labels: np.ndarray, model: np.ndarray) -> np.ndarray:
    """Return labels renumbered as those of `model` that they cover most of."""
    _, labels = np.unique(labels, return_inverse=True)
    table = overlaps(labels, model)
    n_labels, n_model = table.shape
    mine, theirs = linear_sum_assignment(table, maximize=True)
    numbers = np.full(n_labels, -1)
    numbers[mine] = theirs
    left = np.flatnonzero(numbers < 0)
    numbers[left] = n_model + np.arange(len(left))
    return numbers[labels]


def sheets(tiles: list[np.ndarray]) -> Iterator[np.ndarray]:
    """Yield pictures side by side and in rows, as many as there are sheets for."""
    height, width, channels = tiles[0].shape
    for start in range(0, len(tiles), ACROSS * DOWN):
        some = tiles[start : start + ACROSS * DOWN]
        n_rows = -(-len(some) // ACROSS)
        sheet = np.ones((n_rows * height, ACROSS * width, channels), np.float32)
        for place, tile in enumerate(some):
            row, column = divmod(place, ACROSS)
            rows = slice(row * height, (row + 1) * height)
            sheet[rows, column * width : (column + 1) * width] = tile
        yield sheet


def numbered(pixels: np.ndarray, number: int) -> np.ndarray:
    """Return a picture with a number in its upper left corner."""
    pixels = pixels.copy()
    for place, digit in enumerate(str(number)):
        bits = [
            [int(row) >> bit & 1 for bit in (2, 1, 0)] for row in DIGITS[int(digit)]
        ]
        ink = np.kron(bits, np.ones((DIGIT_SCALE, DIGIT_SCALE))).astype(bool)
        height, width = ink.shape
        left = DIGIT_SCALE * (1 + 4 * place)
        corner = pixels[DIGIT_SCALE : DIGIT_SCALE + height, left : left + width, :3]
        corner[ink] = 0.0
    return pixels


def read_png(path: Path) -> np.ndarray:
    """Return the pixels of a file, top row first, (height, width, 4)."""
    image = bpy.data.images.load(str(path))
    pixels = np.array(image.pixels, np.float32)
    pixels = pixels.reshape(image.size[1], image.size[0], 4)[::-1]
    bpy.data.images.remove(image)
    return pixels


def write_png(path: Path, pixels: np.ndarray) -> None:
    """Write pixels, top row first, to a file."""
    image = bpy.data.images.new(path.stem, pixels.shape[1], pixels.shape[0])
    image.pixels.foreach_set(pixels[::-1].ravel())
    image.filepath_raw = str(path)
    image.file_format = "PNG"
    image.save()
    bpy.data.images.remove(image)


def main() -> int:
    """Draw every model of a directory, and put the pictures on sheets."""
    package.register()  # objects have a table of parts then
    picture.SIZE = SIDE
    options = parser(__doc__)
    options.add_argument("folder", type=Path)
    options.add_argument(
        "--humans",
        action="store_true",
        help="beside each, the human whom the others agree with most",
    )
    arguments = parse(options)
    arguments.folder.mkdir(parents=True, exist_ok=True)
    for number, sheet in enumerate(sheets(list(tiles(arguments))), 1):
        path = arguments.folder / f"sheet_{number}.png"
        write_png(path, sheet)
        print(path)
    return 0


def tiles(arguments: argparse.Namespace) -> Iterator[np.ndarray]:
    """Yield the pictures of all models, with their numbers."""
    with closing(EngineTrial()) as trial:
        drawing = Drawing(
            arguments.directory,
            arguments.folder,
            arguments.parameters,
            trial.engine(),
            arguments.humans,
        )
    for model in arguments.models:
        print(f"{model}", file=sys.stderr)
        first, *others = map(read_png, drawing.draw(model))
        yield numbered(first, model)
        yield from others


if __name__ == "__main__":
    sys.exit(main())
