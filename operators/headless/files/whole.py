"""Whether a file that was just written is whole, and the cause if it is not.

Blender's exporters for .obj, .ply and .stl say nothing of a full disk, and others name
a wrong cause. So the end of each file is checked. If it is missing, more is written to
the file: then the system names the cause.
"""

from __future__ import annotations

import errno
import json
import os
import struct
import xml.etree.ElementTree as ET
import zlib
from collections.abc import Callable
from pathlib import Path

from .headers import n_stl_triangles, read_header

_BLOCK = 4096
_SOME_BLOCKS = 16
_MANY_BLOCKS = 2**26 // _BLOCK  # 64 MB: more than Blender removed again, mostly
_FBX_END = bytes.fromhex("f85a8c6adef5d97eece90ce3758f290b")


def check_whole(path: Path) -> None:
    """Check that a new file has its end, and wait until it is on the disk.

    Parameters
    ----------
    path : Path
        Its ending says how it is checked.

    Raises
    ------
    OSError
        If it is not whole, with the system's cause where that can be found.
    """
    data = path.read_bytes() if path.exists() else b""
    ending = path.suffix.lower()
    if not data or not _is_whole(data, ending):
        raise_cause(path)
        raise OSError(errno.EIO, "it was written in part only")
    # Text may be cut between two lines: then no more could be written.
    _write_more(path, n_blocks=int(ending in _LINES))


def raise_cause(path: Path) -> None:
    """Raise the OSError that keeps `path` from being longer, if there is one."""
    _write_more(path, _SOME_BLOCKS if path.exists() else _MANY_BLOCKS)


def _write_more(path: Path, n_blocks: int) -> None:
    """Write blocks to the end of a file, wait for the disk, and take them off again."""
    block = os.urandom(_BLOCK)  # which no disk can make smaller
    with path.open("ab", buffering=0) as file:
        size = file.tell()
        try:
            for _ in range(n_blocks):
                rest = block
                while rest:  # what does not fit is an error the second time
                    rest = rest[file.write(rest) :]
            os.fsync(file.fileno())
        finally:
            file.truncate(size)


def check_obj(path: Path, n_faces: int) -> None:
    """Check that an .obj file has at least `n_faces`, which its objects have.

    Raises
    ------
    OSError
        If faces are missing, with the system's cause where that can be found.
    """
    if path.exists() and path.read_bytes().count(b"\nf ") >= n_faces:
        return
    raise_cause(path)
    raise OSError(errno.EIO, "it was written in part only")


def _is_whole(data: bytes, ending: str) -> bool:
    """Return whether a file of this ending has its end."""
    try:
        return ending not in _CHECKS or _CHECKS[ending](data)
    except (ValueError, struct.error, IndexError, ET.ParseError):
        return False


def _blend(data: bytes) -> bool:
    """Check .blend: blocks in a row, the last one is the end; or Zstandard's frames."""
    if data.startswith(b"\x28\xb5\x2f\xfd"):
        return _zstandard(data)
    if data.startswith(b"BLENDER17-01"):  # Blender 5.0 and later
        offset, block, at = 17, struct.Struct("<4siQqq"), 3
    else:
        offset, block, at = 12, struct.Struct("<4siQii"), 1
    code = b""
    while offset < len(data):
        values = block.unpack_from(data, offset)
        code, offset = values[0], offset + block.size + values[at]
    return code == b"ENDB" and offset == len(data)


def _zstandard(data: bytes) -> bool:
    """Check a compressed .blend: the table at its end has the sizes of all frames."""
    n_frames, flags, magic = struct.unpack("<IBI", data[-9:])
    entry = 12 if flags & 0x80 else 8
    table = data[-9 - n_frames * entry : -9]
    sizes = [struct.unpack_from("<I", table, k * entry)[0] for k in range(n_frames)]
    return magic == 0x8F92EAB1 and sum(sizes) + 8 + len(table) + 9 == len(data)


def _glb(data: bytes) -> bool:
    """Check .glb: the length in its header, and chunks up to its end."""
    magic, _, length = struct.unpack_from("<4sII", data)
    offset = 12
    while offset < len(data):
        offset += 8 + struct.unpack_from("<I", data, offset)[0]
    return magic == b"glTF" and length == offset == len(data)


def _ply(data: bytes) -> bool:
    """Check .ply: all rows that the header promises."""
    header = read_header(data)
    return header is not None and header.is_whole(data)


def _stl(data: bytes) -> bool:
    """Check binary .stl: the size that its number of triangles makes."""
    return n_stl_triangles(data, len(data)) is not None


def _png(data: bytes) -> bool:
    """Check .png: chunks with right sums up to the last."""
    offset, kind = 8, b""
    while offset < len(data):
        length, kind = struct.unpack_from(">I4s", data, offset)
        end = offset + 8 + length
        if struct.unpack_from(">I", data, end)[0] != zlib.crc32(data[offset + 4 : end]):
            return False
        offset = end + 4
    return kind == b"IEND"


def _usd(data: bytes) -> bool:
    """Check .usd, which we write as text: the last prim at the top ends."""
    return data.rstrip().endswith(b"\n}")


def _fbx(data: bytes) -> bool:
    """Check binary .fbx: its last bytes are the same in all files."""
    return data.endswith(_FBX_END)


def _lines(data: bytes) -> bool:
    """Check text: the last line ends."""
    return data.endswith(b"\n")


def _materials(data: bytes) -> bool:
    """Check .mtl: the last material has all that Blender writes of it."""
    last = data.rpartition(b"newmtl ")
    return _lines(data) and (not last[1] or b"\nillum " in last[2])


def _json(data: bytes) -> bool:
    """Check that a text is JSON."""
    json.loads(data)
    return True


def _xml(data: bytes) -> bool:
    """Check that a text is XML, with an end for all that it begins."""
    ET.fromstring(data)
    return True


_LINES = (".obj", ".mtl")
_CHECKS: dict[str, Callable[[bytes], bool]] = {
    ".blend": _blend,
    ".glb": _glb,
    ".ply": _ply,
    ".stl": _stl,
    ".png": _png,
    ".usd": _usd,
    ".fbx": _fbx,
    ".obj": _lines,
    ".mtl": _materials,
    ".json": _json,
    ".urdf": _xml,
    ".xml": _xml,
}
