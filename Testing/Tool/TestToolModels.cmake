# SPDX-FileCopyrightText: Copyright (c) CSLF contributors
# SPDX-License-Identifier: BSD-3-Clause

# The numbers, colours and materials of OBJ and STL files.
include("${CMAKE_CURRENT_LIST_DIR}/cslfToolTesting.cmake")

set(camera --light white --background black --size 32 24 --max-depth 1 --position 0 0 4 --focal-point 0 0 0)
set(view ${camera} --spp 16)
set(points "v -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\n")
set(faces "f 1 2 3\nf 1 3 4\n")

# Coordinates keep all their digits.
function (expect_points file)
  cslf_run(export ${file} -o exported.obj)
  file(STRINGS "${DIRECTORY}/exported.obj" lines REGEX "^v ")
  if (NOT lines STREQUAL "v 512345.6781 5432109.8764 -0.5;v 512346.6781 5432110.1111 0;v 512345.6781 5432110.1111 0.125")
    message(FATAL_ERROR "${file} has the points ${lines}.")
  endif ()
endfunction ()
set(far "512345.6781 5432109.8764 -.5" "512346.6781 5432110.1111 0" "512345.6781 5432110.1111 +1.25e-1")
list(JOIN far "\nv " text)
file(WRITE "${DIRECTORY}/far.obj" "v ${text}\nf 1 2 3\n")
expect_points(far.obj)
list(JOIN far "\nvertex " text)
file(WRITE "${DIRECTORY}/far.stl" "solid far\nfacet normal nan nan nan\nouter loop\nvertex ${text}\nendloop
endfacet\nendsolid far\n")
expect_points(far.stl)

# What is not a finite number is refused, as are lines with too few.
foreach (line IN ITEMS "v 0 0 nan" "v -inf 0 0" "v 0 0,5 0" "v 0 one 0" "v 1e999 0 0" "v 0 0 0x10"
         "v 0 0" "v 0 0 0 1 1" "vn 0 0 +-1" "vn 0 0" "vt 1.0.0" "vt")
  file(WRITE "${DIRECTORY}/bad.obj" "${points}${line}\n${faces}")
  cslf_fail("Cannot read bad.obj: line 5 has (a value that is not a finite number|too few values|neither)"
    "x" export bad.obj -o x.obj)
endforeach ()
foreach (value IN ITEMS nan 1,5 "")
  file(WRITE "${DIRECTORY}/bad.stl" "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0
vertex 1 0 ${value}\nvertex 0 1 0\nendloop\nendfacet\nendsolid a\n")
  cslf_fail("Cannot read bad.stl: line [56] has a value that is not a finite number" "x"
    export bad.stl -o x.obj)
endforeach ()
file(WRITE "${DIRECTORY}/bad.stl" "solid a\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nendloop\nendsolid a\n")
cslf_fail("line 5 ends a facet of 2 corners" "x" export bad.stl -o x.obj)

# A picture must be that of the square in one colour, or with the options given.
function (expect_picture file)
  cslf_run(trace square.obj -o expected.png ${view} ${ARGN})
  cslf_run(compare ${file}.png expected.png --json)
  expect_json_at_least(45 psnr)
endfunction ()
file(WRITE "${DIRECTORY}/square.obj" "${points}${faces}")

# Colours of vertices, as fractions and as bytes.
foreach (color IN ITEMS "0.8 0.4 0.2 1" "204 102 51")
  string(REGEX REPLACE "(v [^\n]*)\n" "\\1 ${color}\n" text "${points}")
  file(WRITE "${DIRECTORY}/colors.obj" "${text}${faces}")
  cslf_run(trace colors.obj -o colors.png ${view})
  expect_picture(colors --base-color 0.8 0.4 0.2)
endforeach ()

# ZBrush's colours of vertices, after a mask. Others than the vertices need are named.
file(WRITE "${DIRECTORY}/painted.obj"
  "#Auto scale\n${points}#MRGB ffcc6633ffcc6633ffcc6633\n#MRGB ffcc6633\n${faces}")
cslf_run(trace painted.obj -o painted.png ${view})
expect_picture(painted --base-color 0.8 0.4 0.2)
foreach (paint IN ITEMS ffcc6633 ffcc6633ffcc6633ffcc6633ffcc66 ffcc6633xxcc6633ffcc6633ffcc6633)
  file(WRITE "${DIRECTORY}/painted.obj" "${points}#MRGB ${paint}\n${faces}")
  cslf_warn(1 "#MRGB that does not fit" trace painted.obj -o painted.png ${view})
endforeach ()

# Comments after names, names with a number sign, quotes, and colours above 1.
file(WRITE "${DIRECTORY}/names.mtl" "newmtl red # as walls\nKd 0.8 0.4 0.2
newmtl Material #2\nKd 0.8 0.4 0.2\nnewmtl Material #3\nKd 1.5 1 0.5
map_Kd \"one colour.png\"\n")
foreach (name IN ITEMS "red" "red # once more" "Material #2")
  file(WRITE "${DIRECTORY}/named.obj" "mtllib \"names.mtl\"\n${points}usemtl ${name}\n${faces}")
  cslf_warn(1 "names.mtl were ignored: Kd above 1, which counts as 1"
    trace named.obj -o named.png ${view})
  expect_picture(named --base-color 0.8 0.4 0.2)
endforeach ()
file(WRITE "${DIRECTORY}/named.obj" "mtllib names.mtl\n${points}vt 0 0\nusemtl Material #3
f 1/1 2/1 3/1\n")
cslf_warn(2 "The texture one colour.png is missing" trace named.obj -o named.png ${view})

# Materials: colour, emission and transparency.
file(WRITE "${DIRECTORY}/all.mtl" "# materials
newmtl dark red
Ka 1 1 1
Kd 0.6 0.2 0.1
illum 2
newmtl light
Kd 0 0 0
Ke 0.25 0.5 0.125
newmtl glass
Kd 0.8 0.8 0.8
d 0.5
Tr 0
newmtl veil
Kd 0.8
Tr 0.5
newmtl picture
Kd 0.5 1 1
map_Kd -o 0.5 0 -s 1 1 1 -clamp on textures\\two colours.png
")
foreach (name IN ITEMS "dark red" light glass veil picture)
  file(WRITE "${DIRECTORY}/${name}.obj" "mtllib all.mtl\n${points}
vt .25 .5\nvt .25 .5\nvt .25 .5\nvt .25 .5\nusemtl ${name}\nf 1/1 2/2 3/3\nf 1/1 3/3 4/4\n")
endforeach ()
cslf_run(trace "dark red.obj" -o red.png ${view})
expect_picture(red --base-color 0.6 0.2 0.1)
cslf_run(trace glass.obj -o glass.png ${camera} --spp 1024)
cslf_run(trace veil.obj -o veil.png ${camera} --spp 1024)
file(MD5 "${DIRECTORY}/glass.png" glass)
file(MD5 "${DIRECTORY}/veil.png" veil)
if (NOT glass STREQUAL veil)
  message(FATAL_ERROR "An opacity of 0.5 is not a transparency of 0.5.")
endif ()
# Half of the light passes, and nothing is behind: the picture has half the displayed value of 0.8.
cslf_run(trace square.obj -o expected.png ${view} --base-color 0.4 0.4 0.4)
cslf_run(compare glass.png expected.png --json)
expect_json_at_least(32 psnr)
cslf_run(trace light.obj -o light.png ${view})
# The emission, sRGB-encoded, is that of a surface with these colours.
expect_picture(light --base-color 0.5371 0.7354 0.3886)
# The texture is red at the left and green at the right; the offset selects green.
file(MAKE_DIRECTORY "${DIRECTORY}/textures")
find_package(Python3 QUIET COMPONENTS Interpreter)
if (Python3_FOUND)
  execute_process(
    COMMAND "${Python3_EXECUTABLE}" -c "
import struct, zlib
def chunk(kind, data):
    return struct.pack('>I', len(data)) + kind + data + struct.pack('>I', zlib.crc32(kind + data))
row = b'\\0' + b'\\xff\\0\\0' * 2 + b'\\0\\xff\\0' * 2
open('textures/two colours.png', 'wb').write(b'\\x89PNG\\r\\n\\x1a\\n'
    + chunk(b'IHDR', struct.pack('>2I5B', 4, 2, 8, 2, 0, 0, 0))
    + chunk(b'IDAT', zlib.compress(row * 2)) + chunk(b'IEND', b''))"
    WORKING_DIRECTORY "${DIRECTORY}"
    COMMAND_ERROR_IS_FATAL ANY)
  cslf_run(trace picture.obj -o picture.png ${view})
  expect_picture(picture --base-color 0 1 0)
  file(REMOVE "${DIRECTORY}/textures/two colours.png")
endif ()

# What is missing is named, and the geometry is shown in the default colour.
cslf_warn(1 "textures/two colours.png is missing" trace picture.obj -o missing.png ${view})
expect_picture(missing --base-color 0.5 1 1)
file(REMOVE "${DIRECTORY}/all.mtl")
cslf_warn(1 "library all.mtl of light.obj is missing" trace light.obj -o missing.png ${view})
expect_picture(missing)
file(WRITE "${DIRECTORY}/all.mtl" "newmtl light\nKs 1 1 1\nmap_Bump a.png\nKd nan 0 0\nd 7\n")
execute_process(
  COMMAND "${CSLF}" trace light.obj -o invalid.png ${view}
  WORKING_DIRECTORY "${DIRECTORY}"
  RESULT_VARIABLE result
  OUTPUT_QUIET
  ERROR_VARIABLE error)
if (NOT result STREQUAL "0" OR NOT error STREQUAL
    "cslf: warning: Invalid lines of all.mtl were ignored: line 4 (Kd), line 5 (d).
cslf: warning: Unsupported features of all.mtl were ignored: Ks, map_Bump.\n")
  message(FATAL_ERROR "cslf trace light.obj ended with ${result}: ${error}")
endif ()
expect_picture(invalid)
file(WRITE "${DIRECTORY}/all.mtl" "newmtl other\nKd 1 0 0\n")
cslf_warn(1 "no library defines have the default colour: veil." trace veil.obj -o missing.png ${view})

# Faces of two materials, and of which only some have normals, are all shown.
file(WRITE "${DIRECTORY}/all.mtl" "newmtl a\nKd 0.9 0.9 0.9\nnewmtl b\nKd 0.9 0.9 0.9\n")
file(WRITE "${DIRECTORY}/two.obj" "mtllib all.mtl\n${points}vn 0 0 1\nusemtl a\nf 1 2 3
usemtl b\nf 1//1 3//1 4//1\n")
cslf_run(trace two.obj -o two.png ${view})
expect_picture(two --base-color 0.9 0.9 0.9)

# A mark of UTF-8, comments that end with a backslash or follow a name, and libraries under the path
# of another computer.
string(ASCII 239 187 191 mark)
file(WRITE "${DIRECTORY}/marked.obj" "${mark}mtllib C:\\work\\all.mtl # of a\n# C:\\work\\\n${points}usemtl a\n${faces}")
file(WRITE "${DIRECTORY}/all.mtl" "${mark}newmtl a\n# C:\\work\\\nKd 0.9 0.9 0.9\n")
cslf_run(trace marked.obj -o marked.png ${view})
expect_picture(marked --base-color 0.9 0.9 0.9)

# Vertices alone are a cloud of points; corners that share a vertex take no longer than others.
file(WRITE "${DIRECTORY}/cloud.obj" "${points}vn 0 0 1\n")
cslf_run(trace cloud.obj -o cloud.png ${view} --point-radius 0.3)
set(fan)
foreach (corner RANGE 1 20000)
  string(APPEND fan "vn 0 0 1\nf 1//${corner} 2//${corner} 3//${corner}\n")
endforeach ()
file(WRITE "${DIRECTORY}/fan.obj" "${points}${fan}")
cslf_run(export fan.obj -o exported.obj --json)
expect_json(20000 triangles)
