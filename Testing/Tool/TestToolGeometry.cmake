# SPDX-FileCopyrightText: Copyright (c) CSLF contributors
# SPDX-License-Identifier: BSD-3-Clause

# A field's geometry: beside image data, as a part of a video, and on the way from one to the other.
include("${CMAKE_CURRENT_LIST_DIR}/cslfToolTesting.cmake")

function (expect_file name exists)
  if (EXISTS "${DIRECTORY}/${name}")
    set(found ON)
  else ()
    set(found OFF)
  endif ()
  if (NOT found STREQUAL exists)
    message(FATAL_ERROR "${name} exists: ${found}, expected ${exists}.")
  endif ()
endfunction ()

# Runs the tool, which must succeed, and print messages that match a pattern.
function (cslf_warn pattern)
  execute_process(
    COMMAND "${CSLF}" ${ARGN}
    WORKING_DIRECTORY "${DIRECTORY}"
    RESULT_VARIABLE result
    OUTPUT_VARIABLE output
    ERROR_VARIABLE error)
  if (NOT result STREQUAL "0" OR NOT error MATCHES "${pattern}")
    message(FATAL_ERROR "cslf ${ARGN}\nended with ${result}: ${error}")
  endif ()
  set(output "${output}" PARENT_SCOPE)
endfunction ()

set(field -M 3 -N 48 --spp 4 --max-depth 2 --integrator path)
set(novel --views 1 --size 96 --spp 64 --max-depth 2)
cslf_run(sample cornell-box ${field} -o box.vti)
expect_file(box.geometry.vtp ON)
cslf_run(info box.vti)
if (NOT output MATCHES "geometry +[0-9]+ triangles, error [0-9.e-]+, loss [0-9.e-]+ %\n")
  message(FATAL_ERROR "cslf info box.vti: ${output}")
endif ()
cslf_run(info box.vti --json)
expect_json_at_least(100 geometry triangles)
expect_json_at_least(0 geometry error)
expect_json_at_least(0 geometry loss)
string(JSON triangles GET "${output}" geometry triangles)
cslf_warn("" evaluate box.vti cornell-box ${novel} --lookups depth,geometry --json)
expect_json_at_least(20 lookups geometry psnr)
string(JSON by_depth GET "${output}" lookups depth psnr)
string(JSON by_geometry GET "${output}" lookups geometry psnr)
if (by_geometry LESS by_depth)
  message(FATAL_ERROR "The geometry lookup has ${by_geometry} dB, the depth lookup ${by_depth}.")
endif ()

# To a video and back.
cslf_run(encode box.vti -o box.mp4 --crf 12 --preset ultrafast)
cslf_run(info box.mp4 --json)
expect_json(geometry parts 0 name)
expect_json(model/vnd.cslf.geometry parts 0 type)
expect_json(${triangles} geometry triangles)
expect_json_at_least(0 geometry loss)
cslf_warn("" evaluate box.mp4 cornell-box ${novel} --lookups geometry --json)
expect_json_at_least(20 lookups geometry psnr)
cslf_run(resample box.mp4 -o small.mp4 --resolution-divisor 2 --preset ultrafast)
cslf_run(info small.mp4 --json)
expect_json(geometry parts 0 name)
cslf_run(decode small.mp4 -o small.vti)
expect_file(small.geometry.vtp ON)
cslf_run(render small.vti -o small.png --size 64 64 --json)
expect_json(geometry lookup)

# Without geometry.
cslf_run(sample cornell-box ${field} -o plain.vti --geometry-triangles 0)
expect_file(plain.geometry.vtp OFF)
cslf_run(info plain.vti --json)
string(JSON type TYPE "${output}" geometry)
if (NOT type STREQUAL "NULL")
  message(FATAL_ERROR "cslf info plain.vti: ${output}")
endif ()
cslf_run(render plain.vti -o plain.png --size 64 64 --json)
expect_json(depth lookup)
cslf_fail("The geometry lookup needs geometry, which the field does not have" ""
  evaluate plain.vti cornell-box ${novel} --lookups geometry)
cslf_run(sample cornell-box ${field} -o folder)
cslf_run(info folder)

# Geometry from depth.
cslf_run(resample plain.vti -o made.vti --geometry-triangles 50000)
expect_file(made.geometry.vtp ON)
cslf_run(render made.vti -o made.png --size 64 64 --json)
expect_json(geometry lookup)
cslf_warn("" evaluate made.vti cornell-box ${novel} --lookups depth,geometry --json)
string(JSON by_depth GET "${output}" lookups depth psnr)
string(JSON by_geometry GET "${output}" lookups geometry psnr)
if (by_geometry LESS by_depth)
  message(FATAL_ERROR "Geometry from depth has ${by_geometry} dB, the depth lookup ${by_depth}.")
endif ()
cslf_run(sample cornell-box ${field} -o flat.vti --geometry-triangles 0 --no-depth)
cslf_fail("flat.vti has no depth, which --geometry-triangles needs" "flat.mp4"
  encode flat.vti -o flat.mp4 --geometry-triangles 5000)
cslf_fail("A folder has no place for the geometry" "nowhere"
  resample plain.vti -o nowhere --geometry-triangles 5000)
cslf_run(encode folder -o made.mp4 --preset ultrafast --geometry-triangles 5000)
cslf_run(info made.mp4 --json)
expect_json(geometry parts 0 name)
cslf_fail("Nothing would change" "still" resample plain.vti -o still.vti)
cslf_run(resample plain.vti -o still.vti --resolution-divisor 2)
expect_file(still.geometry.vtp OFF)
cslf_run(encode flat.vti -o small.mp4 --crf 51)
cslf_warn("larger.mp4 is coarser than small.mp4, but larger"
  resample small.mp4 -o larger.mp4 --viewpoint-stride 2 --crf 0)

# It may be read by those only who may read the field.
if (CMAKE_HOST_SYSTEM_NAME STREQUAL "Linux")
  file(WRITE "${DIRECTORY}/private.vti" "")
  file(CHMOD "${DIRECTORY}/private.vti" PERMISSIONS OWNER_READ OWNER_WRITE)
  cslf_run(sample cornell-box -M 2 -N 16 --spp 1 --max-depth 1 --integrator path -o private.vti)
  execute_process(
    COMMAND stat -c %a private.vti private.geometry.vtp
    WORKING_DIRECTORY "${DIRECTORY}"
    OUTPUT_VARIABLE modes)
  if (NOT modes STREQUAL "600\n600\n")
    message(FATAL_ERROR "The modes of a private field and of its geometry are ${modes}.")
  endif ()
endif ()

# Geometry of another scene is not used.
file(COPY_FILE "${DIRECTORY}/box.geometry.vtp" "${DIRECTORY}/pipes.geometry.vtp")
cslf_warn("" sample pipes -M 2 -N 16 --spp 1 --max-depth 1 --integrator path -o pipes.vti
  --geometry-triangles 0)
cslf_warn("ignored: pipes.geometry.vtp belongs to another light field" info pipes.vti)

# A damaged file, cut short or garbage, is not used either, with one warning.
set(ignored "^cslf: warning: The geometry was ignored: [^\n]*box.geometry.vtp[^\n]*\n$")
set(whole "${DIRECTORY}/whole.geometry.vtp")
file(RENAME "${DIRECTORY}/box.geometry.vtp" "${whole}")
file(SIZE "${whole}" bytes)
foreach (percent IN ITEMS 0 50 99)
  math(EXPR kept "${bytes} * ${percent} / 100")
  execute_process(
    COMMAND head -c ${kept} "${whole}"
    OUTPUT_FILE "${DIRECTORY}/box.geometry.vtp")
  cslf_warn("${ignored}" info box.vti --json)
endforeach ()
foreach (text IN ITEMS "no geometry\n" "<VTKFile type=\"PolyData\">")
  file(WRITE "${DIRECTORY}/box.geometry.vtp" "${text}")
  cslf_warn("${ignored}" info box.vti --json)
endforeach ()
# All commands have the same rule.
cslf_warn("${ignored}" render box.vti -o box.png --size 64 64 --json)
expect_json(depth lookup)
cslf_warn("${ignored}" evaluate box.vti cornell-box ${novel} --json)
string(JSON lookup ERROR_VARIABLE missing GET "${output}" lookups geometry)
if (NOT missing)
  message(FATAL_ERROR "A damaged geometry was measured: ${output}")
endif ()
set(refused "needs geometry, which the field does not have: [^\n]*box.geometry.vtp")
cslf_fail("${refused}" "named" render box.vti -o named.png --lookup geometry)
cslf_fail("${refused}" "" evaluate box.vti cornell-box ${novel} --lookups geometry)
cslf_fail("needs geometry, which the field does not have\\." "named"
  render flat.vti -o named.png --lookup geometry)
