"""What .ply and binary .stl files say of themselves at their beginning.

It finds the rows of a binary .ply by that. Readers ask it of what they are given, and
writers of what they have written.
"""

from __future__ import annotations

import re
import struct
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from .text import whole_number

# Bytes of binary .stl: before the triangles, and of each of them.
STL_HEADER = 84
_STL_TRIANGLE = 50
# Codes of the types in .ply, as in `struct`.
_TYPES = {
    **dict.fromkeys(("char", "int8"), "b"),
    **dict.fromkeys(("uchar", "uint8"), "B"),
    **dict.fromkeys(("short", "int16"), "h"),
    **dict.fromkeys(("ushort", "uint16"), "H"),
    **dict.fromkeys(("int", "int32"), "i"),
    **dict.fromkeys(("uint", "uint32"), "I"),
    **dict.fromkeys(("float", "float32"), "f"),
    **dict.fromkeys(("double", "float64"), "d"),
}
# Those that lengths of lists may have.
_COUNTS = {name: code for name, code in _TYPES.items() if code not in "fd"}
# Words that begin lines of a header which tell of no rows.
_SAY_NOTHING = ("ply", "comment", "obj_info")


@dataclass(frozen=True)
class Element:
    """One kind of element, such as vertex or face.

    Attributes
    ----------
    name : str
    n_rows : int
        How many of them the file has.
    properties : dict of str
        Type code of each property, as in `struct`. A list has two codes: of its
        length and of its members.
    """

    name: str
    n_rows: int
    properties: dict[str, str]

    @property
    def has_lists(self) -> bool:
        """Whether an element has a list, so that its size varies."""
        return any(len(codes) > 1 for codes in self.properties.values())

    def fits(self, words: list[bytes]) -> bool:
        """Return whether a line of these words has all properties."""
        n_words = 0
        for codes in self.properties.values():
            if len(codes) > 1:  # a list begins with its length
                length = words[n_words] if n_words < len(words) else b""
                n_members = whole_number(length.decode("latin-1"))
                n_words += len(words) if n_members is None else n_members
            n_words += 1
        return n_words <= len(words)

    def table(self, order: str, data: bytes, start: int) -> NDArray[np.void] | None:
        """Return the rows in binary form; None if they differ in length or some miss.

        The members of the list of property n are called "members n", counted from 0.
        """
        if not self.n_rows or not self.properties:
            return np.zeros(0, np.dtype([]))
        fields: list[tuple[Any, ...]] = []
        lengths, end = {}, start
        for place, codes in enumerate(self.properties.values()):
            length = 1
            if len(codes) > 1:  # as long as in the first row
                name, first = f"length {place}", struct.Struct(order + codes[0])
                if end + first.size > len(data):
                    return None
                lengths[name] = length = max(first.unpack_from(data, end)[0], 0)
                fields.append((name, order + codes[0]))
                end += first.size
            fields.append((f"members {place}", order + codes[-1], (length,)))
            end += length * struct.calcsize(codes[-1])
        if start + (end - start) * self.n_rows > len(data):
            return None
        table = np.frombuffer(data, np.dtype(fields), self.n_rows, start)
        same = all((table[name] == length).all() for name, length in lengths.items())
        return table if same else None

    def walk(
        self, order: str, data: bytes, start: int, wanted: int | None = None
    ) -> tuple[list[bytes], int]:
        """Go through rows in binary form; return what is wanted, and where they end.

        This is the members of the list `wanted`. The end of rows that are cut short is
        beyond the file.
        """
        if not self.has_lists:
            row = order + "".join(self.properties.values())
            return [], start + self.n_rows * struct.calcsize(row)
        pieces: list[bytes] = []
        kinds = [
            (place == wanted, struct.Struct(order + codes[0]), codes[1:])
            for place, codes in enumerate(self.properties.values())
        ]
        sizes = {codes: struct.calcsize(codes) for _, _, codes in kinds}
        for _ in range(self.n_rows):
            for is_wanted, first, members in kinds:
                end = start + first.size
                if end > len(data):
                    return pieces, end
                if members:
                    n_members = max(first.unpack_from(data, start)[0], 0)
                    start, end = end, end + n_members * sizes[members]
                if is_wanted:
                    pieces.append(data[start:end])
                start = end
        return pieces, start


@dataclass(frozen=True)
class Header:
    """The header of a .ply file.

    Attributes
    ----------
    order : str
        Byte order as in `struct`; empty for a file in text form.
    elements : tuple of Element
    size : int
        Bytes of the header.
    """

    order: str
    elements: tuple[Element, ...]
    size: int

    def is_whole(self, data: bytes) -> bool:
        """Return whether a file has all rows that its header promises."""
        if self.order:
            return self._end(data) <= len(data)
        body = data[self.size :].strip()
        n_lines = max(body.count(b"\n"), body.count(b"\r")) + bool(body)
        n_promised = sum(element.n_rows for element in self.elements)
        if n_lines != n_promised:
            return n_lines > n_promised  # blank lines are allowed
        last = [element for element in self.elements if element.n_rows]
        return not last or last[-1].fits(body.splitlines()[-1].split())

    def _end(self, data: bytes) -> int:
        """Return where the binary data ends; beyond the file if that is cut short."""
        offset = self.size
        for element in self.elements:
            table = element.table(self.order, data, offset)
            if table is None:
                _, offset = element.walk(self.order, data, offset)
            else:
                offset += table.nbytes
        return offset


def read_header(data: bytes) -> Header | None:
    """Return the header of a .ply file, None if it is damaged.

    Parameters
    ----------
    data : bytes
        The whole file.
    """
    orders = {"ascii": "", "binary_little_endian": "<", "binary_big_endian": ">"}
    form = ""
    elements: list[Element] = []
    try:
        text, mark, body = re.split(rb"([\r\n]end_header)", data, maxsplit=1)
        for line in text.splitlines():
            match line.decode("latin-1").split():
                case ["format", form, _]:
                    pass
                case ["element", name, n_rows]:
                    elements.append(Element(name, _count(n_rows), {}))
                case ["property", "list", length, member, *name]:
                    codes = _COUNTS[length] + _TYPES[member]
                    _add_property(elements[-1], name, codes)
                case ["property", kind, *name]:
                    _add_property(elements[-1], name, _TYPES[kind])
                case [word, *_]:
                    _SAY_NOTHING.index(word.lower())  # raises for another word
        order = orders[form]
    except (KeyError, ValueError, IndexError):
        return None
    newline = len(body) - len(body.removeprefix(b"\r").removeprefix(b"\n"))
    return Header(order, tuple(elements), len(text) + len(mark) + newline)


def _count(word: str) -> int:
    """Return the number of rows that a word states; raise if it states none."""
    n_rows = whole_number(word)
    if n_rows is None:
        raise ValueError(word)
    return n_rows


def _add_property(element: Element, words: list[str], codes: str) -> None:
    """Give an element a property; Blender writes names of several words.

    Of several with one name, the first one keeps it.
    """
    name = " ".join(words)
    while name in element.properties:
        name += " again"
    element.properties[name] = codes


def n_stl_triangles(head: bytes, size: int) -> int | None:
    """Return the number of triangles of a binary .stl file, None for one in text form.

    Parameters
    ----------
    head : bytes
        The first 84 bytes or more.
    size : int
        Bytes of the whole file.
    """
    if size < STL_HEADER:
        return None
    (n_triangles,) = struct.unpack_from("<I", head, STL_HEADER - 4)
    whole = size == STL_HEADER + _STL_TRIANGLE * n_triangles
    return int(n_triangles) if whole else None
