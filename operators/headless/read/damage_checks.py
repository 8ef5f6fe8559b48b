"""Refuses files that are missing, cut short, damaged or of another kind.

Blender's importers read some of them as empty, read half of them or crash.
"""

from __future__ import annotations

import os
import re
import zipfile
from codecs import BOM_UTF8
from pathlib import Path

from ....core.errors import DecompositionError
from ..files.headers import n_stl_triangles, read_header
from ..files.text import MOST_DIGITS
from ..formats import READ_ENDINGS
from .ply_checks import misnamed, refers_to_missing
from .usd_meshes import mesh_without_its_points

# The first bytes of a file, by ending; several for formats with several forms.
_SIGNATURES = {
    ".ply": (b"ply",),
    ".glb": (b"glTF",),
    ".fbx": (b"Kaydara FBX Binary", b";"),
    ".usd": (b"#usda", b"PXR-USDC"),
    ".usda": (b"#usda", b"PXR-USDC"),
    ".usdc": (b"PXR-USDC",),
    ".usdz": (b"PK",),
    ".blend": (b"BLENDER", b"\x28\xb5\x2f\xfd", b"\x1f\x8b"),
}
# What Blender does not read, but we.
_READ_BY_US = (".off", ".xyz", ".pwn", ".pts")
# Characters that no number has, not even "1e-5" or "-inf".
_NO_NUMBER = re.compile(rb"[^\d\s.+\-eEnaifNAIF]")
# A line of an .obj file that goes on in the next one.
_OBJ_CONTINUED = re.compile(rb"\\[^\S\n]*\n")
# A vertex or a face in an .obj file, and the numbers of the vertices of a face.
_OBJ_LINE = re.compile(rb"^[ \t]*([vf])[ \t]([^#\n]*)", re.MULTILINE)
_OBJ_CORNER = re.compile(rb"(?<!\S)[+-]?\d+(?![^\s/.])")
# A number in .obj and .stl files. Here, "nan" and "inf" are some.
_NUMBER = (
    rb"[+-]?(?:(?:\d++\.?+\d*+|\.\d++)(?:[eE][+-]?\d++)?+(?![^\s#])"
    rb"|(?i:nan|inf)[^\s#]*+)"
)
# A vertex with a word among its first three numbers.
_OBJ_WORD = re.compile(
    rb"\n[ \t]*v(?:[^\S\n]++%b){0,2}+[^\S\n]++(?!%b)[^\s#]" % (_NUMBER, _NUMBER)
)
# A vertex without three numbers; Blender takes 0 for what it cannot read.
_STL_WORD = re.compile(rb"\n[ \t]*vertex(?!(?:\s++%b){3})" % _NUMBER)
# Words of .stl and .obj files that Blender knows in small letters alone.
_CAPITALS = re.compile(rb"\n[ \t]*(?:(?!vertex)(?i:vertex)|[VF])\s")
# The mark with a line behind it that Blender then does not know.
_MARKED = re.compile(BOM_UTF8 + rb"[ \t]*[^#\s]")
# Numbers on a line of an .obj file, by keyword, at least.
_N_OBJ_NUMBERS = {"v": 3, "vn": 3, "vt": 1, "f": 3}


def check_file(path: Path) -> None:
    """Check that `path` is a whole file of the kind that its ending says.

    Raises
    ------
    DecompositionError
        If it is not, or if its ending is not one of `READ_ENDINGS`.
    """
    ending = path.suffix.lower()
    if not path.exists():
        raise DecompositionError(f"{path} does not exist.")
    if path.is_dir():
        raise DecompositionError(f"{path} is a folder; name a file in it.")
    if not path.is_file():  # to open a pipe may take for ever
        raise DecompositionError(
            f"{path} is a pipe or a device; save what it gives in a file."
        )
    if ending not in READ_ENDINGS:
        raise DecompositionError(
            f"{path} has an ending that is not read; these are:"
            f" {' '.join(READ_ENDINGS)}."
        )
    _check_content(path, ending)


def _check_content(path: Path, ending: str) -> None:
    """Raise if the content does not fit the ending, or is cut short."""
    head, tail, size = _ends_of(path)
    if size == 0:
        raise DecompositionError(f"{path} is empty.")
    _check_mark(path, head)
    if ending in _SIGNATURES and not head.startswith(_SIGNATURES[ending]):
        raise _mislabelled(path)
    if ending in (".obj", ".off", ".gltf") and b"\0" in head:
        raise _mislabelled(path)
    if ending == ".stl":
        _check_stl(path, head, tail, size)
    if ending == ".ply":
        _check_ply(path)
    if ending.startswith(".usd"):
        _check_usd(path)
    if ending == ".obj":
        _check_last_line(path, tail)
        _check_obj(path)


def _mislabelled(path: Path) -> DecompositionError:
    """Return the error for a file whose content does not fit its ending."""
    return DecompositionError(
        f"{path} is not a {path.suffix.lower()} file inside, or is damaged."
    )


def _check_mark(path: Path, head: bytes) -> None:
    """Raise for text that begins with a mark, unless we read it ourselves."""
    if path.suffix.lower() not in _READ_BY_US and _MARKED.match(head):
        raise DecompositionError(
            f"{path} begins with a byte order mark, which hides its first line;"
            " save it as UTF-8 without that."
        )


def _ends_of(path: Path) -> tuple[bytes, bytes, int]:
    """Return the first and last kilobytes of a file, and its size."""
    with path.open("rb") as file:
        head = file.read(4096)
        size = file.seek(0, os.SEEK_END)
        file.seek(max(0, size - 4096))
        return head, file.read(), size


def _check_stl(path: Path, head: bytes, tail: bytes, size: int) -> None:
    """Raise for STL that Blender would read as an empty or incomplete mesh."""
    if n_stl_triangles(head, size) is not None:
        return
    if b"\0" in head or not head.lstrip().lower().startswith(b"solid"):
        raise DecompositionError(
            f"{path} is truncated or not an STL file: its size does not fit its header."
        )
    if b"endsolid" not in tail.lower():
        raise DecompositionError(f"{path} is truncated: its end is missing.")
    data = path.read_bytes()
    _check_lines(path, data)
    if _STL_WORD.search(data):
        raise wordy(path)


def _check_ply(path: Path) -> None:
    """Raise for PLY that Blender would read in part, or crash on."""
    data = path.read_bytes()
    header = read_header(data)
    if header:
        _check_lines(path, data[: header.size])
    what = misnamed(header, data)
    if what:
        raise DecompositionError(
            f"{path} has {what}, which Blender reads in small letters alone;"
            " rename what there is."
        )
    if header is None:
        raise DecompositionError(
            f"{path} cannot be read: its header is not one of a .ply file."
        )
    if not header.is_whole(data):
        raise DecompositionError(f"{path} is truncated: its end is missing.")
    if not header.order and _NO_NUMBER.search(data, header.size):
        raise wordy(path)
    if refers_to_missing(header, data):
        raise DecompositionError(
            f"{path} has a face that refers to vertices that are missing; export"
            " it again."
        )


def _check_usd(path: Path) -> None:
    """Raise for USD that Blender would misread or crash on."""
    if path.suffix.lower() == ".usdz" and not zipfile.is_zipfile(path):
        raise DecompositionError(f"{path} is truncated: its end is missing.")
    name = mesh_without_its_points(path)
    if name:
        raise DecompositionError(
            f"{path} has a mesh, {name}, with faces that refer to missing points,"
            " or have too few or too many corners; export it again."
        )


def wordy(path: Path) -> DecompositionError:
    """Return the error for a file that has other words among its numbers."""
    return DecompositionError(
        f"{path} has words where numbers should be; it is damaged."
    )


def _check_lines(path: Path, data: bytes) -> None:
    """Raise for text that is one long line to Blender, or has lines it leaves out."""
    if b"\r" in data and b"\n" not in data:
        raise DecompositionError(
            f"{path} has line ends of old Macs, which Blender cannot read; save it"
            " with those of Unix or Windows."
        )
    if _CAPITALS.search(b"\n" + data):
        raise DecompositionError(
            f"{path} has words in capital letters, which Blender cannot read; write"
            " them in small letters."
        )


def _check_last_line(path: Path, tail: bytes) -> None:
    """Raise for an OBJ file that stops within a line.

    OBJ files do not state their length: one that is cut between lines passes.
    """
    if tail.endswith((b"\n", b"\r")):
        return
    words = tail.decode("latin-1").splitlines()[-1].split()
    if words and len(words) <= _N_OBJ_NUMBERS.get(words[0], 0):
        raise DecompositionError(f"{path} is truncated: it stops within a line.")


def _check_obj(path: Path) -> None:
    """Raise for an OBJ file with vertices or faces that Blender would misread."""
    data = _OBJ_CONTINUED.sub(b" ", path.read_bytes())
    _check_lines(path, data)
    # A line break is found sooner than the beginning of a line.
    if _OBJ_WORD.search(b"\n" + data):
        raise wordy(path)
    _check_obj_corners(path, data)


def _check_obj_corners(path: Path, data: bytes) -> None:
    """Raise for an OBJ file with faces that Blender would leave out."""
    n_vertices = 0
    for line in _OBJ_LINE.finditer(data):
        if line[1] == b"v":
            n_vertices += 1
            continue
        corners = _OBJ_CORNER.findall(line[2])
        if len(corners) != len(line[2].split()):
            raise wordy(path)
        for corner in corners:
            # Vertices count from 1, or from -1 back from the face.
            too_long = len(corner) > MOST_DIGITS
            if too_long or not 1 <= abs(int(corner)) <= n_vertices:
                raise DecompositionError(
                    f"{path} has a face that comes before its vertices or refers"
                    " to some that are missing; export it again."
                )
