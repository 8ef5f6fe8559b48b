"""A made-up layout: it keeps what is drawn, and knows how Blender shares width out."""

from types import SimpleNamespace

import blf
import bpy

# Of Blender's sidebar at interface scale 1, in points, with tabs and margins; of what
# an icon, the edges of a button and a unit take.
SIDEBAR, EDGES, ICON = 280, 53, 20
_BUTTON, _UNIT = 16, 20
# Share of the width of a setting's name.
_NAMES = 0.4


class Layout:
    """Stands for a layout: its parts are layouts, or texts with their edges."""

    def __init__(self, kind="column", parent=None, factor=None):
        self.kind, self.factor, self.parts = kind, factor, []
        self.enabled, self.drawn, self.verbatim = True, [], set()
        self.use_property_split = bool(parent and parent.use_property_split)
        self.ui_units_x = 0.0

    def _child(self, kind, factor=None):
        self.parts.append(Layout(kind, self, factor))
        return self.parts[-1]

    def row(self, align=False, heading=""):
        return self._child("row")

    def column(self, align=False):
        return self._child("column")

    def column_flow(self, columns):
        return self._child("column")

    def box(self):
        return self._child("column")

    def split(self, factor=0.5, align=False):
        return self._child("split", factor)

    def _text(self, text, icon, edges=_BUTTON):
        blf.size(0, 11.0)
        width = blf.dimensions(0, text)[0] + edges if text else 0.0
        self.parts.append((text, width + (icon != "NONE") * ICON, icon))
        return SimpleNamespace()

    def label(self, text="", icon="NONE", translate=True):
        self.verbatim |= set() if translate else {text}
        self._text(text, icon, 4)

    def operator(self, name, text="", icon="NONE", translate=True, **look):
        self.verbatim |= set() if translate else {text}
        return self._text(text, icon)

    def operator_menu_enum(self, name, choice, text="", icon="NONE"):
        return self._text(text, icon)

    def progress(self, factor, text, translate=True):
        self.verbatim |= set() if translate else {text}
        self._text(text, "NONE")

    def prop(self, owner, name, text=None, icon="NONE", translate=True, **look):
        self.drawn.append((owner, name))
        self.verbatim |= set() if translate else {text}
        info = owner.bl_rna.properties[name]
        shown = info.name if text is None else text
        if self.use_property_split and text is None and info.type != "BOOLEAN":
            split = self._child("split", _NAMES)
            split._text(shown, "NONE", 4)
            value = getattr(owner, name)
            items = info.enum_items if info.type == "ENUM" else {}
            split._text(items[value].name if value in items else "2.000", "NONE", 32)
        elif info.type == "STRING":
            self._text(getattr(owner, name), "NONE", 6)
        else:
            self._text("" if info.subtype == "COLOR" else shown, icon)

    def template_list(self, *names, **look):
        pass

    def separator(self):
        pass

    def natural(self):
        """Return the width that nothing is cut off at."""
        widths = [p[1] if isinstance(p, tuple) else p.natural() for p in self.parts]
        width = (sum if self.kind in {"row", "split"} else max)(widths or [0.0])
        return self.ui_units_x * _UNIT or width

    def cut_off(self, room):
        """Return the texts that are too long for this width."""
        room = self.ui_units_x * _UNIT or room
        total = max(self.natural(), 1.0)
        for turn, part in enumerate(self.parts):
            share = 1.0
            if self.kind == "split":
                rest = (1 - self.factor) / max(len(self.parts) - 1, 1)
                share = rest if turn else self.factor
            if isinstance(part, tuple):
                width = part[1] if self.kind != "row" else part[1] / total * room
                if part[0] and min(width, room * share) < part[1] - 0.5:
                    yield part[0]
            else:
                own = part.natural() / total if self.kind == "row" else share
                yield from part.cut_off(room * own)

    def texts(self):
        return [text for text, _ in self.icons()]

    def properties(self):
        """Yield the owner and name of each property, and whether it can be changed."""
        yield from ((*each, self.enabled) for each in self.drawn)
        for part in self.parts:
            for *each, enabled in () if isinstance(part, tuple) else part.properties():
                yield *each, enabled and self.enabled

    def untranslated(self):
        """Return the texts that are drawn as they are in all languages."""
        below = [p.untranslated() for p in self.parts if not isinstance(p, tuple)]
        return self.verbatim.union(*below)

    def icons(self):
        """Yield each text with its icon."""
        for part in self.parts:
            yield from [part[::2]] if isinstance(part, tuple) else part.icons()


def context(scale=1.0):
    return SimpleNamespace(
        active_object=bpy.context.active_object,
        scene=bpy.context.scene,
        mode=bpy.context.mode,
        region=SimpleNamespace(width=int(SIDEBAR * scale)),
        preferences=SimpleNamespace(system=SimpleNamespace(ui_scale=scale)),
    )


def drawn(panel, scale=1.0):
    layout = Layout()
    panel.draw(SimpleNamespace(layout=layout), context(scale))
    return layout
