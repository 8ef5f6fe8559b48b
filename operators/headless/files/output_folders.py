"""Folders of meshes beside .urdf and .xml files: whose they are, and what is ours.

`replacing_with_folder` gives a place for the file and for its meshes, and puts both in
place of the old ones. The folder of z.urdf is z_urdf. A manifest in it tells which
files we wrote: these alone are ever replaced or removed.
"""

from __future__ import annotations

import hashlib
import json
from collections.abc import Iterator
from contextlib import contextmanager
from functools import partial
from pathlib import Path

from ....core.errors import DecompositionError
from .replacing import replacing

MANIFEST = "wcd_manifest.json"
# Files of a user with such endings may have a name that we are about to write.
_MESHES = (".obj", ".mtl", ".stl", ".glb")


@contextmanager
def replacing_with_folder(path: Path) -> Iterator[tuple[Path, Path]]:
    """Give a new file for `path` and a new folder for its meshes; put them in place.

    The block writes the file, and files into the folder, none into folders below it.
    In the file, a mesh is ``f"{folder.name}/{mesh.name}"``: the new folder has its
    final name. Afterwards all files are checked, the manifest is added, and file and
    folder take the place of the old ones together.

    Parameters
    ----------
    path : Path
        A .urdf or .xml file.

    Yields
    ------
    unfinished, folder : Path

    Raises
    ------
    OSError
        If a file cannot be written or is not whole; the old ones stay then.
    DecompositionError
        If something of the user's would be lost: see `owned_names`.
    """
    place, owned = folder_of(path), partial(owned_names, path)
    with replacing(path, place, owned=owned) as unfinished:
        folder = unfinished.with_name(place.name)
        folder.mkdir()
        yield unfinished, folder
        _write_manifest(folder, path.name)


def folder_of(path: Path) -> Path:
    """Return the folder of the meshes of a file: z_urdf for z.urdf."""
    return path.with_name(f"{path.stem}_{path.suffix[1:].lower()}")


def owned_names(path: Path) -> frozenset[str]:
    """Return the names in the folder of `path` that are ours.

    Raises
    ------
    DecompositionError
        If the folder is somebody else's, a file of ours was changed, or there are
        meshes that we did not write.
    """
    folder = folder_of(path)
    if not folder.exists():
        return frozenset()
    if not folder.is_dir():
        raise DecompositionError(
            f"{folder} is a file, but {path.name} needs a folder of that name for its"
            " meshes; rename one of them."
        )
    present = {each.name for each in folder.iterdir()}
    if not present:
        return frozenset()
    ours = _read_manifest(folder / MANIFEST, path.name)
    for name, digest in ours.items():
        if name in present and _digest(folder / name) != digest:
            raise DecompositionError(
                f"{folder / name} was changed since it was written, and would be"
                f" replaced; move it to another folder, or give {path.name} another"
                " name."
            )
    for name in sorted(present - ours.keys()):
        if name.lower().endswith(_MESHES):
            raise DecompositionError(
                f"{folder / name} was not written by this program, and might be"
                f" replaced; move it to another folder, or give {path.name} another"
                " name."
            )
    return frozenset(ours) | {MANIFEST}


def check_outside(file: Path) -> None:
    """Check that a file is not among the meshes of some simulator file.

    Raises
    ------
    DecompositionError
        If it is: that file would no longer have its meshes.
    """
    folder = file.resolve().parent
    if not (folder / MANIFEST).exists():
        return
    owner = _contents(folder / MANIFEST)[0] or "another output"
    raise DecompositionError(
        f"{file} is in {folder}, which holds the meshes of {owner}; choose another"
        " place."
    )


def _read_manifest(manifest: Path, output: str) -> dict[str, str]:
    """Return the digest of each file that a manifest lists."""
    belongs_to, ours = _contents(manifest)
    if belongs_to != output:
        owner = f"belongs to {belongs_to}" if belongs_to else "was not written by us"
        raise DecompositionError(
            f"The folder {manifest.parent} {owner}, and {output} needs a folder of that"
            f" name for its meshes; rename the folder, or give {output} another name."
        )
    return ours


def _contents(manifest: Path) -> tuple[str | None, dict[str, str]]:
    """Return whose a folder is by its manifest, and the digests of its files."""
    try:
        content = json.loads(manifest.read_bytes())
        listed = content["files"].items()
        ours = {str(name): str(each["sha256"]) for name, each in listed}
        return content["belongs_to"], ours
    except (OSError, ValueError, KeyError, TypeError, AttributeError):
        return None, {}


def _write_manifest(folder: Path, output: str) -> None:
    """Write the manifest of a new folder."""
    files = {
        file.name: {"bytes": file.stat().st_size, "sha256": _digest(file)}
        for file in sorted(folder.iterdir())
    }
    text = json.dumps({"belongs_to": output, "files": files}, indent=2) + "\n"
    (folder / MANIFEST).write_text(text, encoding="utf-8")


def _digest(file: Path) -> str:
    """Return the SHA-256 of a file; empty for what is none."""
    if file.is_symlink() or not file.is_file():
        return ""
    return hashlib.sha256(file.read_bytes()).hexdigest()
