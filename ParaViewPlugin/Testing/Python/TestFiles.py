# SPDX-FileCopyrightText: Copyright (c) CSLF contributors
# SPDX-License-Identifier: BSD-3-Clause
"""Readers and writers: round trips, other programs' files, damaged ones. Argument: a coded field."""
import os
import sys

import cslf
from cslfparaview import *

field = bake(make_scene(), Viewpoints=3, Resolution=32)
color = fetch_array(field, "Color")
covered = color[:, 3] == 255

# Round trips. If depth comes from the geometry, colours beside silhouettes are the geometry's.
for name, parameters, least in (("a.mp4", {}, 36), ("a.mkv", {"Lossless": 1}, 99),
                                ("b.mp4", {"TargetPSNR": 40}, 39), ("c.mkv", {"TargetRatio": 15}, 25),
                                ("d.mp4", {"DepthFromGeometry": 1}, 27)):
    SaveData(name, proxy=field, Preset="fast", **{"DepthFromGeometry": 0, **parameters})
    reader = OpenDataFile(name)
    check(reader.GetXMLName() == "CSLFReader", f"{name} was opened by {reader.GetXMLName()}")
    quality = psnr(fetch_array(reader, "Color")[:, :3], color[:, :3])
    check(quality > least, f"{name}: {quality} dB")
check(os.path.getsize("a.mp4") < os.path.getsize("a.mkv") / 2, "coded no smaller than lossless")
check(os.path.getsize("d.mp4") < os.path.getsize("a.mp4"), "no smaller without depth")
ratio = color.shape[0] * 3 / os.path.getsize("c.mkv")
check(14 < ratio < 16, f"coded to a ratio of {ratio}")

# A series of videos: the times are announced, and the field is that of the time that is requested.
with open("series.mp4.series", "w") as file:
    file.write('{"file-series-version": "1.0", "files": [{"name": "a.mp4", "time": 0.5}, '
               '{"name": "d.mp4", "time": 2.0}]}')
series = OpenDataFile("series.mp4.series")
check(series.GetXMLName() == "CSLFReader", f"the series was opened by {series.GetXMLName()}")
check(list(series.TimestepValues) == [0.5, 2.0], f"the times are {series.TimestepValues}")
for time, name in ((0.5, "a.mp4"), (2.0, "d.mp4"), (1.9, "a.mp4")):
    series.UpdatePipeline(time)
    single = OpenDataFile(name)
    check((fetch_array(series, "Color") == fetch_array(single, "Color")).all(),
          f"at {time}, the series is not {name}")

# A folder of cube maps.
writer = cslf.vtkCSLFImageWriter()
writer.SetInputConnection(field.GetClientSideObject().GetOutputPort())
writer.SetFileName(os.path.abspath("folder"))
check(writer.Write() == 1, "the folder was not written")
folder = OpenDataFile(os.path.abspath("folder"))
check(folder is not None and folder.GetXMLName() == "CSLFImageReader", "the folder is not opened")
check((fetch_array(folder, "Color") == color).all(), "the folder differs")

# Other programs' videos and folders are not changed.
with open(sys.argv[1], "rb") as file:
    data = file.read()
with open("other.mp4", "wb") as file:
    file.write(data.replace(b"nodes", b"sedon").replace(b"CSLF", b"FLSC").replace(b"cslf", b"flsc"))
with open("text.mp4", "w") as file:
    file.write("no video")
os.makedirs("empty", exist_ok=True)
for name in ("other.mp4", "text.mp4", "empty"):
    with Errors():
        try:
            opened = OpenDataFile(os.path.abspath(name))
        except RuntimeError:
            opened = None
    check(opened is None or not opened.GetXMLName().startswith("CSLF"), f"{name} was opened")

# A truncated file: the rest is read, with a warning; data that is not a field is not written.
with open("short.mp4", "wb") as file:
    file.write(data[:100])
with Errors() as errors:
    broken = CSLFReader(FileName=os.path.abspath("short.mp4"))
    broken.UpdatePipeline()
check(errors.messages, "a broken file gives no error")
image = Wavelet()
image.UpdatePipeline()
with Errors():
    try:
        SaveData("wavelet.mp4", proxy=image)
        check(False, "image data that is no field was written")
    except (AttributeError, RuntimeError):
        pass
check(not os.path.exists("wavelet.mp4"), "image data that is no field made a file")
