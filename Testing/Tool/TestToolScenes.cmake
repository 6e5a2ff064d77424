# SPDX-FileCopyrightText: Copyright (c) CSLF contributors
# SPDX-License-Identifier: BSD-3-Clause

# Scenes of every format, traced.
include("${CMAKE_CURRENT_LIST_DIR}/cslfToolTesting.cmake")

set(view --size 32 24 --spp 4 --max-depth 2)
cslf_run(trace cornell-box -o box.png ${view})
cslf_run(trace "${DATA}/dragon.ply" -o dragon.png ${view} --environment gradient --roughness 0.3 --metallic 1
  --base-color 0.9 0.6 0.3)

# The scenes that need no files.
cslf_run(scenes)
foreach (name IN ITEMS cornell-box isosurfaces streamlines glyphs terrain assembly turbulence pipes)
  if (NOT output MATCHES "(^|\n)${name} +[A-Z0-9][^\n]+\\.\n")
    message(FATAL_ERROR "cslf scenes does not list ${name}:\n${output}")
  endif ()
endforeach ()
cslf_run(scenes --json)
expect_json(cornell-box scenes 0 name)
expect_json(40 scenes 0 triangles)
expect_json(-1.0 scenes 0 bounds 0)
expect_json(isosurfaces scenes 1 name)
expect_json(137778 scenes 1 triangles)
expect_json(30.0 scenes 1 bounds 5)
expect_json(20000 scenes 3 instances)
cslf_run(sample glyphs -o glyphs.vti -M 2 -N 8 --spp 1 --max-depth 1 --integrator path
  --geometry-triangles 0)
lab_run(evaluate-texels glyphs.vti glyphs --texels 100 --reference-spp 64)
cslf_run(trace pipes terrain -o scenes.png ${view} --roughness 0.5)

# One square in four formats gives one picture.
file(WRITE "${DIRECTORY}/square.obj"
  "v -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\nf 1 2 3\nf 1 3 4\n")
file(WRITE "${DIRECTORY}/square.stl" "solid square
facet normal 0 0 1
outer loop
vertex -1 -1 0
vertex 1 -1 0
vertex 1 1 0
endloop
endfacet
facet normal 0 0 1
outer loop
vertex -1 -1 0
vertex 1 1 0
vertex -1 1 0
endloop
endfacet
endsolid square
")
file(WRITE "${DIRECTORY}/square.ply" "ply
format ascii 1.0
element vertex 4
property float x
property float y
property float z
element face 2
property list uchar int vertex_indices
end_header
-1 -1 0
1 -1 0
1 1 0
-1 1 0
3 0 1 2
3 0 2 3
")
file(WRITE "${DIRECTORY}/square.vtp" "<VTKFile type=\"PolyData\" version=\"0.1\">
<PolyData><Piece NumberOfPoints=\"4\" NumberOfPolys=\"2\">
<Points><DataArray type=\"Float32\" NumberOfComponents=\"3\" format=\"ascii\">
-1 -1 0 1 -1 0 1 1 0 -1 1 0</DataArray></Points>
<Polys><DataArray type=\"Int64\" Name=\"connectivity\" format=\"ascii\">0 1 2 0 2 3</DataArray>
<DataArray type=\"Int64\" Name=\"offsets\" format=\"ascii\">3 6</DataArray></Polys>
</Piece></PolyData></VTKFile>
")
file(WRITE "${DIRECTORY}/square.vtm" "<VTKFile type=\"vtkMultiBlockDataSet\" version=\"1.0\">
<vtkMultiBlockDataSet><DataSet index=\"0\" file=\"square.vtp\"/></vtkMultiBlockDataSet></VTKFile>
")
# In glTF, a node turns a square of half the size and doubles it.
file(WRITE "${DIRECTORY}/square.gltf" "{\"asset\": {\"version\": \"2.0\"}, \"scene\": 0,
\"scenes\": [{\"nodes\": [0]}],
\"nodes\": [{\"mesh\": 0, \"scale\": [2, 2, 2], \"rotation\": [0, 0, 1, 0]}],
\"meshes\": [{\"primitives\": [{\"attributes\": {\"POSITION\": 0}, \"indices\": 1}]}],
\"accessors\": [
{\"bufferView\": 0, \"componentType\": 5126, \"count\": 4, \"type\": \"VEC3\",
 \"min\": [-0.5, -0.5, 0], \"max\": [0.5, 0.5, 0]},
{\"bufferView\": 1, \"componentType\": 5123, \"count\": 6, \"type\": \"SCALAR\"}],
\"bufferViews\": [{\"buffer\": 0, \"byteOffset\": 0, \"byteLength\": 48},
{\"buffer\": 0, \"byteOffset\": 48, \"byteLength\": 12}],
\"buffers\": [{\"byteLength\": 60, \"uri\": \"data:application/octet-stream;base64,AAAAvwAAAL8AAAAAAAAAPwAAAL8AAAAAAAAAPwAAAD8AAAAAAAAAvwAAAD8AAAAAAAABAAIAAAACAAMA\"}]}
")
cslf_run(trace square.obj -o square.obj.png ${view})
foreach (format IN ITEMS stl ply vtp vtm gltf)
  cslf_run(trace square.${format} -o square.${format}.png ${view})
  cslf_run(compare square.${format}.png square.obj.png --json)
  # Noise depends only on how the square is cut.
  expect_json_at_least(30 psnr)
endforeach ()

# An exported scene looks like the original.
cslf_run(export square.vtm square.gltf -o squares.obj --json)
expect_json(4 triangles)
cslf_run(export square.ply -o exported.obj --json)
expect_json(2 triangles)
cslf_run(trace exported.obj -o exported.png ${view})
cslf_run(compare exported.png square.obj.png --json)
expect_json_at_least(30 psnr)
cslf_run(export cornell-box -o box.obj)

# Lines are tubes.
file(WRITE "${DIRECTORY}/lines.obj" "v 0 0 0\nv 1 0 0\nv 1 1 0\nl 1 2 3\n")
cslf_run(trace lines.obj -o lines.png ${view})

# Points are spheres: of a radius of 0.02 of the diagonal, as they are few, or of the given one. The
# cube is a tenth longer than the scene.
file(WRITE "${DIRECTORY}/cloud.ply" "ply
format ascii 1.0
element vertex 4
property float x
property float y
property float z
end_header
-1 -1 0
1 -1 0
1 1 0
-1 1 0
")
set(tiny -M 2 -N 2 --spp 1 --integrator path --geometry-triangles 0)
cslf_run(sample cloud.ply -o cloud.vti ${tiny})
cslf_run(info cloud.vti --json)
expect_json_at_least(2.3244 edge)
cslf_run(sample cloud.ply -o cloud.vti ${tiny} --point-radius 0.5)
cslf_run(info cloud.vti --json)
expect_json_at_least(3.2999 edge)
# Its views show what those of the scene do.
cslf_run(sample cloud.ply -o cloud.vti -M 2 -N 32 --spp 4 --max-depth 2 --point-radius 0.5)
cslf_run(trace cloud.ply -o cloud.png ${view} --point-radius 0.5)
cslf_run(render cloud.vti -o rendered.png --size 32 24)
cslf_run(compare rendered.png cloud.png --json)
expect_json_at_least(28 psnr)
cslf_fail("--point-radius" "x" trace cloud.ply -o x.png --point-radius -1)

# A square with a hole, whose outline has a bridge.
file(WRITE "${DIRECTORY}/hole.obj" "v 0 0 0\nv 4 0 0\nv 4 4 0\nv 0 4 0
v 1 1 0\nv 3 1 0\nv 3 3 0\nv 1 3 0\nf 1 2 3 4 1 5 6 7 8 5\n")
cslf_run(export hole.obj -o filled.obj --json)
expect_json(8 triangles)

# Vertex colours of glTF are linear: a red of 0.5 is brighter than in sRGB.
cslf_run(trace square.ply -o red.png ${view} --base-color 0.735 0 0)
file(READ "${DIRECTORY}/square.gltf" gltf)
string(REPLACE "\"POSITION\": 0}" "\"POSITION\": 0, \"COLOR_0\": 2}" gltf "${gltf}")
string(REPLACE "\"type\": \"SCALAR\"}]" "\"type\": \"SCALAR\"},
{\"bufferView\": 2, \"componentType\": 5126, \"count\": 4, \"type\": \"VEC3\"}]" gltf "${gltf}")
string(REPLACE "\"byteLength\": 12}]" "\"byteLength\": 12},
{\"buffer\": 1, \"byteOffset\": 0, \"byteLength\": 48}]" gltf "${gltf}")
string(REGEX REPLACE "\"}]}\n$" "\"},
{\"byteLength\": 48, \"uri\": \"data:application/octet-stream;base64,AAAAPwAAAAAAAAAAAAAAPwAAAAAAAAAAAAAAPwAAAAAAAAAAAAAAPwAAAAAAAAAA\"}]}\n" gltf "${gltf}")
file(WRITE "${DIRECTORY}/red.gltf" "${gltf}")
cslf_run(trace red.gltf -o red.gltf.png ${view})
cslf_run(compare red.gltf.png red.png --json)
expect_json_at_least(30 psnr)

cslf_run(sheet box.png dragon.png red.png -o sheet.png --columns 2 --label box --label dragon)
