#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) CSLF contributors
# SPDX-License-Identifier: BSD-3-Clause
"""Exported pages in Chromium: they show what `cslf render` draws, also in other colours, load
nothing else, obey the mouse, keys and the address, and say what is wrong.

usage: TestCSLFPage.py CSLF GOLDEN   the tool, and the folder of golden files
"""
import base64
import json
import math
import pathlib
import shutil
import subprocess
import sys
import time

try:
    import numpy
    from selenium import webdriver
    from selenium.webdriver.chrome.service import Service
    from selenium.webdriver.common.action_chains import ActionChains
    from selenium.webdriver.common.by import By
    from selenium.webdriver.common.keys import Keys
    from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
except ImportError as missing:
    print(f"Skipped: {missing}")
    sys.exit(125)
import cslf
from vtkmodules.vtkCommonCore import vtkFloatArray, vtkPoints
from vtkmodules.vtkCommonDataModel import vtkPolyData
from vtkmodules.vtkFiltersSources import vtkArrowSource, vtkSphereSource, vtkSuperquadricSource
from vtkmodules.vtkIOImage import vtkPNGReader
from vtkmodules.vtkIOXML import vtkXMLPolyDataWriter
from vtkmodules.vtkRenderingCore import vtkActor, vtkGlyph3DMapper, vtkRenderer, vtkRenderWindow

TOOL = sys.argv[1]
GOLDEN = pathlib.Path(sys.argv[2])
SIZE = 256
MINIMUM_PSNR = 42.0  # of a page beside the tool's picture, in dB
CAMERA = ["--size", str(SIZE), str(SIZE)]


def run(*arguments):
    """Runs the tool, which must succeed."""
    subprocess.run([TOOL, *map(str, arguments)], check=True, stdout=subprocess.DEVNULL)


def read_png(data):
    reader = vtkPNGReader()
    reader.SetMemoryBuffer(data)
    reader.SetMemoryBufferLength(len(data))
    reader.Update()
    width, height, _ = reader.GetOutput().GetDimensions()
    pixels = vtk_to_numpy(reader.GetOutput().GetPointData().GetScalars())
    return pixels.reshape(height, width, -1)[:, :, :3].astype(float)


def measure(first, second):
    return 10.0 * numpy.log10(255.0 ** 2 / max(numpy.mean((first - second) ** 2), 1e-6))


class Browser:
    """Chromium with a window of that size."""

    def __init__(self, *switches):
        options = webdriver.ChromeOptions()
        for switch in ("--headless=new", "--no-sandbox", "--disable-dev-shm-usage", *switches):
            options.add_argument(switch)
        options.set_capability("goog:loggingPrefs", {"browser": "ALL", "performance": "ALL"})
        try:
            self.driver = webdriver.Chrome(
                options=options, service=Service(shutil.which("chromedriver") or "chromedriver"))
        except Exception as error:  # no Chromium, or none that starts
            print(f"Skipped: {error}")
            sys.exit(125)
        self.driver.execute_cdp_cmd("Emulation.setDeviceMetricsOverride", {
            "width": SIZE, "height": SIZE, "deviceScaleFactor": 1, "mobile": False})

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.driver.quit()

    def ask(self, script, *arguments):
        return self.driver.execute_script(script, *arguments)

    def wait(self, state="ready"):
        """Waits until the page has that state and its present view is drawn."""
        while self.ask("return document.documentElement.dataset.state") != state:
            time.sleep(0.02)

    def open(self, page, view="", state="ready"):
        self.driver.get("about:blank")
        self.list_requests()
        self.driver.get(pathlib.Path(page).resolve().as_uri() + ("#" + view if view else ""))
        self.wait(state)

    def grab(self):
        """The picture of the canvas."""
        address = self.ask("return document.querySelector('#canvas').toDataURL()")
        return read_png(base64.b64decode(address.split(",")[1]))

    def list_requests(self):
        """What was loaded since the last call, and what the console says."""
        events = [json.loads(entry["message"])["message"]
                  for entry in self.driver.get_log("performance")]
        addresses = [event["params"]["request"]["url"] for event in events
                     if event["method"] == "Network.requestWillBeSent"]
        return ([url for url in addresses if not url.startswith(("data:", "about:", "blob:"))],
                [entry["message"] for entry in self.driver.get_log("browser")])


def check_picture(browser, field, page, view="", *look):
    """Compares a page with the tool's picture."""
    run("render", field, "-o", "expected.png", *CAMERA, *look)
    browser.open(page, view)
    psnr = measure(browser.grab(), read_png(pathlib.Path("expected.png").read_bytes()))
    print(f"{page} {view}: {psnr:.1f} dB")
    assert psnr > MINIMUM_PSNR
    addresses, messages = browser.list_requests()
    assert len(addresses) == 1 and addresses[0].startswith("file:"), addresses
    assert not messages, messages


def check_field(browser, name, *changes):
    """Compares the page of a field that is only surfaces, also with other colours, which are chosen
    in the page, by options of the same names; the first of them also when it is exported."""
    page = f"{pathlib.Path(name).stem}.html"
    run("export", name, "-o", page, *CAMERA)
    check_picture(browser, name, page)
    for change in changes:
        view = "&".join(f"{key}={value}" for key, value in change.items())
        look = [text for key, value in change.items() for text in (f"--{key}", *value.split(","))]
        check_picture(browser, name, page, view, *look)
        if change is changes[0]:
            run("export", name, "-o", "other.html", *CAMERA, *look)
            check_picture(browser, name, "other.html", "", *look)
    return page


def write_scene():
    """A surface with scalars, values that are not numbers, a vector and integers."""
    source = vtkSuperquadricSource()
    source.SetPhiResolution(48)
    source.SetThetaResolution(48)
    source.Update()
    surface = source.GetOutput()
    places = vtk_to_numpy(surface.GetPoints().GetData()).astype(float)
    values = {"height": places[:, 1], "flow": places * [1.0, 2.0, 0.5],
              "third": numpy.where(places[:, 0] > 0.2, numpy.nan, places[:, 0]),
              "part": (places[:, 2] > 0.0).astype(numpy.int32)}
    for name, numbers in values.items():
        array = numpy_to_vtk(numpy.ascontiguousarray(numbers), deep=1)
        array.SetName(name)
        surface.GetPointData().AddArray(array)
    writer = vtkXMLPolyDataWriter()
    writer.SetInputData(surface)
    writer.SetFileName("scene.vtp")
    writer.Write()


def make_glyphs(source, count, offset):
    """An actor of a source at many places, which a Fibonacci lattice spreads over a sphere."""
    heights = 1.0 - 2.0 * (numpy.arange(count) + 0.5) / count
    turns = numpy.arange(count) * 2.399963
    sides = numpy.sqrt(1.0 - heights ** 2)
    places = numpy.stack((sides * numpy.cos(turns) + offset, sides * numpy.sin(turns), heights), 1)
    points = vtkPoints()
    values = vtkFloatArray()
    values.SetName("value")
    for place, turn in zip(places, turns):
        points.InsertNextPoint(*place)
        values.InsertNextValue(numpy.sin(turn))
    data = vtkPolyData()
    data.SetPoints(points)
    data.GetPointData().SetScalars(values)
    mapper = vtkGlyph3DMapper()
    mapper.SetInputData(data)
    mapper.SetSourceConnection(source.GetOutputPort())
    mapper.SetScaleFactor(0.2)
    mapper.SetScaleModeToNoDataScaling()  # bodies do not meet, so all are diffuse
    mapper.SetScalarRange(-1.0, 1.0)
    actor = vtkActor()
    actor.SetMapper(mapper)
    actor.GetProperty().SetSpecular(0.0)
    return actor


def bake_glyphs():
    """Balls, and arrows: bodies of both kinds."""
    renderer = vtkRenderer()
    renderer.AddActor(make_glyphs(vtkSphereSource(), 60, -1.2))
    renderer.AddActor(make_glyphs(vtkArrowSource(), 60, 1.2))
    window = vtkRenderWindow()
    window.AddRenderer(renderer)
    cslf.bake(window, "glyphs.mp4", viewpoints=2, resolution=32, quality="preview")


def check_actor(browser, field):
    """A mirrored, turned and scaled actor in parallel projection, as the window shows it."""
    actor = cslf.make_actor(field)
    actor.SetScale(-2.0, 2.0, 2.0)
    actor.RotateY(40.0)
    actor.SetPosition(10.0, 0.0, 0.0)
    renderer = vtkRenderer()
    renderer.AddActor(actor)
    renderer.SetBackground(1.0, 1.0, 1.0)
    window = vtkRenderWindow()
    window.OffScreenRenderingOn()
    window.SetMultiSamples(0)
    window.SetSize(SIZE, SIZE)
    window.AddRenderer(renderer)
    renderer.ResetCamera()
    expected = read_png(cslf.capture(window).png)
    exporter = cslf.vtkCSLFPageExporter()
    exporter.SetRenderWindow(window)
    exporter.SetFileName("actor.html")
    exporter.Write()
    browser.open("actor.html")
    psnr = measure(browser.grab(), expected)
    print(f"actor.html: {psnr:.1f} dB")
    assert psnr > MINIMUM_PSNR
    # In perspective, from the distance where it has the same size.
    camera = renderer.GetActiveCamera()
    camera.ParallelProjectionOn()
    camera.SetParallelScale(math.tan(math.radians(15.0)) * camera.GetDistance())
    camera.SetPosition(*(c - 100.0 * d for c, d in zip(camera.GetFocalPoint(),
                                                       camera.GetDirectionOfProjection())))
    exporter.Write()
    browser.open("actor.html")
    assert measure(browser.grab(), expected) > MINIMUM_PSNR


def check_controls(browser, page):
    """The mouse, keys, buttons, and the address, which keeps the view."""
    browser.open(page)
    first = browser.grab()
    driver = browser.driver
    canvas = driver.find_element(By.ID, "canvas")
    ActionChains(driver).drag_and_drop_by_offset(canvas, 40, 0).perform()
    browser.wait()
    turned = browser.grab()
    assert measure(first, turned) < 35.0, "dragging does not turn it"
    address = driver.current_url
    assert "position=" in address
    ActionChains(driver).send_keys(Keys.ARROW_LEFT).perform()
    browser.wait()
    assert driver.current_url != address, "an arrow does not turn it"
    browser.open(page, address.partition("#")[2])
    assert measure(browser.grab(), turned) > 50.0, "the address does not keep the view"
    driver.find_element(By.TAG_NAME, "body").send_keys("0")
    browser.wait()
    assert measure(browser.grab(), first) > 50.0, "0 does not bring the first view back"
    assert "#" not in driver.current_url
    for view in ("view-up=0,0,0", "position=1e308,0,0", "position=,,2&view-angle=0", "color-map=constructor"):
        browser.open(page, view)
        assert measure(browser.grab(), first) > 50.0, view
    browser.open(page)
    driver.find_element(By.TAG_NAME, "body").send_keys("h")
    help_ = driver.find_element(By.ID, "help")
    assert help_.is_displayed() and "triangles" in help_.text
    help_.find_element(By.TAG_NAME, "button").click()
    driver.find_element(By.TAG_NAME, "body").send_keys("l")
    browser.wait()
    assert browser.grab()[0, 0].min() > 200.0, "l does not bring light"
    unnamed = browser.ask("""return [...document.querySelectorAll("button, canvas, select, input")]
      .filter((each) => !each.getAttribute("aria-label") && !each.closest("label") &&
        !each.textContent.trim() && !each.closest("[aria-hidden], figure")).map((each) => each.id)""")
    assert not unnamed, unnamed


def check_colors(browser, page):
    """The form of colours."""
    browser.open(page)
    ActionChains(browser.driver).send_keys("c").perform()
    names = browser.ask("return [...document.querySelector('#colors').array.options]"
                        ".map((option) => option.value)")
    assert sorted(names) == ["", "flow:0", "flow:1", "flow:2", "flow:magnitude", "height", "part",
                             "third"], names
    before = browser.grab()
    browser.ask("""const form = document.querySelector("#colors");
      form.array.value = "flow:0";
      form.array.dispatchEvent(new Event("change", {bubbles: true}));""")
    browser.wait()
    assert measure(before, browser.grab()) < 35.0, "another array has the same colours"
    bar = browser.driver.find_element(By.ID, "bars")
    assert bar.is_displayed() and "flow:0" in bar.text, bar.text
    browser.ask("""const form = document.querySelector("#colors");
      form.low.value = "3";
      form.low.dispatchEvent(new Event("change", {bubbles: true}));""")
    assert browser.ask("return !document.querySelector('#colors').high.validity.valid")
    browser.ask("""const form = document.querySelector("#colors");
      form.low.value = "-0,25";
      form.low.dispatchEvent(new Event("change", {bubbles: true}));""")
    browser.wait()
    assert browser.ask("return document.querySelector('#colors').high.validity.valid")
    assert "range=-0.25," in browser.driver.current_url
    browser.driver.find_element(By.CSS_SELECTOR, "#colors [type=reset]").click()
    browser.wait()
    assert measure(before, browser.grab()) > 50.0, "the colours do not come back"


def check_damage(browser, page):
    """Damaged data: a sentence, and the page goes on."""
    text = pathlib.Path(page).read_text()
    start = text.index('id="data">') + len('id="data">')
    end = text.index("</script>", start)
    data = base64.b64decode(text[start:end])
    for number, broken in enumerate((b"", data[:2], data[:-100], data[:300] + data[500:],
                                     b"\xff" * len(data))):
        name = f"broken-{number}.html"
        pathlib.Path(name).write_text(text[:start] + base64.b64encode(broken).decode() + text[end:])
        browser.open(name, "", "failed")
        message = browser.driver.find_element(By.ID, "message")
        assert message.is_displayed() and message.text.endswith("."), message.text
        assert browser.driver.find_element(By.ID, "poster").is_displayed()


def main():
    software = "--use-angle=swiftshader", "--enable-unsafe-swiftshader"
    with Browser(*software) as browser:
        check_field(browser, GOLDEN / "v2-hevc-geometry-all.mp4")
        check_actor(browser, GOLDEN / "v2-hevc-geometry-all.mp4")
        bake_glyphs()
        check_field(browser, "glyphs.mp4", {"color-map": "gray", "range": "-2,1"})
        run("sample", "cornell-box", "-o", "box.vti", "-M", 2, "-N", 32, "--quality", "preview")
        page = check_field(browser, "box.vti")
        check_controls(browser, page)
        check_damage(browser, page)
        write_scene()
        run("sample", "scene.vtp", "-o", "scene.vti", "-M", 2, "-N", 32, "--quality", "preview",
            "--color-by", "height", "--arrays", "all")
        page = check_field(browser, "scene.vti", {"color-by": "flow:1", "color-map": "plasma"},
                           {"color-by": "height", "range": "-0.2,0.3"}, {"color-by": "third"},
                           {"color-by": "flow:magnitude"}, {"color-by": "part"})
        check_colors(browser, page)
        # Light apart from one colour, and floats.
        run("sample", "scene.vtp", "-o", "plain.vti", "-M", 2, "-N", 32, "--quality", "preview",
            "--color-by", "none", "--arrays", "flow")
        check_field(browser, "plain.vti", {"color-by": "flow:0", "color-map": "gray"})
        run("sample", "cornell-box", "-o", "float.vti", "-M", 2, "-N", 32, "--quality", "preview",
            "--float")
        # A window shows fields of floats by their viewpoints, so their pages are compared.
        pictures = []
        for name in ("float", "box"):
            run("export", f"{name}.vti", "-o", f"{name}.html", *CAMERA)
            browser.open(f"{name}.html")
            pictures.append(browser.grab())
        print(f"float.html: {measure(*pictures):.1f} dB")
        assert measure(*pictures) > MINIMUM_PSNR
    with Browser("--disable-gpu", "--disable-software-rasterizer", "--disable-3d-apis") as browser:
        browser.open(page, "", "failed")
        assert "WebGL" in browser.driver.find_element(By.ID, "message").text
        assert browser.driver.find_element(By.ID, "poster").is_displayed()


main()
