# SPDX-FileCopyrightText: Copyright (c) CSLF contributors
# SPDX-License-Identifier: BSD-3-Clause
"""Pictures as arrays of rows, from top to bottom, of pixels of red, green and blue."""
import math

import numpy
import OpenImageIO


def read(file):
    """Reads a linear OpenEXR picture."""
    picture = OpenImageIO.ImageBuf(str(file)).get_pixels(OpenImageIO.FLOAT)
    if picture is None:
        raise SystemExit(f"{file} cannot be read")
    return picture[..., :3].astype(float)


def write(file, picture):
    """Writes a picture as OpenEXR, or a displayed picture as PNG."""
    height, width, channels = picture.shape
    kind = OpenImageIO.UINT8 if file.suffix == ".png" else OpenImageIO.FLOAT
    image = OpenImageIO.ImageBuf(OpenImageIO.ImageSpec(width, height, channels, kind))
    image.set_pixels(OpenImageIO.ROI(), picture.astype(numpy.float32))
    if not image.write(str(file)):
        raise SystemExit(image.geterror())


def show(linear):
    """Converts radiance to what is displayed: 1 is white, encoded as sRGB."""
    shown = numpy.clip(linear, 0, 1)
    return numpy.where(shown <= 0.0031308, 12.92 * shown, 1.055 * shown ** (1 / 2.4) - 0.055)


def make_linear(shown):
    """The inverse of `show`, for values in [0, 1]."""
    return numpy.where(shown <= 0.04045, shown / 12.92, ((shown + 0.055) / 1.055) ** 2.4)


def psnr(shown, truth):
    """Of red, green and blue together."""
    return -10 * math.log10(max(numpy.square(shown - truth).mean(), 1e-10))
