"""Draw the figures of the docs into docs/pictures/.

    make figures                          all of them
    make figures FIGURES="hands ranks"    some of them

Each figure is a function of `solid_drawings`, `flat_drawings` or `story`. The extension
of this checkout computes what they show.
"""

import sys
from pathlib import Path

import bpy
import extension
import flat_drawings
import solid_drawings
import story
from image import save

FIGURES = solid_drawings.FIGURES | flat_drawings.FIGURES | {"story": story.story}
PICTURES = Path(__file__).resolve().parents[1] / "pictures"


def main(names: list[str]) -> None:
    """Draw the figures of these names, all of them if there is none."""
    extension.switch_on()
    unknown = set(names) - FIGURES.keys()
    if unknown:
        sys.exit(f"No figure {', '.join(unknown)}; there are {', '.join(FIGURES)}.")
    for name, draw in FIGURES.items():
        if names and name not in names:
            continue
        bpy.data.batch_remove([*bpy.data.objects, *bpy.data.meshes])
        path = PICTURES / f"{name}.png"
        save(path, draw())
        sys.stdout.write(f"{path.name}: {path.stat().st_size // 1000} KB\n")


if __name__ == "__main__":
    main(sys.argv[1:])
