"""Keep pictures of an object's parts as images in the file."""

from __future__ import annotations

import bpy
import numpy as np

from ....core.steps.arrays import FloatArray
from ..stored.long_names import name_that_fits
from ..stored.names import IMAGE_TAG, PICTURE_TAG

# An object notes under the same tag the names, in lines, that it had when its pictures
# were made: the user may rename it. A pointer in an image would keep the object in the
# file once the user deletes it.


def write_image(
    obj: bpy.types.Object, label: str, pixels: FloatArray
) -> bpy.types.Image:
    """Make an image, in place of the former one with that label.

    It is known by our tags: Blender may have changed its name, if that was taken or is
    too long.

    Parameters
    ----------
    obj : bpy.types.Object
        The object that the image shows.
    label : str
        What the image shows of it, for the image's name and to know it again.
    pixels : (H, W, 3) float
        sRGB in 0…1; the first row is the upper one.
    """
    height, width, _ = pixels.shape
    former = (each for each in images_of(obj) if each.library is None)
    image = next((each for each in former if each.get(PICTURE_TAG) == label), None)
    if image is None:
        image = bpy.data.images.new(name_that_fits(obj.name, label), width, height)
        image[IMAGE_TAG], image[PICTURE_TAG] = obj.name, label
        image.use_fake_user = True  # images without users are not saved
        obj[IMAGE_TAG] = "\n".join(sorted({*_noted(obj), obj.name}))
    elif tuple(image.size) != (width, height):
        image.scale(width, height)
    rgba = np.ones((height, width, 4), dtype=np.float32)
    rgba[:, :, :3] = pixels[::-1]
    image.pixels.foreach_set(rgba.ravel())
    image.update()
    image.pack()  # generated images are not saved with the file
    return image


def images_of(obj: bpy.types.Object) -> list[bpy.types.Image]:
    """Return our images of an object."""
    return [image for image in bpy.data.images if image.get(IMAGE_TAG) == obj.name]


def erase_images(obj: bpy.types.Object) -> None:
    """Remove our images of an object, and of those that are gone."""
    own = _noted(obj)
    obj.pop(IMAGE_TAG, None)
    named_so, unnamed = [], []
    for image in bpy.data.images:
        owner = str(image.get(IMAGE_TAG, ""))
        if owner == obj.name:
            named_so.append(image)
        elif owner and owner not in bpy.data.objects and image.library is None:
            unnamed.append(image)
    if not named_so and not unnamed:  # files have thousands of objects
        return
    # Another object may have been renamed since, and this one have its name now.
    noted = set().union(*map(_noted, bpy.data.objects))
    gone = [image for image in unnamed if str(image[IMAGE_TAG]) not in noted]
    is_own = obj.name in own or obj.name not in noted
    for image in (*gone, *(named_so if is_own else ())):
        bpy.data.images.remove(image)


def _noted(obj: bpy.types.Object) -> set[str]:
    """Return the names that an object had when pictures of it were made."""
    return set(str(obj.get(IMAGE_TAG, "")).split("\n")) - {""}
