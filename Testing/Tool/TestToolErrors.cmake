# SPDX-FileCopyrightText: Copyright (c) CSLF contributors
# SPDX-License-Identifier: BSD-3-Clause

# For any error, the tool prints one line and leaves nothing half done.
include("${CMAKE_CURRENT_LIST_DIR}/cslfToolTesting.cmake")

set(tiny -M 2 -N 16 --spp 1 --max-depth 1)
file(WRITE "${DIRECTORY}/text.txt" "no light field\n")
file(WRITE "${DIRECTORY}/text.mp4" "no video\n")
file(WRITE "${DIRECTORY}/text.png" "no picture\n")
file(WRITE "${DIRECTORY}/text.vti" "no image data\n")
file(WRITE "${DIRECTORY}/text.ply" "no mesh\n")
file(MAKE_DIRECTORY "${DIRECTORY}/other")
file(WRITE "${DIRECTORY}/other/letter.txt" "Dear reader\n")

# The command line.
cslf_fail("no command dance; see cslf --help" "" dance)
cslf_fail("no option --dance; see cslf --help" "" --dance)
cslf_fail("--output" "" encode text.vti)
cslf_fail("--viewpoints" "x" sample cornell-box -o x.vti -M 1)
cslf_fail("--spp" "x" sample cornell-box -o x.vti --spp many)
cslf_fail("--lookup" "x" render text.vti -o x.png --lookup psychic)
cslf_fail("center" "x" sample cornell-box -o x.vti --edges 3)

# Inputs.
cslf_fail("no file nowhere.ply" "x" sample nowhere.ply -o x.mp4 ${tiny})
cslf_fail("not a scene" "x" sample text.txt -o x.mp4 ${tiny})
cslf_fail("text.ply" "x" sample text.ply -o x.mp4 ${tiny})
cslf_fail("environment" "x" sample cornell-box -o x.mp4 ${tiny} --environment nowhere.hdr)
cslf_fail("text.txt" "x" sample cornell-box -o x.mp4 ${tiny} --environment text.txt)
cslf_fail("nowhere.mp4" "x" decode nowhere.mp4 -o x)
cslf_fail("text.mp4" "x" decode text.mp4 -o x)
cslf_fail("no file nowhere.ply" "x" export nowhere.ply -o x.obj)
cslf_fail("text.vti|XML|parse" "x" encode text.vti -o x.mp4)
cslf_fail("not a light field" "" info text.txt)
cslf_fail("other" "" info other)
cslf_fail("not PNG" "" compare text.png text.png)
cslf_fail("no file" "" compare nowhere.png text.png)
# A picture of one pixel whose checksums are right, but not its data.
execute_process(
  COMMAND sh -c "printf 'iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAIAAACQd1PeAAAAB0lEQVRubyBkYXRhJgtSaAAAAABJRU5ErkJggg==' | base64 -d"
  OUTPUT_FILE "${DIRECTORY}/broken.png")
cslf_fail("broken.png cannot be decoded" "" compare broken.png broken.png)
# More strings than are announced, which VTK would write beyond the array's end.
string(REPEAT "65 0 " 1000 strings)
file(WRITE "${DIRECTORY}/strings.vti" "<VTKFile type=\"ImageData\" version=\"0.1\"
byte_order=\"LittleEndian\"><ImageData WholeExtent=\"0 4 0 0 0 23\"><FieldData>
<Array type=\"String\" Name=\"CSLF\" NumberOfTuples=\"1\" format=\"ascii\">${strings}</Array>
</FieldData><Piece Extent=\"0 4 0 0 0 23\"/></ImageData></VTKFile>
")
cslf_fail("strings.vti declares fewer strings" "" info strings.vti)
# An array in one block: the number of blocks, their size, the size of the last, and its compressed
# size.
function (cslf_test_block header data message)
  file(WRITE "${DIRECTORY}/block.vti" "<VTKFile type=\"ImageData\" version=\"0.1\"
byte_order=\"LittleEndian\" compressor=\"vtkZLibDataCompressor\"><ImageData
WholeExtent=\"0 4 0 0 0 23\"><FieldData><DataArray type=\"UInt8\" Name=\"Zeros\"
NumberOfTuples=\"480\" format=\"binary\">${header}${data}</DataArray></FieldData>
<Piece Extent=\"0 4 0 0 0 23\"/></ImageData></VTKFile>
")
  cslf_fail("${message}" "" info block.vti)
endfunction ()
set(block eJxjYBgFwxkAAAHgAAE=)
set(too_much "block.vti declares an array of too many blocks or bytes")
cslf_test_block(AQAAAACAAADgAQAADgAAAA== ${block} "not a light field")  # 1, 32768, 480, 14
cslf_test_block(AQAAAACAAADgAQAAAMCzpQ== ${block} "${too_much}")     # 1, 32768, 480, 2780020736
cslf_test_block(AQAAAACAAADgAQAAkAEAAA== ${block} "${too_much}")     # 1, 32768, 480, 400
cslf_test_block(AQAAAACAAADgAQAAAAAAAA== ${block} "${too_much}")     # 1, 32768, 480, 0
cslf_test_block(AQAAAAAAAADgAQAADgAAAA== ${block} "${too_much}")     # 1, 0, 480, 14
cslf_test_block(AQAAAGQAAADgAQAADgAAAA== ${block} "${too_much}")     # 1, 100, 480, 14

# Outputs.
cslf_fail("Cannot write nowhere/x.mp4" "x" sample cornell-box -o nowhere/x.mp4 ${tiny})
cslf_fail("Cannot write nowhere/x.vti" "x" sample cornell-box -o nowhere/x.vti ${tiny})
cslf_fail("cannot make the folder nowhere" "x" sample cornell-box -o nowhere/x ${tiny})
cslf_fail("/proc/x.mp4 was not written" "x" sample cornell-box -o /proc/x.mp4 ${tiny})
cslf_fail("Cannot write" "x" trace cornell-box -o nowhere/x.png --size 8 8 --spp 1)
cslf_fail("Cannot write nowhere/x.obj" "x" export cornell-box -o nowhere/x.obj)
cslf_fail("as .png" "x" trace cornell-box -o x.bmp --size 8 8 --spp 1)
cslf_fail("pink is no colour" "x" trace cornell-box -o x.png --background shockingpink)
cslf_fail("as .png" "x" render text.vti -o x.vti)
cslf_fail("along a --path to a folder, .*webm" "x" render text.vti -o x.webm)
cslf_run(export cornell-box -o own.obj)
configure_file("${DIRECTORY}/own.obj" "${DIRECTORY}/own.png" COPYONLY)
configure_file("${DIRECTORY}/own.obj" "${DIRECTORY}/own.vti" COPYONLY)
cslf_fail("are the same" "" trace own.png -o own.png --size 8 8 --spp 1)
cslf_fail("are the same" "" sample own.vti -o own.vti ${tiny})
cslf_fail("are the same" "x" trace own.obj -o own.png --size 8 8 --spp 1 --environment own.png)
cslf_fail("are the same" "" encode text.vti -o text.mp4 --part a=b/c:text.mp4)
cslf_fail("as .obj" "x" export cornell-box -o x.ply)
cslf_fail("cornell-box is a scene" "x" export cornell-box -o x.html)
cslf_fail("--title is for light fields" "x" export cornell-box -o x.obj --title Box)
cslf_fail("--range is for light fields" "x" export cornell-box -o x.obj --range 0 1)
cslf_fail("--compact is for glTF" "x" export "${DATA}/field.mp4" -o x.html --compact)
cslf_fail("One light field" "x" export "${DATA}/field.mp4" "${DATA}/field.mp4" -o x.html)
cslf_fail("has no geometry" "x" export "${DATA}/field.mp4" -o x.html)
cslf_fail("has no scalars" "x" export "${DATA}/field.mp4" -o x.html --color-map gray)
cslf_fail("no file or folder nowhere.mp4" "x" export nowhere.mp4 -o x.html)
cslf_fail("formats" "x" sample cornell-box -o x.avi ${tiny})
cslf_fail("other files" "" sample cornell-box -o other ${tiny})
cslf_fail("at least 16" "x" sample cornell-box -o x.mp4 -M 2 -N 15 --spp 1)
cslf_fail("without loss" "x" sample cornell-box -o x.mp4 ${tiny} --float --lossless)

# NaN, which is in no range.
foreach (option IN ITEMS exposure noise offset roughness crf environment-intensity)
  cslf_fail("${option}: Value nan is" "x" sample cornell-box -o x.mp4 ${tiny} --${option} nan)
endforeach ()
cslf_fail("Value inf is not a finite number" "x" sample cornell-box -o x.mp4 ${tiny} --exposure inf)
cslf_fail("Value -1 is not above 0\n" "x" sample cornell-box -o x.mp4 ${tiny} --exposure -1)

# Truncated image data.
cslf_run(sample cornell-box -o uncut.vti ${tiny})
file(SIZE "${DIRECTORY}/uncut.vti" bytes)
foreach (percent IN ITEMS 0 20 50 80 99)
  math(EXPR kept "${bytes} * ${percent} / 100")
  execute_process(
    COMMAND head -c ${kept} uncut.vti
    WORKING_DIRECTORY "${DIRECTORY}"
    OUTPUT_FILE short.vti)
  cslf_fail("short.vti" "x" decode short.vti -o x)
endforeach ()

# Meshes with nothing to show.
file(WRITE "${DIRECTORY}/empty.obj" "vn 0 0 1\n")
function (write_vtp name offset points)
  file(WRITE "${DIRECTORY}/${name}.vtp" "<VTKFile type=\"PolyData\" version=\"0.1\"
byte_order=\"LittleEndian\" header_type=\"UInt32\">
<PolyData><Piece NumberOfPoints=\"4\" NumberOfPolys=\"2\">
<Points><DataArray type=\"Float32\" NumberOfComponents=\"3\" format=\"binary\">
${points}</DataArray></Points>
<Polys><DataArray type=\"Int64\" Name=\"connectivity\" format=\"ascii\">
0 1 2 ${offset} 1 3</DataArray>
<DataArray type=\"Int64\" Name=\"offsets\" format=\"ascii\">3 6</DataArray></Polys>
</Piece></PolyData></VTKFile>
")
endfunction ()
# Three points of a triangle and one with NaN.
set(points "MAAAAA==AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAAAADAfwAAAAAAAAAA")
write_vtp(nan 0 ${points})
write_vtp(wild 99 ${points})
file(WRITE "${DIRECTORY}/line.obj" "v 0 0 0\nv 1 0 0\nl 1 2\n")
cslf_fail("no triangles" "x" export line.obj -o x.obj)
cslf_fail("" "x" sample empty.obj -o x.vti ${tiny})

# If there is a valid triangle, invalid ones give a warning.
execute_process(
  COMMAND "${CSLF}" sample nan.vtp -o nan.vti ${tiny}
  WORKING_DIRECTORY "${DIRECTORY}"
  RESULT_VARIABLE result
  ERROR_VARIABLE error)
if (NOT result STREQUAL "0" OR NOT error MATCHES "^cslf: warning: [^\n]+\n$")
  message(FATAL_ERROR "cslf sample nan.vtp ended with ${result}: ${error}")
endif ()
execute_process(
  COMMAND "${CSLF}" sample wild.vtp -o wild.vti ${tiny}
  WORKING_DIRECTORY "${DIRECTORY}"
  RESULT_VARIABLE result
  ERROR_VARIABLE error)
if (NOT result MATCHES "^[01]$" OR NOT error MATCHES "^cslf: [^\n]+\n$")
  message(FATAL_ERROR "cslf sample wild.vtp ended with ${result}: ${error}")
endif ()

# A triangle with these coordinates, and the range of its points, as VTK writes it.
function (write_text_vtp name a b range)
  file(WRITE "${DIRECTORY}/${name}.vtp" "<VTKFile type=\"PolyData\" version=\"0.1\"
byte_order=\"LittleEndian\" header_type=\"UInt32\">
<PolyData><Piece NumberOfPoints=\"3\" NumberOfPolys=\"1\">
<Points><DataArray type=\"Float64\" NumberOfComponents=\"3\" format=\"ascii\">
${a} ${a} ${a} ${b} ${a} ${a} ${a} ${b} ${a}
<InformationKey name=\"L2_NORM_RANGE\" location=\"vtkDataArray\" length=\"2\">
<Value index=\"0\">0</Value><Value index=\"1\">${range}</Value></InformationKey>
</DataArray></Points>
<Polys><DataArray type=\"Int64\" Name=\"connectivity\" format=\"ascii\">0 1 2</DataArray>
<DataArray type=\"Int64\" Name=\"offsets\" format=\"ascii\">3</DataArray></Polys>
</Piece></PolyData></VTKFile>
")
endfunction ()
# Sizes at which floats, or VTK's cameras, are out of their range.
foreach (size IN ITEMS 1e25 1e-25 1e16 1e-16)
  write_text_vtp(size 0 ${size} 1)
  cslf_fail("diagonal of the scene's bounding box is [0-9.]+e.* long.*scale the scene" "x"
    sample size.vtp -o x.vti ${tiny})
endforeach ()
foreach (size IN ITEMS 1e14 1e-14)
  write_text_vtp(size 0 ${size} 1)
  cslf_run(sample size.vtp -o size.vti --geometry-triangles 0 ${tiny})
endforeach ()

# A scene without anything visible gives a field, and a warning.
write_text_vtp(clear 0 1 1)
file(READ "${DIRECTORY}/clear.vtp" text)
string(REPLACE "<PolyData>" "<PolyData><FieldData><DataArray type=\"Float64\" Name=\"CSLF:Opacity\"
NumberOfTuples=\"1\" format=\"ascii\">0</DataArray></FieldData>" text "${text}")
file(WRITE "${DIRECTORY}/clear.vtp" "${text}")
execute_process(
  COMMAND "${CSLF}" sample clear.vtp -o clear.vti --geometry-triangles 0 ${tiny}
  WORKING_DIRECTORY "${DIRECTORY}"
  RESULT_VARIABLE result
  ERROR_VARIABLE error)
if (NOT result STREQUAL "0" OR
    NOT error MATCHES "^cslf: warning: Nothing of the scene is visible: [^\n]+\n$")
  message(FATAL_ERROR "cslf sample clear.vtp ended with ${result}: ${error}")
endif ()

# Without any finite coordinate, there is nothing to sample.
write_text_vtp(infinite 0 inf inf)
cslf_fail("infinite.vtp has an array with coordinates or other values that are not finite" "x"
  sample infinite.vtp -o x.vti ${tiny})
write_text_vtp(far 1e300 -1e300 1)
cslf_fail("Cannot read far.vtp: the coordinates of its points are not finite" "x"
  sample far.vtp -o x.vti ${tiny})

# Truncated meshes: an error, wherever the cut is.
file(WRITE "${DIRECTORY}/whole.obj" "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 3\nf 1 2 4")
file(WRITE "${DIRECTORY}/whole.ply" "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x
property float y\nproperty float z\nelement face 2\nproperty list uchar int vertex_indices\nend_header
0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 1 2\n3 0 1 3")
set(facet "facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\n")
file(WRITE "${DIRECTORY}/whole.stl" "solid a\n${facet}${facet}endsolid")
write_vtp(whole 0 "MAAAAA==AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAAAADAPwAAAAAAAAAA")
# A binary STL file: a header, the number of triangles, and each with its normal and corners.
string(REPEAT "h" 80 header)
set(zero "\\000\\000\\000\\000")
set(one "\\000\\000\\200\\077")
set(triangle "${zero}${zero}${one}${zero}${zero}${zero}${one}${zero}${zero}${zero}${one}${zero}")
string(REPEAT "${triangle}\\000\\000" 3 triangles)
execute_process(
  COMMAND sh -c "printf '${header}\\003\\000\\000\\000${triangles}'"
  WORKING_DIRECTORY "${DIRECTORY}"
  OUTPUT_FILE three.stl)
foreach (mesh IN ITEMS whole.obj whole.ply whole.stl whole.vtp three.stl)
  cslf_run(sample ${mesh} -o left.vti --geometry-triangles 0 ${tiny})
  file(SIZE "${DIRECTORY}/${mesh}" bytes)
  get_filename_component(extension ${mesh} EXT)
  foreach (lost IN ITEMS 2 3 17)
    math(EXPR kept "${bytes} - ${lost}")
    execute_process(
      COMMAND head -c ${kept} ${mesh}
      WORKING_DIRECTORY "${DIRECTORY}"
      OUTPUT_FILE cut${extension})
    cslf_fail("cut${extension}" "x" sample cut${extension} -o x.vti ${tiny})
  endforeach ()
endforeach ()

# Truncated videos: an error; with --allow-missing a warning and the remaining viewpoints, if any.
# Of fields whose geometry tells all, the first picture is all.
cslf_run(sample cornell-box -o whole.mp4 --integrator path ${tiny})
file(SIZE "${DIRECTORY}/whole.mp4" bytes)
foreach (percent IN ITEMS 10 50 90 99)
  math(EXPR kept "${bytes} * ${percent} / 100")
  execute_process(
    COMMAND head -c ${kept} whole.mp4
    WORKING_DIRECTORY "${DIRECTORY}"
    OUTPUT_FILE cut.mp4)
  execute_process(
    COMMAND "${CSLF}" decode cut.mp4 -o left --allow-missing
    WORKING_DIRECTORY "${DIRECTORY}"
    RESULT_VARIABLE result
    ERROR_VARIABLE error)
  if (result STREQUAL "0" AND error MATCHES "^cslf: warning: [^\n]+\n$")
    cslf_end(2 "cut.mp4 is damaged: [1-9].*--allow-missing" "x" decode cut.mp4 -o x.vti)
  elseif (result STREQUAL "1" AND error MATCHES "^cslf: error: [^\n]+\n$")
    cslf_fail("Cannot read cut.mp4" "x" decode cut.mp4 -o x)
  else ()
    message(FATAL_ERROR "Cut to ${percent} %, decoding ended with ${result}: ${error}")
  endif ()
  file(REMOVE_RECURSE "${DIRECTORY}/left")
endforeach ()

# All commands that write a result of a field have the same rule.
execute_process(
  COMMAND head -c ${kept} whole.mp4
  WORKING_DIRECTORY "${DIRECTORY}"
  OUTPUT_FILE cut.mp4)
cslf_run(decode whole.mp4 -o gap)
file(REMOVE "${DIRECTORY}/gap/000003.Depth.png")
foreach (damaged IN ITEMS cut.mp4 gap)
  cslf_end(2 "${damaged} is damaged" "x" decode ${damaged} -o x)
  cslf_end(2 "${damaged} is damaged" "x" encode ${damaged} -o x.mp4)
  cslf_end(2 "${damaged} is damaged" "x" resample ${damaged} -o x.vti --viewpoint-stride 2)
  cslf_end(2 "${damaged} is damaged" "" compare ${damaged} ${damaged})
  if (DEFINED ENV{DISPLAY})
    cslf_end(2 "${damaged} is damaged" "x" render ${damaged} -o x.png)
    cslf_end(2 "${damaged} is damaged" "x" evaluate ${damaged} cornell-box)
  endif ()
endforeach ()
cslf_run(info gap --json)
expect_json(1 missing)

# The rest of a damaged video is the same in every format, gives the same message, and can be
# compared.
set(told "^cslf: warning: cut.mp4 is damaged: [1-9][0-9]* of [0-9]+ viewpoints are missing [^\n]+\n$")
foreach (arguments IN ITEMS "decode cut.mp4 -o left.vti" "decode cut.mp4 -o left"
         "compare cut.mp4 left.vti" "compare left cut.mp4")
  separate_arguments(arguments)
  execute_process(
    COMMAND "${CSLF}" ${arguments} --allow-missing --json
    WORKING_DIRECTORY "${DIRECTORY}"
    RESULT_VARIABLE result
    OUTPUT_VARIABLE output
    ERROR_VARIABLE error)
  if (NOT result STREQUAL "0" OR NOT error MATCHES "${told}")
    message(FATAL_ERROR "cslf ${arguments} ended with ${result}: ${error}")
  endif ()
  if (DEFINED first AND NOT error STREQUAL first)
    message(FATAL_ERROR "cslf ${arguments} said ${error}, not ${first}")
  endif ()
  set(first "${error}")
endforeach ()
expect_json(ON channels Color equal)
# Image data lists its empty viewpoints.
cslf_end(2 "left.vti is damaged: [1-9][0-9]* of" "" compare left left.vti)
cslf_run(compare left left.vti --allow-missing --json)
expect_json(ON channels Color equal)
expect_json(ON channels Depth equal)
cslf_fail("same" "" encode whole.mp4 -o whole.mp4)
cslf_fail("encode writes" "x" encode whole.mp4 -o x.vti)
cslf_fail("differ" "x" render whole.mp4 -o x.png --position 1 2 3 --focal-point 1 2 3)

# Without a display, where VTK needs one: a server is started, or one line says what is missing. The
# server ends with the tool, also if that is killed.
execute_process(
  COMMAND "${CMAKE_COMMAND}" -E env --unset=DISPLAY PATH=/nowhere "${CSLF}" render whole.mp4 -o x.png
  WORKING_DIRECTORY "${DIRECTORY}"
  RESULT_VARIABLE result
  ERROR_VARIABLE error)
find_program(found_server Xvfb)
if (NOT result STREQUAL "0")
  if (NOT error MATCHES "^cslf: error: [^\n]*DISPLAY[^\n]*Xvfb[^\n]*\n$")
    message(FATAL_ERROR "Without a display, cslf render ended with ${result}: ${error}")
  endif ()
  execute_process(
    COMMAND "${CMAKE_COMMAND}" -E env --unset=DISPLAY "${CSLF}" view whole.mp4
    WORKING_DIRECTORY "${DIRECTORY}"
    RESULT_VARIABLE result
    ERROR_VARIABLE error)
  if (result STREQUAL "0" OR NOT error MATCHES "^cslf: error: A window needs a display[^\n]*\n$")
    message(FATAL_ERROR "Without a display, cslf view ended with ${result}: ${error}")
  endif ()
endif ()
if (NOT result STREQUAL "0" AND found_server)
  file(MAKE_DIRECTORY "${DIRECTORY}/bin")
  file(WRITE "${DIRECTORY}/bin/Xvfb" "#!/bin/sh\necho $$ > server\nexec '${found_server}' \"$@\"\n")
  file(CHMOD "${DIRECTORY}/bin/Xvfb" PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE)
  execute_process(
    COMMAND sh -c "unset DISPLAY; PATH=\"$PWD/bin:$PATH\"
      # A process that nobody waits for has ended, too, but has no command any more.
      isGone() {
        for second in 1 2 3 4 5 6 7 8 9; do
          test -n \"$(cat /proc/$(cat server)/cmdline 2> log | tr -d '\\0')\" || return 0; sleep 1
        done
        echo The server is left. >&2; return 1
      }
      '${CSLF}' render whole.mp4 -o virtual.png && isGone && test -s virtual.png || exit 1
      rm server
      '${CSLF}' render whole.mp4 --path orbit --frames 100000 -o killed &
      while ! test -d killed.partial/*/new; do kill -0 $! || exit 2; sleep 0.1; done
      test -s server || exit 3
      kill -KILL $!
      isGone"
    WORKING_DIRECTORY "${DIRECTORY}"
    RESULT_VARIABLE result
    ERROR_VARIABLE error)
  if (NOT result STREQUAL "0")
    message(FATAL_ERROR "Drawing with a server of its own ended with ${result}: ${error}")
  endif ()
  cslf_run(render whole.mp4 -o real.png)
  cslf_run(compare virtual.png real.png --json)
  expect_json_at_least(50 psnr)
endif ()
