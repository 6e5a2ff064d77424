#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) CSLF contributors
# SPDX-License-Identifier: BSD-3-Clause
"""Writes small models with all kinds of faults into a folder: truncated, with counts, lengths and
indices that cannot be, in the wrong order, or of wrong types. With --mutations N, N files more of
each sound one in which bytes were changed at random, by a seed.

    make_hostile_models.py FOLDER [--mutations N] [--seed S]
"""
import argparse
import base64
import json
import pathlib
import random
import struct

TRIANGLE = [(0.0, 0.0, 0.0), (1.0, 0.0, 0.0), (0.0, 1.0, 0.0)]
PLY_FLOATS = "property float x\nproperty float y\nproperty float z\n"
PLY_LIST = "property list uchar int vertex_indices\n"


def make_ply(form="ascii", vertices=3, faces=1, vertex=PLY_FLOATS, face=PLY_LIST, body=None):
    """A PLY file, valid by default."""
    header = f"ply\nformat {form} 1.0\nelement vertex {vertices}\n{vertex}" \
             f"element face {faces}\n{face}end_header\n"
    if body is None:
        if form == "ascii":
            lines = [" ".join(map(str, point)) for point in TRIANGLE] + ["3 0 1 2"]
            body = ("\n".join(lines) + "\n").encode()
        else:
            order = ">" if "big" in form else "<"
            body = b"".join(struct.pack(order + "3f", *point) for point in TRIANGLE)
            body += struct.pack(order + "B3i", 3, 0, 1, 2)
    return header.encode() + body


def make_ply_files():
    """PLY files: valid and invalid ones."""
    little, big = "binary_little_endian", "binary_big_endian"
    points = b"".join(struct.pack("<3f", *point) for point in TRIANGLE)
    sound = {"ascii": make_ply(), "little": make_ply(little), "big": make_ply(big)}
    broken = {
        "empty": b"",
        "magic": b"plywood\n",
        "no_end": b"ply\nformat ascii 1.0\nelement vertex 3\n",
        "no_format": make_ply().replace(b"format ascii 1.0\n", b""),
        "bad_format": make_ply("ebcdic"),
        "many_vertices": make_ply(little, vertices=2147483647),
        "too_many_vertices": make_ply(vertices=99999999999999999999999),
        "negative_vertices": make_ply(vertices=-3),
        "words_for_vertices": make_ply(vertices="three"),
        "many_faces": make_ply(little, faces=4294967295),
        "no_vertex_properties": make_ply(vertex="", vertices=2000000000),
        "no_face_properties": make_ply(face="", faces=2000000000),
        "list_of_x": make_ply(vertex=PLY_FLOATS.replace("float x", "list uchar float x")),
        "faces_without_list": make_ply(face="property int vertex_indices\n"),
        "list_of_floats": make_ply(face="property list float int vertex_indices\n"),
        "unknown_type": make_ply(vertex=PLY_FLOATS.replace("float x", "quad x")),
        "property_first": b"ply\nformat ascii 1.0\nproperty float x\nend_header\n",
        "short_property": make_ply(vertex=PLY_FLOATS + "property list\n"),
        "far_index": make_ply(body=b"0 0 0\n1 0 0\n0 1 0\n3 0 1 999999999\n"),
        "negative_index": make_ply(body=b"0 0 0\n1 0 0\n0 1 0\n3 0 1 -2147483648\n"),
        "long_list": make_ply(little, body=points + struct.pack("<B3i", 255, 0, 1, 2)),
        "huge_list": make_ply(little, face="property list uint int vertex_indices\n",
                              body=points + struct.pack("<I3i", 0xffffffff, 0, 1, 2)),
        "negative_list": make_ply(little, face="property list int int vertex_indices\n",
                                  body=points + struct.pack("<i3i", -1, 0, 1, 2)),
        "short_lists": make_ply(faces=4, body=b"0 0 0\n1 0 0\n0 1 0\n0\n1 0\n2 0 1\n3 0 1 2\n"),
        "words": make_ply(body=b"0 0 zero\n1 0 0\n0 1 0\n3 0 1 2\n"),
        "nan": make_ply(body=b"nan 0 0\n1 inf 0\n0 1e999 0\n3 0 1 2\n"),
        "long_line": make_ply(body=b"0 0 0 1 0 0 0 1 0 3 0 1 2" + b" " * 100000),
        "texture_lists": make_ply(
            face=PLY_LIST + "property list uchar float texcoord\n",
            body=b"0 0 0\n1 0 0\n0 1 0\n3 0 1 77777777 6 0 0 1 0 0 1\n"),
        "faces_first": b"ply\nformat ascii 1.0\nelement face 1\n" + PLY_LIST.encode()
                       + b"element vertex 3\n" + PLY_FLOATS.encode()
                       + b"end_header\n3 0 1 2\n0 0 0\n1 0 0\n0 1 0\n",
        "two_vertex_elements": make_ply().replace(b"element face 1", b"element vertex 1"),
        "no_vertices": make_ply(vertices=0, faces=1, body=b"3 0 1 2\n"),
        "long_polygon": make_ply(face="property list ushort int vertex_indices\n",
                                 body=b"0 0 0\n1 0 0\n0 1 0\n300 " + b"0 1 2 " * 100 + b"\n"),
        "long_words": b"ply\nformat ascii 1.0\nelement " + b"v" * 100000 + b" 3\nend_header\n",
    }
    return ".ply", sound, broken


def make_obj_files():
    """OBJ files."""
    points = b"v 0 0 0\nv 1 0 0\nv 0 1 0\n"
    sound = {
        "plain": b"v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvn 0 0 1\nf 1/1/1 2/1/1 3/1/1\n",
        "colors": b"v 0 0 0 1 0 0\nv 1 0 0 0 1 0\nv 0 1 0 0 0 1\nf 1 2 3\n",
        "signs": b"v +0 -0. .0\nv +1.0e0 0 0\nv 0 1E+0 -.5\nf 1 2 3 # the only face\n",
        "no_library": b"mtllib nowhere.mtl\n" + points + b"usemtl a\nf 1 2 3\n",
        "own_library": b"mtllib obj_sound_own_library.obj\nnewmtl a\nKd 1 0 0\nmap_Kd a.png\n"
                       + points + b"usemtl a\nf 1 2 3\n",
        "many_materials": points + b"".join(b"usemtl m%d\nf 1 2 3\n" % i for i in range(1000)),
        "mixed": points + b"vt 0 0\nvn 0 0 1\nf 1/1 2//1 3\nf 1/1/1 2/1/1 3/1/1\n",
    }
    broken = {
        "comma": b"v 0,5 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n",
        "hexadecimal": b"v 0x1p2 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n",
        "two_signs": b"v +-1 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n",
        "few_normals": points + b"vn 0 0\nf 1 2 3\n",
        "nan_texture": points + b"vt nan 0\nf 1/1 2/1 3/1\n",
        "device_library": b"mtllib /dev/zero\n" + points + b"usemtl a\nf 1 2 3\n",
        "folder_library": b"mtllib .\nmtllib\n" + points + b"usemtl\nf 1 2 3\n",
        "empty": b"",
        "zeros": bytes(1000),
        "far_index": points + b"f 1 2 999999999\n",
        "huge_index": points + b"f 1 2 99999999999999999999\n",
        "zero_index": points + b"f 0 1 2\n",
        "negative_index": points + b"f -1 -2 -9999\n",
        "far_texture": points + b"f 1/9 2/9 3/9\n",
        "far_normal": points + b"f 1//9 2//9 3//9\n",
        "far_line": points + b"l 1 77\n",
        "far_point": points + b"p 77\n",
        "short_face": points + b"f 1\nf 1 2\nf\n",
        "short_vertex": b"v 0\nv\nv 1 0 0\nf 1 2 3\n",
        "slashes": points + b"f / // ///\nf 1/ 2/ 3/\nf 1// 2// 3//\n",
        "words": b"v a b c\nv 1 0 0\nv 0 1 0\nf one two three\n",
        "nan": b"v nan 0 0\nv inf 0 0\nv 0 1e999 0\nf 1 2 3\n",
        "continued": points + b"f 1 2 \\\n3\nf 1 2 \\",
        "no_points": b"f 1 2 3\n",
        "late_material": points + b"vt 0 0\nf 1/1 2/1 3/1\nusemtl a\nf 1/1 2/1 3/1\n",
        "later_points": b"f 1/1/1 2/1/1 3/1/1\n" + points + b"vt 0 0\nvn 0 0 1\n",
        "some_textures": points + b"vt 0 0\nusemtl a\nf 1/1 2/1 3/1\nusemtl b\nf 1 2 3\n",
        "long_line": points + b"f " + b"1 2 3 " * 60000 + b"\n",
    }
    return ".obj", sound, broken


def make_stl_files():
    """STL files."""
    facet = struct.pack("<12fH", 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0)
    text = b"solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\n" \
           b"endloop\nendfacet\nendsolid a\n"
    sound = {
        "ascii": text, "binary": bytes(80) + struct.pack("<I", 1) + facet, "upper": text.upper(),
        "utf8": text.replace(b"solid a", "solid Gehäuse".encode()),
        "letters": text.replace(b"solid a", "solid 部品番号".encode()),
        "nan_normal": text.replace(b"normal 0 0 1", b"normal nan nan nan"),
        "binary_solid": b"solid".ljust(80) + struct.pack("<I", 1) + facet}
    broken = {
        "empty": b"",
        "header": bytes(40),
        "cut_solid": b"solid".ljust(80) + struct.pack("<I", 2) + facet,
        "count_alone": bytes(80) + struct.pack("<I", 5),
        "many": bytes(80) + struct.pack("<I", 0xffffffff) + facet,
        "few": bytes(80) + struct.pack("<I", 0) + facet,
        "cut": bytes(80) + struct.pack("<I", 2) + facet + facet[:20],
        "nan": bytes(80) + struct.pack("<I", 1) + struct.pack("<12fH", *([float("nan")] * 12), 0),
        "ascii_cut": text[:60],
        "ascii_nan": text.replace(b"1 0 0", b"nan 0 0"),
        "ascii_comma": text.replace(b"1 0 0", b"1,5 0 0"),
        "ascii_huge": text.replace(b"1 0 0", b"1e999 0 0"),
        "ascii_words": text.replace(b"1 0 0", b"one 0 0"),
        "ascii_short": text.replace(b"1 0 0", b"1 0"),
        "ascii_two_vertices": text.replace(b"vertex 0 1 0\n", b""),
        "ascii_no_end": text.replace(b"endfacet\n", b""),
        "solid_alone": b"solid",
        "ascii_zeros": b"solid\0\0\0\0facet\0",
        "ascii_long": b"solid " + b"x" * 100000 + text,
    }
    return ".stl", sound, broken


def make_vtp(points="0 0 0 1 0 0 0 1 0", ids="0 1 2", offsets="3", count=3, polys=1, extra="",
             kind="Float32", components=3):
    """A .vtp file."""
    return f"""<VTKFile type="PolyData" version="0.1" byte_order="LittleEndian">
<PolyData><Piece NumberOfPoints="{count}" NumberOfPolys="{polys}">{extra}
<Points><DataArray type="{kind}" NumberOfComponents="{components}" format="ascii">{points}</DataArray>
</Points><Polys><DataArray type="Int64" Name="connectivity" format="ascii">{ids}</DataArray>
<DataArray type="Int64" Name="offsets" format="ascii">{offsets}</DataArray></Polys>
</Piece></PolyData></VTKFile>
""".encode()


def make_vtp_files():
    """Files of VTK's polygonal data."""
    def make_colors(values):
        return f"<PointData Scalars=\"C\"><DataArray type=\"UInt8\" Name=\"C\" format=\"ascii\" " \
               f"NumberOfComponents=\"3\">{values}</DataArray></PointData>"

    def make_compressed(*header):
        text = base64.b64encode(struct.pack(f"<{len(header)}I", *header)).decode()
        return make_vtp().replace(b"<VTKFile ", b'<VTKFile compressor="vtkZLibDataCompressor" ') \
            .replace(b'format="ascii">0 0 0 1 0 0 0 1 0', f'format="binary">{text}'.encode())
    appended = b"""<VTKFile type="PolyData" version="0.1" byte_order="LittleEndian">
<PolyData><Piece NumberOfPoints="3" NumberOfPolys="1"><Points>
<DataArray type="Float32" NumberOfComponents="3" format="appended" offset="OFFSET"/></Points><Polys>
<DataArray type="Int64" Name="connectivity" format="ascii">0 1 2</DataArray>
<DataArray type="Int64" Name="offsets" format="ascii">3</DataArray></Polys></Piece></PolyData>
<AppendedData encoding="raw">_""" + struct.pack("<I9f", 36, *sum(TRIANGLE, ())) \
        + b"</AppendedData></VTKFile>"
    sound = {"plain": make_vtp(), "appended": appended.replace(b"OFFSET", b"0")}
    broken = {
        "empty": b"",
        "cut": make_vtp()[:300],
        "far_index": make_vtp(ids="0 1 99999999"),
        "negative_index": make_vtp(ids="0 1 -5"),
        "descending_offsets": make_vtp(ids="0 1 2 0 1 2", offsets="6 3", polys=2),
        "far_offset": make_vtp(offsets="3000000"),
        "negative_offset": make_vtp(offsets="-3"),
        "few_points": make_vtp(points="0 0 0"),
        "many_points": make_vtp(count=30),
        "huge_count": make_vtp(count=99999999999999),
        "negative_count": make_vtp(count=-1),
        "many_polys": make_vtp(polys=100),
        "huge_polys": make_vtp(polys=99999999999999),
        "few_colors": make_vtp(extra=make_colors("1 2 3")),
        "words": make_vtp(points="zero 0 0 1 0 0 0 1 0"),
        "text_points": make_vtp(kind="String"),
        "two_components": make_vtp(components=2),
        "no_components": make_vtp(components=0),
        "many_components": make_vtp(components=2147483647),
        "unknown_type": make_vtp(kind="Float12"),
        "nan": make_vtp(points="nan 0 0 1 0 0 0 1 0"),
        "other_type": make_vtp().replace(b"PolyData", b"ImageData"),
        "no_pieces": b'<VTKFile type="PolyData"><PolyData></PolyData></VTKFile>',
        "far_appended": appended.replace(b"OFFSET", b"99999999"),
        "negative_appended": appended.replace(b"OFFSET", b"-7"),
        "inner_appended": appended.replace(b"OFFSET", b"5"),
        "compressed": make_vtp().replace(b"<VTKFile ",
                                         b'<VTKFile compressor="vtkZLibDataCompressor" ')
                                .replace(b'"ascii"', b'"binary"'),
        "unknown_compressor": make_vtp().replace(b"<VTKFile ", b'<VTKFile compressor="vtkNone" '),
        "deep": b"<a>" * 10000,
        "deep_closed": b"<a>" * 300000 + b"</a>" * 300000,
        "many_blocks": make_compressed(0xfffffff0, 32768, 36),
        "large_blocks": make_compressed(1, 0xfffffff0, 0),
        "large_last_block": make_compressed(1, 32768, 0xfffffff0),
        "large_compressed": make_compressed(1, 32768, 36, 0xfffffff0),
    }
    return ".vtp", sound, broken


def make_vtm_files():
    """Trees of files: of themselves, of nothing, and of missing files."""
    def make(content):
        return f'<VTKFile type="vtkMultiBlockDataSet" version="1.0"><vtkMultiBlockDataSet>' \
               f'{content}</vtkMultiBlockDataSet></VTKFile>'.encode()
    broken = {
        "empty": b"",
        "none": make(""),
        "nowhere": make('<DataSet index="0" file="nowhere.vtp"/>'),
        "itself": make('<DataSet index="0" file="vtm_itself.vtm"/>'),
        "far_block": make('<DataSet index="999999999" file="vtp_sound_plain.vtp"/>'),
        "negative_block": make('<DataSet index="-5" file="vtp_sound_plain.vtp"/>'),
        "deep": make('<Block index="0">' * 20000 + "</Block>" * 20000),
        "many_blocks": make("".join(f'<Block index="{i}"><Block index="1000000"/></Block>'
                                    for i in range(60))),
        "broken_part": make('<DataSet index="0" file="vtp_far_index.vtp"/>'),
        "broken_grid": make('<DataSet index="0" file="vtu_far_index.vtu"/>'),
    }
    sound = {"plain": make('<DataSet index="0" file="vtp_sound_plain.vtp"/>'),
             "grid": make('<DataSet index="0" file="vtu_sound_plain.vtu"/>')}
    return ".vtm", sound, broken


def make_vtu(points="0 0 0 1 0 0 0 1 0 0 0 1", ids="0 1 2 3", offsets="4", types="10", count=4,
             cells=1, extra=""):
    """A .vtu file of a tetrahedron."""
    return f"""<VTKFile type="UnstructuredGrid" version="0.1" byte_order="LittleEndian">
<UnstructuredGrid><Piece NumberOfPoints="{count}" NumberOfCells="{cells}">{extra}
<Points><DataArray type="Float64" NumberOfComponents="3" format="ascii">{points}</DataArray></Points>
<Cells><DataArray type="Int64" Name="connectivity" format="ascii">{ids}</DataArray>
<DataArray type="Int64" Name="offsets" format="ascii">{offsets}</DataArray>
<DataArray type="UInt8" Name="types" format="ascii">{types}</DataArray></Cells>
</Piece></UnstructuredGrid></VTKFile>
""".encode()


def make_vtu_files():
    """Files of VTK's unstructured grids."""
    colors = '<CellData Scalars="C"><DataArray type="UInt8" Name="C" format="ascii" ' \
             'NumberOfComponents="3">255 0 0</DataArray></CellData>'
    sound = {"plain": make_vtu(), "colors": make_vtu(extra=colors)}
    broken = {
        "empty": b"",
        "cut": make_vtu()[:400],
        "far_index": make_vtu(ids="0 1 2 99999999"),
        "negative_index": make_vtu(ids="0 1 2 -5"),
        "far_offset": make_vtu(offsets="3000000"),
        "negative_offset": make_vtu(offsets="-3"),
        "descending_offsets": make_vtu(ids="0 1 2 3 0 1 2 3", offsets="8 4", types="10 10", cells=2),
        "few_types": make_vtu(ids="0 1 2 3 0 1 2 3", offsets="4 8", cells=2),
        "unknown_type": make_vtu(types="200"),
        "short_cell": make_vtu(ids="0 1", offsets="2"),
        "short_hexahedron": make_vtu(types="12"),
        "polyhedron_without_faces": make_vtu(types="42"),
        "higher_order": make_vtu(types="71"),
        "empty_cell": make_vtu(ids="", offsets="0"),
        "few_points": make_vtu(points="0 0 0"),
        "huge_count": make_vtu(count=99999999999999),
        "huge_cells": make_vtu(cells=99999999999999),
        "negative_count": make_vtu(count=-1),
        "few_colors": make_vtu(extra=colors.replace("255 0 0", "255")),
        "nan": make_vtu(points="nan 0 0 1 0 0 0 1 0 0 0 1"),
        "words": make_vtu(points="zero 0 0 1 0 0 0 1 0 0 0 1"),
        "other_type": make_vtu().replace(b"UnstructuredGrid", b"Table"),
    }
    return ".vtu", sound, broken


def make_image(kind="ImageData", extent="0 2 0 2 0 2", inner="", more=""):
    """A file of structured data."""
    return f"""<VTKFile type="{kind}" version="0.1" byte_order="LittleEndian">
<{kind} WholeExtent="{extent}" {more}><Piece Extent="{extent}">{inner}</Piece></{kind}></VTKFile>
""".encode()


def make_vti_files():
    """Files of VTK's image data."""
    scalars = '<PointData Scalars="S"><DataArray type="Float32" Name="S" format="ascii">' \
              + " ".join(map(str, range(27))) + "</DataArray></PointData>"
    sound = {"plain": make_image(), "scalars": make_image(inner=scalars)}
    broken = {
        "empty": b"",
        "huge": make_image(extent="0 99999 0 99999 0 99999"),
        "overflow": make_image(extent="-2147483648 2147483647 0 2 0 2"),
        "upside_down": make_image(extent="2 0 2 0 2 0"),
        "point": make_image(extent="0 0 0 0 0 0"),
        "few_scalars": make_image(inner=scalars.replace("20 ", "")),
        "spacing": make_image(more='Spacing="nan 0 -1"'),
        "short_extent": make_image(extent="0 2"),
    }
    return ".vti", sound, broken


def make_vtr_files():
    """Files of VTK's rectilinear grids."""
    def make(x="0 1 2", y="0 1 2", z="0 1 2", extent="0 2 0 2 0 2"):
        axes = "".join(f'<DataArray type="Float32" format="ascii">{axis}</DataArray>'
                       for axis in (x, y, z))
        return make_image("RectilinearGrid", extent, f"<Coordinates>{axes}</Coordinates>")
    broken = {"empty": b"", "few": make(x="0 1"), "none": make_image("RectilinearGrid"),
              "nan": make(x="nan nan nan"), "huge": make(extent="0 99999 0 99999 0 99999")}
    return ".vtr", {"plain": make()}, broken


def make_vts_files():
    """Files of VTK's structured grids."""
    def make(points=None, extent="0 2 0 2 0 2"):
        points = points or " ".join(f"{i % 3} {i // 3 % 3} {i // 9}" for i in range(27))
        return make_image("StructuredGrid", extent,
                          '<Points><DataArray type="Float32" NumberOfComponents="3" '
                          f'format="ascii">{points}</DataArray></Points>')
    broken = {"empty": b"", "few": make("0 0 0 1 1 1"), "none": make_image("StructuredGrid"),
              "huge": make(extent="0 99999 0 99999 0 99999")}
    return ".vts", {"plain": make()}, broken


def make_vtk_files():
    """Legacy files of VTK."""
    def make(kind, content, form="ASCII"):
        return f"# vtk DataFile Version 3.0\ntitle\n{form}\nDATASET {kind}\n{content}".encode()
    points = "POINTS 4 float\n0 0 0 1 0 0 0 1 0 0 0 1\n"
    grid = points + "CELLS 1 5\n4 0 1 2 3\nCELL_TYPES 1\n10\n"
    image = "DIMENSIONS 3 3 3\nORIGIN 0 0 0\nSPACING 1 1 1\n"
    scalars = "POINT_DATA 27\nSCALARS s float 1\nLOOKUP_TABLE default\n" + "1 " * 27 + "\n"
    axes = "".join(f"{axis}_COORDINATES 3 float\n0 1 2\n" for axis in "XYZ")
    lattice = " ".join(f"{i % 3} {i // 3 % 3} {i // 9}" for i in range(27))
    polygons = points + "POLYGONS 1 4\n3 0 1 2\n"
    binary_grid = make("UNSTRUCTURED_GRID", "POINTS 4 float\n", "BINARY") \
        + struct.pack(">12f", 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1) \
        + b"\nCELLS 1 5\n" + struct.pack(">5i", 4, 0, 1, 2, 3) \
        + b"\nCELL_TYPES 1\n" + struct.pack(">i", 10) + b"\n"
    sound = {
        "grid": make("UNSTRUCTURED_GRID", grid), "image": make("STRUCTURED_POINTS", image + scalars),
        "rectilinear": make("RECTILINEAR_GRID", "DIMENSIONS 3 3 3\n" + axes),
        "structured": make("STRUCTURED_GRID", f"DIMENSIONS 3 3 3\nPOINTS 27 float\n{lattice}\n"),
        "polygons": make("POLYDATA", polygons), "binary": binary_grid}
    broken = {
        "empty": b"",
        "text": b"no grid\n",
        "no_type": make("FRACTAL", points),
        "far_index": make("UNSTRUCTURED_GRID", grid.replace("0 1 2 3\nCELL", "0 1 2 99999999\nCELL")),
        "negative_index": make("UNSTRUCTURED_GRID", grid.replace("0 1 2 3\nCELL", "0 1 2 -9\nCELL")),
        "negative_points": make("UNSTRUCTURED_GRID", grid.replace("POINTS 4", "POINTS -4")),
        "negative_cells": make("UNSTRUCTURED_GRID", grid.replace("CELLS 1 5", "CELLS -1 -5")),
        "huge_points": make("UNSTRUCTURED_GRID", grid.replace("POINTS 4", "POINTS 33333333333")),
        "huge_cells": make("UNSTRUCTURED_GRID", grid.replace("CELLS 1 5", "CELLS 1 33333333333")),
        "many_cells": make("UNSTRUCTURED_GRID", grid.replace("CELLS 1 5", "CELLS 50 5")),
        "long_cell": make("UNSTRUCTURED_GRID", grid.replace("4 0 1 2 3", "400 0 1 2 3")),
        "negative_cell": make("UNSTRUCTURED_GRID", grid.replace("4 0 1 2 3", "-4 0 1 2 3")),
        "unknown_cell": make("UNSTRUCTURED_GRID", grid.replace("\n10\n", "\n250\n")),
        "many_types": make("UNSTRUCTURED_GRID", grid.replace("CELL_TYPES 1", "CELL_TYPES 99")),
        "cut": make("UNSTRUCTURED_GRID", grid[:40]),
        "words": make("UNSTRUCTURED_GRID", grid.replace("1 0 0", "one 0 0")),
        "huge_image": make("STRUCTURED_POINTS", image.replace("3 3 3", "30000 30000 30000")),
        "large_image": make("STRUCTURED_POINTS", image.replace("3 3 3", "2000 2000 2000")),
        "negative_image": make("STRUCTURED_POINTS", image.replace("3 3 3", "-3 -3 -3")),
        "few_scalars": make("STRUCTURED_POINTS", image + scalars[:90]),
        "huge_scalars": make("STRUCTURED_POINTS", image + scalars.replace("float 1", "float 99999999")),
        "more_data": make("STRUCTURED_POINTS", image + scalars.replace("DATA 27", "DATA 2700000000")),
        "few_axes": make("RECTILINEAR_GRID", "DIMENSIONS 3 3 3\nX_COORDINATES 2 float\n0 1\n"),
        "no_axes": make("RECTILINEAR_GRID", "DIMENSIONS 3 3 3\n"),
        "few_lattice": make("STRUCTURED_GRID", "DIMENSIONS 9 9 9\nPOINTS 4 float\n" + lattice),
        "far_polygon": make("POLYDATA", polygons.replace("3 0 1 2", "3 0 1 222222")),
        "long_polygon": make("POLYDATA", polygons.replace("3 0 1 2", "300000 0 1 2")),
        "field": make("FIELD f 1", "a 1 1 float\n1\n").replace(b"DATASET ", b""),
        "binary_cut": binary_grid[:120],
        "binary_far": binary_grid.replace(struct.pack(">5i", 4, 0, 1, 2, 3),
                                          struct.pack(">5i", 4, 0, 1, 2, 1 << 30)),
        "binary_long": binary_grid.replace(struct.pack(">5i", 4, 0, 1, 2, 3),
                                           struct.pack(">5i", 1 << 30, 0, 1, 2, 3)),
        "binary_negative": binary_grid.replace(struct.pack(">5i", 4, 0, 1, 2, 3),
                                               struct.pack(">5i", -4, 0, 1, 2, 3)),
    }
    return ".vtk", sound, broken


def make_parallel(kind, extension, piece):
    """A parallel file of one piece."""
    points = '<PPoints><PDataArray type="Float64" NumberOfComponents="3"/></PPoints>'
    return f'<VTKFile type="{kind}" version="0.1" byte_order="LittleEndian"><{kind} GhostLevel="0">' \
           f'{points}<Piece Source="{piece}{extension}"/></{kind}></VTKFile>'.encode()


def make_pvtu_files():
    """Parallel files: of nothing, of missing and of broken pieces."""
    def make(piece, extension=".vtu"):
        return make_parallel("PUnstructuredGrid", extension, piece)
    broken = {"empty": b"", "nowhere": make("nowhere"), "broken_piece": make("vtu_far_index"),
              "itself": make("pvtu_itself", ".pvtu"), "huge_piece": make("vtu_huge_count"),
              "other_piece": make("vtp_sound_plain", ".vtp")}
    return ".pvtu", {"plain": make("vtu_sound_plain")}, broken


def make_pvtp_files():
    """The same for polygonal data."""
    def make(piece):
        return make_parallel("PPolyData", ".vtp", piece)
    broken = {"empty": b"", "nowhere": make("nowhere"), "broken_piece": make("vtp_far_index")}
    return ".pvtp", {"plain": make("vtp_sound_plain").replace(b"Float64", b"Float32")}, broken


def make_pvd_files():
    """Collections of files."""
    def make(content):
        return f'<VTKFile type="Collection" version="0.1"><Collection>{content}</Collection>' \
               f'</VTKFile>'.encode()

    def make_entry(file, time=0):
        return f'<DataSet timestep="{time}" part="0" file="{file}"/>'
    sound = {"plain": make(make_entry("vtu_sound_plain.vtu") + make_entry("vtp_sound_plain.vtp")),
             "steps": make(make_entry("nowhere.vtu", 2) + make_entry("vtk_sound_grid.vtk", 1))}
    broken = {
        "empty": b"", "none": make(""), "nowhere": make(make_entry("nowhere.vtu")),
        "itself": make(make_entry("pvd_itself.pvd")), "no_file": make('<DataSet timestep="0"/>'),
        "device": make(make_entry("/dev/zero")), "time": make(make_entry("a.vtu", "soon")),
        "deep": b"<a>" * 300000, "many": make(make_entry("vtu_sound_plain.vtu") * 200),
        "broken_entry": make(make_entry("vtu_far_index.vtu"))}
    return ".pvd", sound, broken


def make_gltf(change=lambda document: None):
    """A .gltf file with a triangle."""
    data = b"".join(struct.pack("<3f", *point) for point in TRIANGLE) + struct.pack("<3H", 0, 1, 2)
    uri = "data:application/octet-stream;base64," + base64.b64encode(data).decode()
    document = {
        "asset": {"version": "2.0"},
        "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}],
        "buffers": [{"byteLength": 42, "uri": uri}],
        "bufferViews": [{"buffer": 0, "byteLength": 36},
                        {"buffer": 0, "byteOffset": 36, "byteLength": 6}],
        "accessors": [
            {"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"},
            {"bufferView": 1, "componentType": 5123, "count": 3, "type": "SCALAR"}]}
    change(document)
    return json.dumps(document).encode()


def make_gltf_files():
    """glTF files; TestCSLFGLTFReaderInvalid has many more faults."""
    def set_far_mesh(document):
        document["nodes"][0]["mesh"] = 7

    def set_loop(document):
        document["nodes"][0]["children"] = [0]

    def set_count(document):
        document["accessors"][0]["count"] = 1 << 60

    def set_few(document):
        document["accessors"][0]["count"] = 1

    broken = {
        "empty": b"", "list": b"[]", "cut": make_gltf()[:200], "deep": b"[" * 100000,
        "far_mesh": make_gltf(set_far_mesh), "loop": make_gltf(set_loop),
        "huge_count": make_gltf(set_count), "far_index": make_gltf(set_few)}
    return ".gltf", {"plain": make_gltf()}, broken


def make_glb_files():
    """Binary glTF files."""
    text = make_gltf()
    text += b" " * (-len(text) % 4)
    sound = struct.pack("<4sIII4s", b"glTF", 2, 20 + len(text), len(text), b"JSON") + text
    broken = {
        "header": sound[:12], "cut": sound[:100],
        "long_chunk": sound[:12] + struct.pack("<I", 0xffffffff) + sound[16:],
        "version": sound[:4] + struct.pack("<I", 9) + sound[8:]}
    return ".glb", {"plain": sound}, broken


def mutate(data, generator):
    """Changes, removes, repeats or inserts a few bytes."""
    data = bytearray(data)
    for _ in range(generator.randint(1, 6)):
        place = generator.randrange(len(data) + 1)
        length = generator.randint(1, 8)
        kind = generator.randrange(6)
        if kind == 0:
            data[place:place + 1] = bytes([generator.randrange(256)])
        elif kind == 1:
            del data[place:place + length]
        elif kind == 2:
            data[place:place] = data[max(0, place - length):place]
        elif kind == 3:
            data[place:place] = generator.choice(
                [b"-1", b"99999999999", b"0", b"1e999", b"nan", b"\0", b"\xff\xff\xff\xff", b"2"])
        elif kind == 4:
            digits = [i for i, byte in enumerate(data) if 48 <= byte <= 57]
            if digits:
                data[generator.choice(digits)] = generator.choice(b"0123456789-")
        elif generator.random() < 0.2:
            del data[place:]
    return bytes(data)


def main():
    """Writes the files."""
    parser = argparse.ArgumentParser(description=__doc__.split("\n", maxsplit=1)[0])
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("--mutations", type=int, default=0, help="of each sound file (default: 0)")
    parser.add_argument("--seed", type=int, default=0)
    options = parser.parse_args()
    options.folder.mkdir(parents=True, exist_ok=True)
    generator = random.Random(options.seed)
    for make in (make_ply_files, make_obj_files, make_stl_files, make_vtp_files, make_vtm_files,
                 make_vtu_files, make_vti_files, make_vtr_files, make_vts_files, make_vtk_files,
                 make_pvtu_files, make_pvtp_files, make_pvd_files, make_gltf_files, make_glb_files):
        extension, sound, broken = make()
        files = {f"sound_{name}": data for name, data in sound.items()}
        files.update(broken)
        for name, data in sound.items():
            for i in range(options.mutations):
                files[f"mutated_{name}_{i}"] = mutate(data, generator)
        for name, data in files.items():
            (options.folder / f"{extension[1:]}_{name}{extension}").write_bytes(data)


if __name__ == "__main__":
    main()
