"""Keep pictures of an object's parts as images in the file."""

from __future__ import annotations

import bpy
import numpy as np
from numpy.typing import NDArray

from ..stored.names import IMAGE_TAG, PICTURE_TAG


def write_image(
    obj: bpy.types.Object, label: str, pixels: NDArray[np.float64]
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
        image = bpy.data.images.new(f"{obj.name} {label}", width, height)
        image[IMAGE_TAG], image[PICTURE_TAG] = obj.name, label
        image.use_fake_user = True  # images without users are not saved
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
    """Remove our images of an object, and of those that are gone or have a new name."""
    for image in bpy.data.images[:]:
        owner = image.get(IMAGE_TAG)
        lost = image.library is None and owner and owner not in bpy.data.objects
        if owner == obj.name or lost:
            bpy.data.images.remove(image)
