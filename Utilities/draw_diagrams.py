#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) CSLF contributors
# SPDX-License-Identifier: BSD-3-Clause
"""Draws the diagrams of Documentation/Conventions.md: cube, faces, tiles, and two lookups."""
import argparse
import pathlib
import sys
import xml.etree.ElementTree as xml

IMAGES = pathlib.Path(__file__).resolve().parent.parent / "Documentation" / "images"
INK, FAINT, ENTRY, EXIT, SCENE = "#222222", "#9aa0a6", "#1a6fb0", "#c4561b", "#4a8f4a"
M, N = 5, 8  # viewpoints and texels along a side in the pictures

# Documentation/Conventions.md, Faces: the point of each face at (sc, tc), and what they stand for.
FACES = [
    ("0  +X", "sc = -z", "tc = -y", lambda sc, tc: (1, -tc, -sc)),
    ("1  -X", "sc = +z", "tc = -y", lambda sc, tc: (-1, -tc, sc)),
    ("2  +Y", "sc = +x", "tc = +z", lambda sc, tc: (sc, 1, tc)),
    ("3  -Y", "sc = +x", "tc = -z", lambda sc, tc: (sc, -1, -tc)),
    ("4  +Z", "sc = +x", "tc = -y", lambda sc, tc: (sc, -tc, 1)),
    ("5  -Z", "sc = -x", "tc = -y", lambda sc, tc: (-sc, -tc, -1)),
]


class Drawing:
    """An SVG picture on white."""

    def __init__(self, name, width, height):
        self.path = IMAGES / f"{name}.svg"
        self.root = xml.Element("svg", {
            "xmlns": "http://www.w3.org/2000/svg", "viewBox": f"0 0 {width} {height}",
            "width": str(width), "height": str(height),
            "font-family": "sans-serif", "font-size": "14"})
        self.add("rect", width=width, height=height, fill="#ffffff")

    def add(self, element, text=None, **attributes):
        names = {key.replace("_", "-"): f"{value:.1f}" if isinstance(value, float) else str(value)
                 for key, value in attributes.items()}
        xml.SubElement(self.root, element, names).text = text

    def line(self, a, b, color=INK, width=1.5, dash=""):
        extra = {"stroke_dasharray": dash} if dash else {}
        self.add("line", x1=float(a[0]), y1=float(a[1]), x2=float(b[0]), y2=float(b[1]),
                 stroke=color, stroke_width=width, **extra)

    def arrow(self, a, b, color=INK, width=1.5):
        self.line(a, b, color, width)
        x, y = b[0] - a[0], b[1] - a[1]
        length = (x * x + y * y)**0.5
        x, y = 9 * x / length, 9 * y / length
        self.polygon([b, (b[0] - x - 0.4 * y, b[1] - y + 0.4 * x),
                      (b[0] - x + 0.4 * y, b[1] - y - 0.4 * x)], color, color)

    def polygon(self, points, stroke=INK, fill="none", opacity=1.0):
        self.add("polygon", points=" ".join(f"{x:.1f},{y:.1f}" for x, y in points), stroke=stroke,
                 fill=fill, fill_opacity=opacity)

    def dot(self, point, color=INK, radius=3):
        self.add("circle", cx=float(point[0]), cy=float(point[1]), r=radius, fill=color)

    def text(self, point, text, color=INK, anchor="start", size=14):
        self.add("text", text, x=float(point[0]), y=float(point[1]), fill=color, text_anchor=anchor,
                 font_size=size)

    def write(self):
        return xml.tostring(self.root, encoding="unicode").replace("><", ">\n<") + "\n"


def draw_cube():
    """A ray that enters through +Z at (u, v) and leaves through -Z at (s, t)."""
    drawing = Drawing("cube", 720, 430)

    def project(point):
        x, y, z = point
        return 370 + 110 * (x - z), 215 - 95 * y + 42 * (x + z)

    def face(number):
        return [project(FACES[number][3](sc, tc)) for sc, tc in
                ((-1, -1), (1, -1), (1, 1), (-1, 1))]

    exit_point = FACES[5][3](0.1, 0.2)
    entry_point = FACES[4][3](0.18, 0.05)
    eye = tuple(e + 0.75 * (e - x) for e, x in zip(entry_point, exit_point))
    drawing.polygon(face(5), EXIT, EXIT, 0.08)
    for k in range(1, N):
        at = -1 + 2 * k / N
        for ends in (((at, -1), (at, 1)), ((-1, at), (1, at))):
            drawing.line(*[project(FACES[5][3](*end)) for end in ends], EXIT, 0.5)
    for axes in ((-1, -1), (1, -1), (1, 1), (-1, 1)):
        drawing.line(project((*axes, -1)), project((*axes, 1)), FAINT, 1.2)
    x, y = project((0, -0.1, 0))
    drawing.add("ellipse", cx=x, cy=y, rx=72, ry=58, fill=SCENE, fill_opacity=0.35, stroke=SCENE)
    drawing.text((x, y + 44), "scene", SCENE, "middle")
    drawing.line(project(entry_point), project(exit_point), INK, 1.5, "5 4")
    drawing.polygon(face(4), ENTRY, ENTRY, 0.10)
    for j in range(M):
        for i in range(M):
            node = (-1 + 2 * i / (M - 1), -1 + 2 * j / (M - 1))
            drawing.dot(project(FACES[4][3](*node)), ENTRY, 2.5)
    drawing.line(project(eye), project(entry_point), INK, 1.5)
    for point, color in ((eye, INK), (entry_point, ENTRY), (exit_point, EXIT)):
        drawing.dot(project(point), color, 5)
    x, y = project(eye)
    drawing.text((x - 10, y + 5), "eye", anchor="end")
    x, y = project(entry_point)
    drawing.text((x - 2, y + 26), "(u, v)", ENTRY, "end", 16)
    x, y = project(exit_point)
    drawing.text((x + 9, y - 8), "(s, t)", EXIT, "start", 16)
    drawing.text((14, 24), f"entry face, +Z: M x M viewpoints (here {M} x {M}),", ENTRY)
    drawing.text((14, 42), "at the crossings of a grid that includes the edges", ENTRY)
    drawing.text((706, 396), f"exit face, -Z: N x N texels (here {N} x {N})", EXIT, "end")
    drawing.text((706, 414), "of each viewpoint, the centres of cells", EXIT, "end")
    origin = (70, 390)
    for axis, name in enumerate(("x", "y", "z")):
        unit = [1.0 if k == axis else 0.0 for k in range(3)]
        x, y = (p - q for p, q in zip(project(unit), project((0, 0, 0))))
        tip = (origin[0] + 0.4 * x, origin[1] + 0.4 * y)
        drawing.arrow(origin, tip)
        drawing.text((tip[0] + 0.12 * x - 4, tip[1] + 0.12 * y + 5), name)
    return drawing


def draw_faces():
    """The cube unfolded, seen from outside. Edges that touch are one edge of the cube."""
    drawing = Drawing("faces", 720, 540)
    places = {2: (1, 0), 1: (0, 1), 4: (1, 1), 0: (2, 1), 5: (3, 1), 3: (1, 2)}
    for a, b, edge_a, edge_b in ((1, 4, (1, None), (-1, None)), (4, 0, (1, None), (-1, None)),
                                 (0, 5, (1, None), (-1, None)), (2, 4, (None, 1), (None, -1)),
                                 (4, 3, (None, 1), (None, -1))):
        for along in (-1, 0.5, 1):
            ends = [FACES[face][3](*[along if k is None else k for k in edge])
                    for face, edge in ((a, edge_a), (b, edge_b))]
            assert ends[0] == ends[1], "the faces do not belong together"
    size = 170
    for number, (column, row) in places.items():
        name, sc, tc, _ = FACES[number]
        x, y = 20 + column * size, 15 + row * size
        drawing.polygon([(x, y), (x + size, y), (x + size, y + size), (x, y + size)], INK, ENTRY,
                        0.06)
        drawing.text((x + size / 2, y + size / 2 + 45), name, INK, "middle", 20)
        corner = (x + 14, y + 14)
        drawing.arrow(corner, (x + 74, y + 14), EXIT)
        drawing.arrow(corner, (x + 14, y + 74), EXIT)
        drawing.text((x + 80, y + 19), sc, EXIT)
        drawing.text((x + 8, y + 92), tc, EXIT)
    drawing.text((385, 60), "The cube unfolded, seen from outside,")
    drawing.text((385, 80), "with the in-face axes sc and tc of each face.")
    drawing.text((385, 445), "(u, v) is (sc, tc) on the entry face,")
    drawing.text((385, 465), "(s, t) is (sc, tc) on the exit face.")
    return drawing


def draw_tiles():
    """A slice of the image data, and the stack of all."""
    drawing = Drawing("tiles", 720, 400)
    size, left, top = 110, 30, 40
    drawing.text((left, 24), "One slice: what a viewpoint of the face 4 (+Z) sees")
    for column, number in enumerate(k for k in range(6) if k != 4):
        x = left + column * size
        drawing.polygon([(x, top), (x + size, top), (x + size, top + size), (x, top + size)], INK,
                        EXIT, 0.08)
        for k in range(1, N):
            at = k * size / N
            drawing.line((x + at, top), (x + at, top + size), EXIT, 0.4)
            drawing.line((x, top + at), (x + size, top + at), EXIT, 0.4)
        drawing.add("rect", x=x + 25, y=top + 40, width=60, height=28, fill="#ffffff",
                    fill_opacity=0.85)
        drawing.text((x + size / 2, top + 60), FACES[number][0], INK, "middle", 16)
    right = left + 5 * size
    drawing.arrow((left, top + size + 16), (right, top + size + 16))
    drawing.text(((left + right) / 2, top + size + 34), "x: five tiles of N texels", INK, "middle")
    drawing.arrow((right + 14, top), (right + 14, top + size))
    drawing.text((right + 22, top + size / 2), "y: N texels,")
    drawing.text((right + 22, top + size / 2 + 18), "row 0 on top")
    for k in range(11, -1, -1):
        x, y = 60 + 22 * k, 318 - 9 * k
        color = ENTRY if (k // 2) % 2 else SCENE
        drawing.polygon([(x, y), (x + 180, y), (x + 180, y + 36), (x, y + 36)], color, "#ffffff")
    for k in range(6):
        drawing.text((250 + 44 * k, 352 - 18 * k), f"face {k}", SCENE if k % 2 == 0 else ENTRY,
                     "start", 12)
    drawing.arrow((40, 306), (282, 207))
    drawing.text((40, 222), "z: 6 M")
    drawing.text((86, 216), "2", size=10)
    drawing.text((94, 222), "viewpoints")
    drawing.text((470, 330), "z = (face M + j) M + i", size=16)
    drawing.text((470, 352), "i along u, j along v")
    return drawing


def draw_lookups():
    """The contributions of two neighbouring viewpoints to a ray, without and with depth."""
    drawing = Drawing("lookups", 720, 360)
    for left, title, deep in ((20, "bilinear: both look at (s, t)", False),
                              (380, "depth: both look at what the ray meets", True)):
        drawing.text((left, 22), title, size=16)
        top, bottom, width = 100, 320, 320
        drawing.line((left, top), (left + width, top), ENTRY, 2)
        drawing.line((left, bottom), (left + width, bottom), EXIT, 2)
        drawing.text((left + width, top - 8), "entry face", ENTRY, "end")
        drawing.text((left + width, bottom + 18), "exit face", EXIT, "end")
        surface = 190
        drawing.polygon([(left + 40, surface), (left + 280, surface), (left + 280, surface + 22),
                         (left + 40, surface + 22)], SCENE, SCENE, 0.3)
        drawing.text((left + 44, surface + 16), "surface", SCENE, size=12)
        views = [(left + 110, top), (left + 200, top)]
        eye, entry = (left + 128, 40), (left + 142, top)
        reach = (bottom - eye[1]) / (entry[1] - eye[1])
        end = (eye[0] + reach * (entry[0] - eye[0]), bottom)
        meet = (eye[0] + (surface - eye[1]) / (entry[1] - eye[1]) * (entry[0] - eye[0]), surface)
        drawing.line(eye, meet, INK, 1.8)
        drawing.line(meet, end, INK, 1.2, "5 4")
        drawing.dot(eye, INK, 5)
        drawing.text((eye[0] - 10, eye[1] + 4), "eye", anchor="end")
        for view in views:
            target = meet if deep else end
            at = (surface - top) / (target[1] - top)
            hit = (view[0] + at * (target[0] - view[0]), surface)
            drawing.line(view, hit, ENTRY, 1.5)
            if not deep:
                drawing.line(hit, target, ENTRY, 0.8, "3 4")
            drawing.dot(view, ENTRY, 4)
            drawing.dot(hit, EXIT, 4)
        drawing.dot(end, INK, 3)
        drawing.text((end[0] + 8, bottom - 8), "(s, t)")
    drawing.text((20, 354), "Orange: the points whose colours are mixed. Left they are apart, so "
                 "that the surface is doubled.", size=13)
    return drawing


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--check", action="store_true",
                        help="only check that the files are those that would be drawn")
    check = parser.parse_args().check
    for drawing in (draw_cube(), draw_faces(), draw_tiles(), draw_lookups()):
        if not check:
            drawing.path.write_text(drawing.write(), encoding="utf-8")
        elif not drawing.path.exists() or \
                drawing.path.read_text(encoding="utf-8") != drawing.write():
            sys.exit(f"{drawing.path.name} is outdated: run Utilities/draw_diagrams.py")


if __name__ == "__main__":
    main()
