"""Draw the figures of docs/paper.md into docs/pictures/.

    make figures                          all of them
    make figures FIGURES="sight ranks"    some of them

Each figure is a function of `drawings`; the extension of this checkout computes what
they show.
"""

import sys
from pathlib import Path

import bpy
import extension
from image import save

PICTURES = Path(__file__).resolve().parents[1] / "pictures"


def main(names: list[str]) -> None:
    """Draw the figures of these names, all of them if there is none."""
    extension.switch_on()
    import drawings  # its shapes want a scene

    unknown = set(names) - drawings.FIGURES.keys()
    if unknown:
        sys.exit(f"No figure {', '.join(unknown)}: {', '.join(drawings.FIGURES)}")
    for name, draw in drawings.FIGURES.items():
        if names and name not in names:
            continue
        bpy.data.batch_remove([*bpy.data.objects, *bpy.data.meshes])
        path = PICTURES / f"{name}.png"
        save(path, draw())
        print(f"{path.name}: {path.stat().st_size // 1000} KB")


if __name__ == "__main__":
    main(sys.argv[1:])
