# SPDX-FileCopyrightText: Copyright (c) CSLF contributors
# SPDX-License-Identifier: BSD-3-Clause

# Scalars of a field in other colours than those of the bake.
include("${CMAKE_CURRENT_LIST_DIR}/cslfToolTesting.cmake")

# A square with the places of its points.
file(WRITE "${DIRECTORY}/square.vtp" "<VTKFile type=\"PolyData\" version=\"0.1\">
<PolyData><Piece NumberOfPoints=\"4\" NumberOfPolys=\"2\">
<Points><DataArray type=\"Float32\" NumberOfComponents=\"3\" format=\"ascii\">
-1 -1 0 1 -1 0 1 1 0 -1 1 0</DataArray></Points>
<PointData Scalars=\"place\">
<DataArray type=\"Float32\" Name=\"place\" NumberOfComponents=\"3\" format=\"ascii\">
-1 -1 0 1 -1 0 1 1 0 -1 1 0</DataArray></PointData>
<Polys><DataArray type=\"Int64\" Name=\"connectivity\" format=\"ascii\">0 1 2 0 2 3</DataArray>
<DataArray type=\"Int64\" Name=\"offsets\" format=\"ascii\">3 6</DataArray></Polys>
</Piece></PolyData></VTKFile>
")
set(exact --colors exact --color-by place:x)
cslf_run(sample square.vtp -o square.vti -M 2 -N 16 --quality preview ${exact} --color-map viridis)
set(view --size 64 64 --position 0 0 5)
function (expect_psnr least a b)
  cslf_run(compare ${a} ${b} --json)
  expect_json_at_least(${least} psnr)
endfunction ()

# What is known of the scalars.
cslf_run(info square.vti --json)
expect_json(place scalars 0 array)
expect_json(0 scalars 0 component)
expect_json(-1.0 scalars 0 map_range 0)
expect_json(1.0 scalars 0 map_range 1)
expect_json(OFF scalars 0 logarithmic)
expect_json_at_least(4 scalars 0 points)
expect_json_at_least(-1.01 scalars 0 range 0)
expect_json_at_least(0.99 scalars 0 range 1)
expect_json(1.0 geometry recolorable)
cslf_run(info square.vti)
if (NOT output MATCHES "geometry +[^\n]*, 100 % in other colours on request\n" OR
    NOT output MATCHES "scalars +place:0, [0-9]+ points .*, colour map from -1 to 1\n")
  message(FATAL_ERROR "The scalars are not listed: ${output}")
endif ()

# Pictures are those of the scene in these colours, also below and above the range.
foreach (range IN ITEMS "-1;1" "-1;0" "2;3" "-3;-2")
  foreach (map IN ITEMS gray plasma)
    set(look --color-by place:x --color-map ${map} --range ${range})
    cslf_run(render square.vti -o shown.png ${view} ${look})
    cslf_run(trace square.vtp -o traced.png ${view} --spp 16 --colors exact ${look})
    expect_psnr(40 shown.png traced.png)
  endforeach ()
endforeach ()
cslf_run(render square.vti -o own.png ${view})
cslf_run(render square.vti -o same.png ${view} --color-by place:0 --color-map viridis)
expect_psnr(50 own.png same.png)
cslf_run(render square.vti -o path --path orbit --frames 2 ${view} --color-map viridis)
cslf_run(render square.vti -o other --path orbit --frames 2 ${view} --color-map gray)
cslf_run(compare path/frame-0000.png other/frame-0000.png --json)
string(JSON psnr GET "${output}" psnr)
if (psnr GREATER 30)
  message(FATAL_ERROR "Along a path, the colour map changed nothing.")
endif ()

# Arrays that gave no colours are kept on request, also where there is one colour. Files without
# any are as ever.
set(plain sample square.vtp -M 2 -N 16 --quality preview --colors exact --color-by none)
cslf_run(${plain} -o none.vti --arrays none)
cslf_run(info none.vti --json)
string(JSON count LENGTH "${output}" scalars)
if (NOT count EQUAL 0)
  message(FATAL_ERROR "A field without arrays has scalars: ${output}")
endif ()
foreach (arrays IN ITEMS place all)
  cslf_run(${plain} -o kept.vti --arrays ${arrays})
  cslf_run(info kept.vti --json)
  string(JSON count LENGTH "${output}" scalars)
  if (NOT count EQUAL 4)
    message(FATAL_ERROR "A vector has four scalars: ${output}")
  endif ()
  expect_json(place scalars 0 array)
  expect_json(magnitude scalars 0 component)
  expect_json("" scalars 0 map_range)
  expect_json(0 scalars 1 component)
  expect_json_at_least(-1.01 scalars 1 range 0)
endforeach ()
foreach (component IN ITEMS x y) # the magnitude of the corners is not that of the middle
  set(look --color-by place:${component} --color-map plasma --range -1 2)
  cslf_run(render kept.vti -o shown.png ${view} ${look})
  cslf_run(trace square.vtp -o traced.png ${view} --spp 16 --colors exact ${look})
  expect_psnr(40 shown.png traced.png)
endforeach ()
cslf_warn(1 "without these arrays: speed" ${plain} -o kept.vti --arrays place,speed)

# A square beside one whose cells have colours of their own, which keeps no arrays and says so. Large
# whole numbers have all their digits.
foreach (name IN ITEMS id beside)
  set(id "<DataArray type=\"Int64\" Name=\"${name}\" format=\"ascii\">1234567890123 1234567890124</DataArray>")
  set(paint "<DataArray type=\"UInt8\" Name=\"paint\" NumberOfComponents=\"3\" format=\"ascii\">
255 0 0 0 0 255</DataArray>")
  file(READ "${DIRECTORY}/square.vtp" text)
  if (name STREQUAL "id")
    string(REGEX REPLACE "<PointData.*</PointData>" "<CellData>${id}</CellData>" text "${text}")
  else ()
    string(REGEX REPLACE "<PointData.*</PointData>" "<CellData Scalars=\"paint\">${id}${paint}</CellData>" text "${text}")
    string(REPLACE "-1 -1 0 1 -1 0 1 1 0 -1 1 0" "2 -1 0 4 -1 0 4 1 0 2 1 0" text "${text}")
  endif ()
  file(WRITE "${DIRECTORY}/${name}.vtp" "${text}")
endforeach ()
cslf_warn(1 "without these arrays: beside, paint[.]" sample id.vtp beside.vtp -o kept.vti -M 2 -N 16
  --quality preview --colors exact --arrays all)
cslf_run(info kept.vti)
if (NOT output MATCHES "id, [0-9]+ points from 1234567890123 to 1234567890124\n")
  message(FATAL_ERROR "The range of large numbers is not listed: ${output}")
endif ()
cslf_run(info kept.vti --json)
expect_json_at_least(0.49 geometry recolorable)
string(JSON share GET "${output}" geometry recolorable)
if (share GREATER 0.51)
  message(FATAL_ERROR "${share} of two squares can be recoloured, of which one can.")
endif ()

# Without array, surfaces are white.
file(WRITE "${DIRECTORY}/plain.obj" "v -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\nf 1 2 3\nf 1 3 4\n")
cslf_run(render square.vti -o shown.png ${view} --color-by none)
cslf_run(trace plain.obj -o traced.png ${view} --spp 16 --colors exact --base-color 1 1 1)
expect_psnr(40 shown.png traced.png)

# The scalar bar covers the right side, and nothing else. The viewer's key toggles it.
set(view --size 200 200 --position 0 0 8 --color-map plasma)
cslf_run(render square.vti -o bare.png ${view})
cslf_run(render square.vti -o bar.png ${view} --scalar-bar)
cslf_run(compare bare.png bar.png --json)
string(JSON psnr GET "${output}" psnr)
if (psnr GREATER 25)
  message(FATAL_ERROR "There is no scalar bar: ${psnr} dB")
endif ()
cslf_run(view square.vti --screenshot keys.png ${view} --keys bi)
cslf_run(view square.vti --screenshot flag.png ${view} --scalar-bar --keys i)
cslf_run(view square.vti --screenshot off.png ${view} --scalar-bar --keys ib)
expect_psnr(60 keys.png flag.png)
cslf_run(compare keys.png off.png --json)
string(JSON psnr GET "${output}" psnr)
if (psnr GREATER 25)
  message(FATAL_ERROR "The key b does not toggle the scalar bar: ${psnr} dB")
endif ()

# What does not fit.
cslf_fail("no array speed to colour by: the field has place:0" "y"
  render square.vti -o y.png --color-by speed)
cslf_fail("no array place:y" "y" render square.vti -o y.png --color-by place:y)
cslf_fail("no array speed" "y" view square.vti --screenshot y.png --color-by speed)
cslf_fail("--range must be smaller" "y" render square.vti -o y.png --range 2 1)
cslf_fail("--color-map" "y" render square.vti -o y.png --color-map jet)
cslf_fail("needs an array" "y" render square.vti -o y.png --color-by none --scalar-bar)
cslf_fail("by the lookup geometry, not by depth" "y"
  render square.vti -o y.png --color-map gray --lookup depth)
cslf_run(sample plain.obj -o plain.vti -M 2 -N 16 --quality preview)
foreach (option IN ITEMS "--scalar-bar" "--color-map;gray" "--color-by;place")
  cslf_fail("field has no scalars" "y" render plain.vti -o y.png ${option})
endforeach ()
cslf_run(info plain.vti --json)
string(JSON count LENGTH "${output}" scalars)
if (NOT count EQUAL 0)
  message(FATAL_ERROR "A field without colour map has scalars: ${output}")
endif ()
# A scene beside the field takes the options.
cslf_run(view plain.vti square.vtp --screenshot scene.png --color-by place:y --keys t
  --truth-samples 4)
