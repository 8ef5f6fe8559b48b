"""Looks at a file before an importer does, which may take anything for empty."""

from __future__ import annotations

import os
import re
import struct
from pathlib import Path

from ....core.errors import DecompositionError
from .ply import read_header

# How a file of each ending begins; several where the format has several forms.
_SIGNATURES = {
    ".ply": (b"ply",),
    ".glb": (b"glTF",),
    ".fbx": (b"Kaydara FBX Binary", b";"),
    ".blend": (b"BLENDER", b"\x28\xb5\x2f\xfd", b"\x1f\x8b"),
}
_STL_HEADER = 84
_STL_TRIANGLE = 50
# What is in no number, be it "1e-5" or "-inf".
_NO_NUMBER = re.compile(rb"[^\d\s.+\-eEnaifNAIF]")
_FIELDS_OF_OBJ = {"v": 3, "vn": 3, "vt": 1, "f": 3}


def check_file(path: Path, endings: tuple[str, ...]) -> None:
    """Raise `DecompositionError` if `path` cannot be a whole file of its ending."""
    ending = path.suffix.lower()
    if not path.exists():
        raise DecompositionError(f"{path} does not exist.")
    if path.is_dir():
        raise DecompositionError(f"{path} is a folder; name a file in it.")
    if ending not in endings:
        raise DecompositionError(
            f"{path.name} has an ending that is not read; these are:"
            f" {' '.join(endings)}."
        )
    _check_content(path, ending)


def _check_content(path: Path, ending: str) -> None:
    """Raise if a file does not hold what its ending says, or only half of it."""
    head, tail, size = _ends_of(path)
    if size == 0:
        raise DecompositionError(f"{path.name} is empty.")
    if ending in _SIGNATURES and not head.startswith(_SIGNATURES[ending]):
        raise _mislabelled(path)
    if ending in (".obj", ".off", ".gltf") and b"\0" in head:
        raise _mislabelled(path)
    if ending == ".stl":
        _check_stl(path, head, tail, size)
    if ending == ".ply":
        _check_ply(path)
    if ending == ".obj":
        _check_last_line(path, tail)


def _mislabelled(path: Path) -> DecompositionError:
    """Return the error for a file of another kind."""
    return DecompositionError(
        f"{path.name} is not a {path.suffix.lower()} file inside, or is damaged."
    )


def _ends_of(path: Path) -> tuple[bytes, bytes, int]:
    """Return the first and last kilobytes of a file, and its size."""
    try:
        with path.open("rb") as file:
            head = file.read(4096)
            size = file.seek(0, os.SEEK_END)
            file.seek(max(0, size - 4096))
            return head, file.read(), size
    except OSError as error:
        raise DecompositionError(
            f"{path} cannot be opened ({error.strerror})."
        ) from error


def _check_stl(path: Path, head: bytes, tail: bytes, size: int) -> None:
    """Raise for STL that Blender would read as an empty mesh, or as half of one."""
    if size >= _STL_HEADER:
        (count,) = struct.unpack_from("<I", head, _STL_HEADER - 4)
        if size == _STL_HEADER + _STL_TRIANGLE * count:
            return
    if not head.lstrip().lower().startswith(b"solid"):
        raise DecompositionError(
            f"{path.name} is truncated or no STL: its size is not the one that its"
            " header states."
        )
    if b"endsolid" not in tail.lower():
        raise DecompositionError(f"{path.name} is truncated: it lacks its end.")


def _check_ply(path: Path) -> None:
    """Raise for PLY that Blender would read up to where it is cut, or crash on."""
    data = path.read_bytes()
    header = read_header(data)
    if header is None:
        raise DecompositionError(
            f"{path.name} cannot be read: its header is not one of a .ply file."
        )
    if not header.is_whole(data):
        raise DecompositionError(f"{path.name} is truncated: it lacks its end.")
    if not header.order and _NO_NUMBER.search(data, header.size):
        raise DecompositionError(
            f"{path.name} has words where numbers should be; it is damaged."
        )


def _check_last_line(path: Path, tail: bytes) -> None:
    """Raise for an OBJ file that stops within a line.

    An OBJ file does not say how long it is: one cut between lines passes.
    """
    if tail.endswith((b"\n", b"\r")):
        return
    words = tail.decode("latin-1").splitlines()[-1].split()
    if words and len(words) <= _FIELDS_OF_OBJ.get(words[0], 0):
        raise DecompositionError(f"{path.name} is truncated: it stops within a line.")
