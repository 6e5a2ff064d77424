# SPDX-FileCopyrightText: Copyright (c) CSLF contributors
# SPDX-License-Identifier: BSD-3-Clause

# Camera paths, as folders and videos.
include("${CMAKE_CURRENT_LIST_DIR}/cslfToolTesting.cmake")

# Runs the tool to draw a path, and checks the number of pictures in its folder.
function (draw_path folder count)
  cslf_run(render box.vti -o ${folder} --size 32 24 --lookup bilinear --json ${ARGN})
  expect_json(${count} frames)
  string(JSON times LENGTH "${output}" frame_seconds)
  file(GLOB frames "${DIRECTORY}/${folder}/*")
  list(LENGTH frames length)
  if (NOT length EQUAL count OR NOT times EQUAL count)
    message(FATAL_ERROR "${folder} has ${length} pictures and ${times} times, not ${count}.")
  endif ()
  set(output "${output}" PARENT_SCOPE)
endfunction ()

# Checks whether two pictures are equal.
function (expect_equal expected first second)
  file(SHA256 "${DIRECTORY}/${first}" one)
  file(SHA256 "${DIRECTORY}/${second}" other)
  if ((one STREQUAL other AND NOT expected) OR (expected AND NOT one STREQUAL other))
    message(FATAL_ERROR "That ${first} and ${second} are equal is not ${expected}.")
  endif ()
endfunction ()

cslf_run(sample cornell-box -o box.vti -M 2 -N 16 --spp 4 --max-depth 2)
cslf_run(render box.vti -o start.png --size 32 24 --lookup bilinear)

# Both paths begin at the camera; a swing returns on its own path.
draw_path(swing 8 --path swing --frames 8)
expect_json_at_least(0.000001 median_frame_seconds)
expect_equal(TRUE start.png swing/frame-0000.png)
expect_equal(FALSE start.png swing/frame-0002.png)
draw_path(orbit 4 --path orbit --frames 4)
expect_equal(TRUE start.png orbit/frame-0000.png)
expect_equal(FALSE start.png orbit/frame-0002.png)
# Existing output is replaced as a whole, and the rest of a killed run is removed.
file(MAKE_DIRECTORY "${DIRECTORY}/orbit.partial/unfinished-abcdef/new")
file(WRITE "${DIRECTORY}/orbit.partial/cslf.lock" "CSLF: a light field is being written here.\n")
file(WRITE "${DIRECTORY}/orbit.partial/unfinished-abcdef/new/frame-0000.png" "half a picture\n")
draw_path(orbit/ 3 --path orbit --frames 3)
if (EXISTS "${DIRECTORY}/orbit.partial")
  message(FATAL_ERROR "What a killed run has left is still there.")
endif ()

# A spline through key cameras, from the first to the last.
file(WRITE "${DIRECTORY}/path.json" "[[[0, 0, 5], [0, 0, 0], [0, 1, 0]],
 [[1, 0.5, 4], [0, 0, 0], [0, 1, 0]], [[2, 1, 4.5], [0, 0, 0], [0, 1, 0]]]")
draw_path(spline 5 --path path.json --frames 5)
foreach (frame IN ITEMS "0 0 0 5" "2 1 0.5 4" "4 2 1 4.5")
  string(REPLACE " " ";" position "${frame}")
  list(POP_FRONT position number)
  cslf_run(render box.vti -o key.png --size 32 24 --lookup bilinear --position ${position})
  cslf_run(compare key.png spline/frame-000${number}.png --json)
  expect_json_at_least(50 psnr)
endforeach ()
draw_path(one 1 --path path.json --frames 1)
expect_equal(TRUE one/frame-0000.png spline/frame-0000.png)

# Videos for any player.
if (HAS_ENCODER)
  cslf_run(render box.vti -o orbit.mkv --path orbit --frames 3 --size 32 24 --frame-rate 10 --json)
  expect_json(3 frames)
  file(SIZE "${DIRECTORY}/orbit.mkv" bytes)
  if (bytes LESS 200)
    message(FATAL_ERROR "orbit.mkv has ${bytes} bytes.")
  endif ()
  find_program(FFPROBE ffprobe)
  if (FFPROBE)
    execute_process(
      COMMAND "${FFPROBE}" -v error -count_frames -of csv=p=0 -show_entries
        stream=codec_name,width,height,pix_fmt,r_frame_rate,nb_read_frames orbit.mkv
      WORKING_DIRECTORY "${DIRECTORY}"
      OUTPUT_VARIABLE stream)
    if (NOT stream MATCHES "^h264,32,24,yuv420p,10/1,3")
      message(FATAL_ERROR "The video is ${stream}")
    endif ()
  endif ()
  # Movies for browsers. An animated WebP picture has a chunk for each different frame.
  cslf_run(render box.vti -o orbit.webm --path orbit --frames 3 --size 32 24 --frame-rate 10 --json)
  expect_json(3 frames)
  cslf_run(render box.vti -o orbit.webp --path orbit --frames 3 --size 33 25 --frame-rate 10)
  file(READ "${DIRECTORY}/orbit.webp" bytes HEX)
  string(REGEX MATCHALL "414e4d46" chunks "${bytes}")
  list(LENGTH chunks length)
  if (NOT bytes MATCHES "^52494646........57454250" OR NOT length EQUAL 3)
    message(FATAL_ERROR "orbit.webp has ${length} frames.")
  endif ()
  if (FFPROBE)
    execute_process(
      COMMAND "${FFPROBE}" -v error -count_frames -of csv=p=0 -show_entries
        stream=codec_name,width,height,pix_fmt,r_frame_rate,nb_read_frames orbit.webm
      WORKING_DIRECTORY "${DIRECTORY}"
      OUTPUT_VARIABLE stream)
    if (NOT stream MATCHES "^vp9,32,24,yuv420p,10/1,3")
      message(FATAL_ERROR "The video is ${stream}")
    endif ()
  endif ()
  cslf_fail("even" "x" render box.vti -o x.mp4 --path orbit --size 33 24)
  cslf_fail("Cannot write" "x" render box.vti -o nowhere/x.mp4 --path orbit)
endif ()

# Animated GIF, and single pictures: the same view in all formats, within what their coding loses.
cslf_run(render box.vti -o orbit.gif --path orbit --frames 3 --size 33 25 --frame-rate 10)
file(READ "${DIRECTORY}/orbit.gif" bytes HEX)
string(REGEX MATCHALL "0021f904" frames "${bytes}")
list(LENGTH frames length)
if (NOT bytes MATCHES "^4749463839612100190" OR length LESS 2)
  message(FATAL_ERROR "orbit.gif has ${length} frames, and begins with another header.")
endif ()
foreach (format IN ITEMS jpg webp)
  cslf_run(render box.vti -o start.${format} --size 32 24 --lookup bilinear)
  cslf_run(compare start.${format} start.png --json)
  expect_json_at_least(33 psnr)
endforeach ()
cslf_run(render box.vti -o start.gif --size 32 24 --lookup bilinear)
cslf_fail("as .png" "x" render box.vti -o x.mp4)

# Paths that cannot be drawn.
file(WRITE "${DIRECTORY}/text.json" "no path\n")
file(WRITE "${DIRECTORY}/single.json" "[[[0, 0, 5], [0, 0, 0], [0, 1, 0]]]")
file(WRITE "${DIRECTORY}/short.json" "[[[0, 0, 5], [0, 0, 0], [0, 1, 0]], [[0, 5], [0, 0, 0]]]")
file(WRITE "${DIRECTORY}/blind.json"
  "[[[0, 0, 5], [0, 0, 0], [0, 1, 0]], [[0, 0, 5], [0, 0, 5], [0, 1, 0]]]")
file(WRITE "${DIRECTORY}/infinite.json"
  "[[[0, 0, 5], [0, 0, 0], [0, 1, 0]], [[0, 0, 1e999], [0, 0, 0], [0, 1, 0]]]")
cslf_fail("no camera path nowhere.json" "x" render box.vti -o x --path nowhere.json)
cslf_fail("text.json" "x" render box.vti -o x --path text.json)
cslf_fail("two or more" "x" render box.vti -o x --path single.json)
cslf_fail("camera 1 is not" "x" render box.vti -o x --path short.json)
cslf_fail("camera 1 has no direction" "x" render box.vti -o x --path blind.json)
cslf_fail("infinite.json" "x" render box.vti -o x --path infinite.json)
cslf_fail("35 degrees" "x" render box.vti -o x --path swing --position 4 0 0)
cslf_fail("a folder, .mp4, .mkv, .webm, .gif or .webp" "x"
  render box.vti -o x.png --path orbit)
cslf_fail("cannot make the folder nowhere" "x" render box.vti -o nowhere/x --path orbit)
cslf_fail("the same" "" render box.vti -o box.vti)
file(MAKE_DIRECTORY "${DIRECTORY}/other")
file(WRITE "${DIRECTORY}/other/letter.txt" "Dear reader\n")
cslf_fail("other files" "" render box.vti -o other --path orbit)
file(GLOB partial "${DIRECTORY}/*.partial")
if (partial)
  message(FATAL_ERROR "${partial} is left.")
endif ()
