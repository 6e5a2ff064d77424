#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) CSLF contributors
# SPDX-License-Identifier: BSD-3-Clause
"""Pages of light fields: what they have, what is warned of, and what is refused. How they look is
tested in a browser.

usage: TestCSLFPages.py GOLDEN FIELD   the folder of golden files, and a field without geometry
"""
import base64
import os
import pathlib
import sys
import warnings
import zlib

import cslf
from vtkmodules.vtkFiltersSources import vtkConeSource
from vtkmodules.vtkRenderingCore import vtkActor, vtkPolyDataMapper, vtkRenderer, vtkRenderWindow

golden = pathlib.Path(sys.argv[1])
surfaces = golden / "v2-hevc-geometry-all.mp4"
reflecting = golden / "v2-hevc-geometry.mp4"


def read_page(name):
    """The text of a page, and what it says of itself in JSON."""
    text = pathlib.Path(name).read_text(encoding="utf-8")
    data = base64.b64decode(text.split('id="data">')[1].split("<")[0])
    return text, zlib.decompress(data[4:4 + int.from_bytes(data[:4], "little")]).decode()


def expect(kind, call, text, output="none.html"):
    """The call raises an exception of that kind, with that text, and leaves no file."""
    try:
        call()
    except kind as error:
        assert text in str(error), error
    else:
        raise AssertionError(f"{text}: nothing is raised")
    assert not [name for name in os.listdir(".") if output in name]


# A page has its title, the camera, and a picture, and names nothing outside.
with warnings.catch_warnings():
    warnings.simplefilter("error")
    page = cslf.export_html(surfaces, "page.html", title='A <b>"cone"</b> & more',
                            position=(1.0, 2.0, 3.0), focal_point=(0.0, 0.5, 0.0),
                            background="white")
assert page == "page.html"
text, about = read_page(page)
assert "<title>A &lt;b&gt;&quot;cone&quot;&lt;/b&gt; &amp; more</title>" in text
assert 'src="data:image/jpeg;base64,/9j/' in text and "--background: #ffffff" in text
assert "{{" not in text and "http://" not in text and "https://" not in text
assert '"position":[1.0,2.0,3.0]' in about and '"notes":[]' in about, about

# Its name without extension is the default title. It may be replaced.
cslf.export_html(str(surfaces), pathlib.Path("page.html"), size=(64, 32))
assert "<title>page</title>" in pathlib.Path("page.html").read_text()

# What is left out is named in warnings, and in the page.
with warnings.catch_warnings(record=True) as caught:
    warnings.simplefilter("always")
    cslf.export_html(reflecting, "page.html")
assert any("direction of view" in str(each.message) for each in caught), caught
assert caught[0].filename == __file__, "the warning is not at the call"
assert "direction of view" in read_page("page.html")[1]

# The window of others: other actors are left out, and the actor's matrix is kept.
actor = cslf.make_actor(surfaces)
actor.SetPosition(5.0, 0.0, 0.0)
other = vtkActor()
cone = vtkConeSource()
other.SetMapper(vtkPolyDataMapper())
other.GetMapper().SetInputConnection(cone.GetOutputPort())
renderer = vtkRenderer()
renderer.AddActor(other)
renderer.AddActor(actor)
window = vtkRenderWindow()
window.OffScreenRenderingOn()
window.AddRenderer(renderer)
exporter = cslf.vtkCSLFPageExporter()
exporter.SetRenderWindow(window)
exporter.SetFileName("window.html")
exporter.PosterOff()
messages = []
for event in "WarningEvent", "ErrorEvent":
    exporter.AddObserver(event, lambda _sender, kind: messages.append(kind))
exporter.Write()
assert messages == ["WarningEvent"], messages
text, about = read_page("window.html")
assert 'src=""' in text and "1 other object" in about and "5.0,0.0,0.0,1.0]" in about, about

# Fields without colours on surfaces, places that cannot be written, wrong arguments.
expect(cslf.Error, lambda: cslf.export_html(sys.argv[2], "none.html"), "geometry")
expect(cslf.Error, lambda: cslf.export_html(surfaces, "absent/none.html"), "absent")
expect(TypeError, lambda: cslf.export_html(surfaces, "none.html", title=7), "title")
expect(ValueError, lambda: cslf.export_html(surfaces, "none.html", size=(0, 10)), "size")
messages.clear()
for name, visible in ((None, True), ("none.html", False)):
    exporter.SetFileName(name)
    actor.SetVisibility(visible)
    exporter.Write()
    assert messages == ["ErrorEvent"], messages
    messages.clear()
assert not os.path.exists("none.html")
