# SPDX-FileCopyrightText: Copyright (c) CSLF contributors
# SPDX-License-Identifier: BSD-3-Clause

# Scenes with several times: collections, file series and files with time values become a light field
# for each time, with one cube and one range of colours. Killed runs are resumed. Commands show the
# time that is asked for.
include("${CMAKE_CURRENT_LIST_DIR}/cslfToolTesting.cmake")

# A square at the height of its number, of two triangles, or of one if that is odd. Its scalars are
# the number at two corners, and one more at the others.
set(times 0 0.5 2)
set(entries)
set(data_sets)
foreach (step RANGE 2)
  math(EXPR more "${step} + 1")
  math(EXPR odd "${step} % 2")
  set(triangles "0 1 2 1 3 2")
  set(offsets "3 6")
  set(count 2)
  if (odd)
    set(triangles "0 1 2")
    set(offsets "3")
    set(count 1)
  endif ()
  file(WRITE "${DIRECTORY}/square-${step}.vtp" "<VTKFile type=\"PolyData\" version=\"0.1\" byte_order=\"LittleEndian\">
<PolyData><Piece NumberOfPoints=\"4\" NumberOfPolys=\"${count}\"><PointData Scalars=\"Heat\">
<DataArray type=\"Float64\" Name=\"Heat\" format=\"ascii\">${step} ${more} ${step} ${more}</DataArray></PointData>
<Points><DataArray type=\"Float64\" NumberOfComponents=\"3\" format=\"ascii\">0 0 ${step} 1 0 ${step} 0 1 ${step} 1 1 ${step}</DataArray></Points>
<Polys><DataArray type=\"Int64\" Name=\"connectivity\" format=\"ascii\">${triangles}</DataArray>
<DataArray type=\"Int64\" Name=\"offsets\" format=\"ascii\">${offsets}</DataArray></Polys>
</Piece></PolyData></VTKFile>\n")
  list(GET times ${step} time)
  list(APPEND entries "{\"name\": \"square-${step}.vtp\", \"time\": ${time}}")
  string(APPEND data_sets "<DataSet timestep=\"${time}\" file=\"square-${step}.vtp\"/>")
endforeach ()
list(JOIN entries ", " entries)
file(WRITE "${DIRECTORY}/square.vtp.series"
  "{\"file-series-version\": \"1.0\", \"files\": [${entries}]}\n")
file(WRITE "${DIRECTORY}/square.pvd" "<VTKFile type=\"Collection\" version=\"0.1\"><Collection>${data_sets}</Collection></VTKFile>\n")

# Checks that files have the same bytes.
function (expect_same one other)
  file(SHA256 "${DIRECTORY}/${one}" wanted)
  file(SHA256 "${DIRECTORY}/${other}" actual)
  if (NOT actual STREQUAL wanted)
    message(FATAL_ERROR "${other} has other bytes than ${one}.")
  endif ()
endfunction ()

set(settings -M 2 -N 16 --quality preview)
if (NOT HAS_ENCODER)
  cslf_fail("without the video encoder" "x" sample square.pvd ${settings} -o x.mp4)
  return ()
endif ()
cslf_run(sample square.vtp.series ${settings} -o a.mp4 --json)
expect_json(a.mp4.series output)
expect_json(0 kept_steps)
expect_json(0.5 steps 1 time)
expect_json(a_0001.mp4 steps 1 file)
# One cube around all steps, and one range of colours.
expect_json(1.0 center 2)
expect_json(2.2000000000000002 edge)
expect_json(0.0 legend 0 range 0)
expect_json(3.0 legend 0 range 1)
file(READ "${DIRECTORY}/a.mp4.series" index)
string(JSON version GET "${index}" file-series-version)
string(JSON name GET "${index}" files 2 name)
string(JSON time GET "${index}" files 2 time)
if (NOT version STREQUAL "1.0" OR NOT name STREQUAL "a_0002.mp4" OR NOT time EQUAL 2)
  message(FATAL_ERROR "The index is ${index}")
endif ()
foreach (step RANGE 2)
  cslf_run(info a_000${step}.mp4 --json)
  expect_json(2.2000000000000002 edge)
  expect_json(0.0 scalars 0 map_range 0)
  expect_json(3.0 scalars 0 map_range 1)
endforeach ()

# The last time that is not later.
foreach (pair IN ITEMS "-1 0" "0.5 1" "1.99 1" "2 2" "7 2")
  separate_arguments(pair)
  list(GET pair 0 time)
  list(GET pair 1 step)
  cslf_run(info a_000${step}.mp4 --json)
  string(JSON scene GET "${output}" sampling scene)
  cslf_run(info a.mp4.series --time=${time} --json)
  expect_json("${scene}" sampling scene)
  expect_json(2.0 steps 2 time)
endforeach ()
cslf_run(info a.mp4.series)
if (NOT output MATCHES "times +0.0 0.5 2.0\n")
  message(FATAL_ERROR "${output}")
endif ()

# A collection has the same steps. What is finished is kept; with other settings, nothing is.
cslf_run(sample square.pvd ${settings} -o b.mp4 --json)
foreach (step RANGE 2)
  expect_same(a_000${step}.mp4 b_000${step}.mp4)
endforeach ()
cslf_run(sample square.pvd ${settings} -o b.mp4 --json)
expect_json(3 kept_steps)
cslf_run(sample square.pvd ${settings} -o b.mp4 --json --time-step-range 0 2 --time-step-interval 2 --seed 1)
expect_json(0 kept_steps)
expect_json(b_0002.mp4 steps 1 file)
string(JSON count LENGTH "${output}" steps)
if (NOT count EQUAL 2)
  message(FATAL_ERROR "${output}")
endif ()

# Killed in the second step.
execute_process(
  COMMAND bash -c "
    for attempt in 1 2 3 4 5 6 7 8; do
      rm -rf c.mp4* c_*
      '${CSLF}' \"$@\" -o c.mp4 > log.txt 2>&1 &
      while kill -0 $! && ! [ -e c_0000.mp4 ]; do sleep 0.002; done
      kill -KILL $!
      wait $!
      if [ -e c_0000.mp4 ] && ! [ -e c_0002.mp4 ]; then exit 0; fi
    done
    exit 1" bash sample square.pvd ${settings} --spp 64
  WORKING_DIRECTORY "${DIRECTORY}"
  RESULT_VARIABLE result
  ERROR_QUIET)
if (NOT result STREQUAL "0" OR EXISTS "${DIRECTORY}/c.mp4.series")
  message(FATAL_ERROR "The run was not killed in the middle of its work.")
endif ()
cslf_run(sample square.pvd ${settings} --spp 64 -o c.mp4)
cslf_run(sample square.pvd ${settings} --spp 64 -o d.mp4)
foreach (step RANGE 2)
  expect_same(d_000${step}.mp4 c_000${step}.mp4)
endforeach ()
file(READ "${DIRECTORY}/d.mp4.series" wanted)
file(READ "${DIRECTORY}/c.mp4.series" actual)
string(REPLACE "c_000" "d_000" actual "${actual}")
if (NOT actual STREQUAL wanted OR EXISTS "${DIRECTORY}/c.mp4.series.partial")
  message(FATAL_ERROR "The resumed run left ${actual}")
endif ()

# One time as one file, and pictures of a time.
cslf_run(sample square.pvd ${settings} --time 1 -o e.mp4 --json)
expect_json(1.0 center 2)
expect_json(e.mp4 output)
set(view --size 32 32 --position 3 2 6)
cslf_run(render a.mp4.series --time 1 ${view} -o series.png)
cslf_run(render a_0001.mp4 ${view} -o single.png)
expect_same(single.png series.png)
cslf_run(view a.mp4.series --time 0.5 --keys . --screenshot next.png --json)
expect_json(2.0 time)
cslf_run(trace square.vtp.series --time 2 ${view} --spp 1 -o traced.png)

# Default names.
cslf_run(sample square.vtp.series ${settings})
if (NOT EXISTS "${DIRECTORY}/square.mp4.series" OR NOT EXISTS "${DIRECTORY}/square_0002.mp4")
  message(FATAL_ERROR "The files do not have their default names.")
endif ()
cslf_fail("square.mp4.series.*exists" "" sample square.vtp.series ${settings} --picture p.png)

cslf_fail("needs a video as output" "x" sample square.pvd ${settings} -o x.vti)
cslf_fail("no such time steps: the input has 3" "x" sample square.pvd ${settings} -o x.mp4 --time-step-range 3 9)
cslf_fail("no time steps that --time-step-range" "x" sample square-0.vtp ${settings} -o x.mp4 --time-step-range 0 1)
cslf_fail("has no times" "" info a_0000.mp4 --time 1)
file(WRITE "${DIRECTORY}/bad.vtp.series" "{\"files\": 3}")
cslf_fail("Cannot read bad.vtp.series: it is not the index" "x" sample bad.vtp.series -o x.mp4)
file(WRITE "${DIRECTORY}/lost.vtp.series" "{\"files\": [{\"name\": \"square-0.vtp\"}, {\"name\": \"lost.vtp\"}]}")
cslf_fail("there is no file lost.vtp" "x" sample lost.vtp.series ${settings} -o x.mp4)
file(WRITE "${DIRECTORY}/lost.mp4.series" "{\"files\": [{\"name\": \"lost.mp4\"}]}")
cslf_fail("Cannot read lost.mp4" "" info lost.mp4.series)
