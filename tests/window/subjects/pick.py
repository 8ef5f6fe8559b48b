"""Parts picked in the viewport: hover, clicks, the pie menu, wheel, and Esc."""

import bpy
from hands import Hands


def steps(hands):
    hands.open_panels("WCD_PT_parts")
    yield from hands.fill_screen()
    yield from hands.open_sidebar()
    yield from hands.parted_suzanne(1, samples=300)
    place = yield from hands.find("wcd.pick_parts", columns=(0.25,))
    yield from hands.click(place)
    region = hands.region("WINDOW")
    yield from hands.move(int(region.x + 0.5*region.width), int(region.y+0.6*region.height))
    yield 0.5
    hands.picture("hover", hands.area)
    yield from hands.click((int(region.x + 0.5*region.width), int(region.y+0.6*region.height)))
    yield 0.5
    hands.picture("clicked", hands.area)
    yield from hands.press("w")
    yield 0.8
    hands.picture("pie", hands.area)
