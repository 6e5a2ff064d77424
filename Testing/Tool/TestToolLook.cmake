# SPDX-FileCopyrightText: Copyright (c) CSLF contributors
# SPDX-License-Identifier: BSD-3-Clause

# How files without a look of their own look: the first picture, colours, light and view.
include("${CMAKE_CURRENT_LIST_DIR}/cslfToolTesting.cmake")

# A square of one value, a vector and the values of two cells.
function (write_square name scalars)
  file(WRITE "${DIRECTORY}/${name}.vtp" "<VTKFile type=\"PolyData\" version=\"0.1\">
<PolyData><Piece NumberOfPoints=\"4\" NumberOfPolys=\"2\">
<Points><DataArray type=\"Float32\" NumberOfComponents=\"3\" format=\"ascii\">
-1 -1 0 1 -1 0 1 1 0 -1 1 0</DataArray></Points>
<PointData ${scalars}>
<DataArray type=\"Float32\" Name=\"same\" format=\"ascii\">7 7 7 7</DataArray>
<DataArray type=\"Float32\" Name=\"where\" NumberOfComponents=\"3\" format=\"ascii\">
-1 -1 0 1 -1 0 2 2 0 -1 1 0</DataArray></PointData>
<CellData>
<DataArray type=\"Float32\" Name=\"of:cells\" format=\"ascii\">0 1</DataArray></CellData>
<Polys><DataArray type=\"Int64\" Name=\"connectivity\" format=\"ascii\">0 1 2 0 2 3</DataArray>
<DataArray type=\"Int64\" Name=\"offsets\" format=\"ascii\">3 6</DataArray></Polys>
</Piece></PolyData></VTKFile>
")
endfunction ()
write_square(square "Scalars=\"same\"")
write_square(vector "Scalars=\"where\"")
set(view --size 32 32 --position 0 0 5 --spp 4 --max-depth 1)
function (expect_same a b)
  cslf_run(compare ${a} ${b} --json)
  expect_json_at_least(50 psnr)
endfunction ()

# An array of one value does not colour, unless it is named. Exact colours are those of the map.
file(WRITE "${DIRECTORY}/plain.obj" "v -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\nf 1 2 3\nf 1 3 4\n")
cslf_run(trace plain.obj -o plain.png ${view})
cslf_run(trace square.vtp -o square.png ${view})
cslf_run(compare square.png plain.png --json)
expect_json_at_least(30 psnr)
foreach (case IN ITEMS "0 14 0.5 0.5 0.5" "7 8 0 0 0" "-1 7 1 1 1")
  string(REPLACE " " ";" case "${case}")
  list(POP_FRONT case low high)
  cslf_run(trace square.vtp -o mapped.png ${view} --colors exact --color-by same --color-map gray
    --range ${low} ${high})
  cslf_run(trace plain.obj -o plain.png ${view} --colors exact --base-color ${case})
  expect_same(mapped.png plain.png)
endforeach ()

# A name may contain a colon. The legend says what is shown.
set(tiny -M 2 -N 2 --spp 1 --integrator path --geometry-triangles 0 --json)
cslf_run(sample square.vtp -o x.vti ${tiny} --color-by of:cells)
expect_json("of:cells" legend 0 array)
expect_json(1.0 legend 0 range 1)
expect_json("cool-to-warm" legend 0 map)
cslf_run(sample vector.vtp -o x.vti ${tiny})
expect_json("magnitude" legend 0 component)
foreach (component IN ITEMS x 0)
  cslf_run(sample square.vtp -o x.vti ${tiny} --color-by where:${component} --color-map viridis)
  expect_json(-1.0 legend 0 range 0)
  expect_json(viridis legend 0 map)
endforeach ()
cslf_run(sample vector.vtp -o x.vti ${tiny} --color-by none)
string(JSON rows LENGTH "${output}" legend)
if (NOT rows EQUAL 0)
  message(FATAL_ERROR "No array is named, but there is a legend: ${output}")
endif ()
set(arrays "of points: same, where \\(3 components\\); of cells: of:cells")
cslf_fail("no array velocity.*${arrays}" "y" sample square.vtp -o y.vti ${tiny} --color-by velocity)
cslf_fail("has no component 3.*0 to 2" "y" sample square.vtp -o y.vti ${tiny} --color-by where:3)
cslf_fail("has no component y.*only one" "y" sample square.vtp -o y.vti ${tiny} --color-by same:y)
cslf_fail("the scene has no arrays" "y" sample plain.obj -o y.vti ${tiny} --color-by same)
cslf_fail("--range" "y" sample square.vtp -o y.vti ${tiny} --range 2 1)
cslf_fail("--color-map" "y" sample square.vtp -o y.vti ${tiny} --color-map jet)
cslf_fail("--light" "y" sample square.vtp -o y.vti ${tiny} --light disco)
cslf_fail("--environment" "y" sample square.vtp -o y.vti ${tiny} --light sun --environment white)

# Light and view follow the axis that is up: a square in the plane of x and y lies on the ground.
file(WRITE "${DIRECTORY}/upright.obj" "v -1 0 1\nv 1 0 1\nv 1 0 -1\nv -1 0 -1\nf 1 2 3\nf 1 3 4\n")
set(view --size 32 32 --spp 16 --max-depth 1)
foreach (light IN ITEMS studio sun)
  cslf_run(trace upright.obj -o upright.png ${view} --light ${light} --position 0 5 0.1)
  cslf_run(trace plain.obj -o turned.png ${view} --light ${light} --up z --position 0 -0.1 5)
  cslf_run(compare upright.png turned.png --json)
  expect_json_at_least(30 psnr)
endforeach ()

# Without a name, the field and a picture get that of the scene. What is there is kept.
cslf_run(sample square.vtp -o x.vti ${tiny} --picture named.png)
cslf_run(compare named.png named.png)
if (HAS_ENCODER)
  set(small -M 2 -N 16 --spp 1 --max-depth 1)
  file(WRITE "${DIRECTORY}/plain.png" "mine")
  cslf_fail("plain.png exists.*--overwrite" "plain.mp4" sample plain.obj ${small})
  cslf_run(sample plain.obj ${small} --picture other.png)
  cslf_fail("plain.mp4 exists.*--overwrite" "" sample plain.obj ${small} --picture other.png)
  file(READ "${DIRECTORY}/plain.png" text)
  if (NOT text STREQUAL "mine")
    message(FATAL_ERROR "plain.png was replaced.")
  endif ()
  file(REMOVE "${DIRECTORY}/plain.mp4")
  cslf_run(sample plain.obj ${small} --overwrite)
  # A picture that an interrupted run has left may be replaced.
  file(REMOVE "${DIRECTORY}/plain.mp4")
  cslf_run(sample plain.obj ${small})
  cslf_run(info plain.mp4)
  cslf_run(compare plain.png plain.png)
endif ()
