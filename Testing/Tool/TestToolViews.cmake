# SPDX-FileCopyrightText: Copyright (c) CSLF contributors
# SPDX-License-Identifier: BSD-3-Clause

# Novel views: rendered, evaluated, and in a window.
include("${CMAKE_CURRENT_LIST_DIR}/cslfToolTesting.cmake")

set(light --max-depth 2)
cslf_run(sample cornell-box -o box.vti -M 5 -N 32 --spp 16 ${light})
set(camera --position 0.6 0.3 4.4 --size 96 96)
cslf_run(trace cornell-box -o truth.png --spp 128 ${light} ${camera})
foreach (lookup IN ITEMS nearest linear bilinear focal depth)
  cslf_run(render box.vti -o ${lookup}.png --lookup ${lookup} ${camera})
  cslf_run(compare ${lookup}.png truth.png --json)
  string(JSON psnr_${lookup} GET "${output}" psnr)
endforeach ()
if (psnr_nearest LESS 12 OR NOT psnr_depth GREATER psnr_bilinear OR
    NOT psnr_bilinear GREATER psnr_nearest)
  message(FATAL_ERROR "nearest ${psnr_nearest} dB, bilinear ${psnr_bilinear} dB, "
    "depth ${psnr_depth} dB")
endif ()

cslf_run(evaluate box.vti cornell-box --views 2 --size 64 --spp 256 ${light} --json -o views
  --contact-sheet sheet.png --title box)
expect_json(2 views)
expect_json_at_least(30 noise_floor)
foreach (lookup IN ITEMS nearest linear bilinear focal depth)
  expect_json_at_least(10 lookups ${lookup} psnr)
  expect_json_at_least(0.1 lookups ${lookup} ssim)
  expect_json_at_least(0.1 lookups ${lookup} frames_per_second)
  if (NOT EXISTS "${DIRECTORY}/views/view-1-${lookup}.png")
    message(FATAL_ERROR "The picture of view 1, ${lookup}, is missing.")
  endif ()
endforeach ()
if (NOT EXISTS "${DIRECTORY}/sheet.png")
  message(FATAL_ERROR "The contact sheet is missing.")
endif ()

# Along a path: every view and every change has its figure, and the sheet is about square.
cslf_run(evaluate box.vti cornell-box --path swing --frames 9 --size 48 --spp 128 ${light}
  --lookups bilinear,depth --json -o swing --contact-sheet swing.png)
expect_json(9 views)
expect_json("swing" path)
foreach (lookup IN ITEMS bilinear depth)
  string(JSON views LENGTH "${output}" lookups ${lookup} psnr_of_views)
  string(JSON steps LENGTH "${output}" lookups ${lookup} change_psnr_of_steps)
  if (NOT views EQUAL 9 OR NOT steps EQUAL 8)
    message(FATAL_ERROR "${lookup} has ${views} views and ${steps} steps.")
  endif ()
  string(JSON lowest GET "${output}" lookups ${lookup} lowest_psnr)
  expect_json_at_least(${lowest} lookups ${lookup} median_psnr)
  string(JSON lowest GET "${output}" lookups ${lookup} lowest_change_psnr)
  expect_json_at_least(${lowest} lookups ${lookup} median_change_psnr)
  string(JSON change_${lookup} GET "${output}" lookups ${lookup} median_change_psnr)
endforeach ()
if (NOT change_depth GREATER change_bilinear)
  message(FATAL_ERROR "Changes: bilinear ${change_bilinear} dB, depth ${change_depth} dB")
endif ()
string(JSON nothing ERROR_VARIABLE error GET "${output}" lookups focal)
if (NOT error OR NOT EXISTS "${DIRECTORY}/swing/view-8-depth.png")
  message(FATAL_ERROR "A lookup was measured that nobody asked for, or a picture is missing.")
endif ()
file(READ "${DIRECTORY}/swing.png" header OFFSET 16 LIMIT 8 HEX)
# Two views of three pictures of 48 pixels in a row, 4 pixels between: 308 wide.
if (NOT header MATCHES "^00000134")
  message(FATAL_ERROR "The contact sheet's size is ${header}.")
endif ()
# The same picture repeatedly: no changes and no flicker.
file(WRITE "${DIRECTORY}/still.json"
  "[[[0, 0, 5], [0, 0, 0], [0, 1, 0]], [[0, 0, 5], [0, 0, 0], [0, 1, 0]]]")
cslf_run(evaluate box.vti cornell-box --path still.json --frames 2 --size 48 --spp 1024 ${light}
  --lookups depth --json)
expect_json_at_least(42 lookups depth change_psnr_of_steps 0)
cslf_run(sample cornell-box -o flat.vti -M 2 -N 16 --spp 1 --no-depth ${light})
cslf_fail("needs a depth channel" "x" evaluate flat.vti cornell-box --lookups depth)
cslf_fail("--views" "x" evaluate box.vti cornell-box --path orbit --views 3)
cslf_fail("no camera path" "x" evaluate box.vti cornell-box --path nowhere.json)

# A kept reference: traced once, but only for the same view of the same scene.
set(novel --views 1 --size 32 --spp 64 --lookups depth --truth kept --json)
foreach (run IN ITEMS first second)
  cslf_run(evaluate box.vti cornell-box ${light} ${novel})
  string(JSON psnr_${run} GET "${output}" lookups depth psnr)
  file(GLOB kept "${DIRECTORY}/kept/*.vti")
  list(LENGTH kept halves)
  if (NOT halves EQUAL 2)
    message(FATAL_ERROR "${halves} halves of the truth are kept.")
  endif ()
endforeach ()
if (NOT psnr_first EQUAL psnr_second)
  message(FATAL_ERROR "The truth that was kept is another: ${psnr_first} and ${psnr_second} dB.")
endif ()
cslf_run(evaluate box.vti cornell-box --max-depth 1 ${novel})
file(GLOB others "${DIRECTORY}/kept/*.vti")
list(LENGTH others halves)
if (NOT halves EQUAL 4)
  message(FATAL_ERROR "Light of another depth is the same truth.")
endif ()
list(GET kept 0 half)
file(COPY_FILE "${DIRECTORY}/box.vti" "${half}")
cslf_fail("no path-traced view" "x" evaluate box.vti cornell-box ${light} ${novel})

cslf_run(view box.vti --close-after 0.5 --size 96 96 --record window.gif)
file(SIZE "${DIRECTORY}/window.gif" bytes)
if (bytes LESS 1000)
  message(FATAL_ERROR "The window's record has ${bytes} bytes.")
endif ()

# However slowly the window is drawn, its record lasts as long as it was open. Movies have only the
# pictures that were drawn, folders one for each frame.
set(slow cornell-box --keys t --size 1200 900 --close-after 2 --threads 1)
find_program(FFPROBE ffprobe)
if (HAS_ENCODER AND FFPROBE)
  cslf_run(view box.vti ${slow} --record window.mkv)
  execute_process(
    COMMAND "${FFPROBE}" -v error -count_packets -select_streams v:0 -of csv=p=0
      -show_entries stream=nb_read_packets:format=duration window.mkv
    WORKING_DIRECTORY "${DIRECTORY}"
    OUTPUT_VARIABLE probed)
  if (NOT probed MATCHES "^([0-9]+)[^\n]*\n([0-9]+)[.]([0-9])")
    message(FATAL_ERROR "window.mkv has: ${probed}")
  endif ()
  math(EXPR frames "25 * (10 * ${CMAKE_MATCH_2} + ${CMAKE_MATCH_3}) / 10")
  if (frames LESS 48 OR NOT CMAKE_MATCH_1 LESS frames)
    message(FATAL_ERROR "window.mkv has ${CMAKE_MATCH_1} pictures for ${frames} frames.")
  endif ()
endif ()
cslf_run(view box.vti ${slow} --record frames)
file(GLOB frames "${DIRECTORY}/frames/frame-*.png")
list(LENGTH frames count)
if (count LESS 50)
  message(FATAL_ERROR "The window's record has ${count} frames for two seconds.")
endif ()
# If it cannot be written, the window closes, and says once why.
if (NOT CMAKE_HOST_WIN32)
  execute_process(
    COMMAND bash -c "
      '${CSLF}' view box.vti --close-after 60 --size 96 96 --record lost 2> log.txt &
      while kill -0 $! && ! ls -d lost.partial/*/new; do sleep 0.01; done
      mv lost.partial/*/new gone
      wait $!"
    WORKING_DIRECTORY "${DIRECTORY}"
    RESULT_VARIABLE result
    OUTPUT_QUIET
    ERROR_QUIET)
  file(READ "${DIRECTORY}/log.txt" error)
  if (NOT result STREQUAL "1" OR NOT error MATCHES "^cslf: error: Cannot write lost: [^\n]+\n$")
    message(FATAL_ERROR "The record was lost, and viewing ended with ${result}: ${error}")
  endif ()
endif ()

# The background is that of all commands, also beside the path-traced scene and in cells without a
# pane: from far away nothing else is seen but labels.
set(far --position 0 0 100 --size 800 400)
foreach (background IN ITEMS "" "--background;white")
  cslf_run(trace cornell-box -o traced.png --spp 1 ${far} ${background})
  cslf_run(render box.vti -o rendered.png ${far} ${background})
  cslf_run(view box.vti cornell-box --keys st --truth-samples 1 ${far} ${background}
    --screenshot viewed.png)
  cslf_run(compare traced.png rendered.png --json)
  expect_json_at_least(40 psnr)
  cslf_run(compare traced.png viewed.png --json)
  expect_json_at_least(12 psnr)
endforeach ()

# A scene is viewed through a preview.
cslf_run(view cornell-box ${light} --size 400 400 --screenshot preview.png --keys i)
cslf_run(trace cornell-box ${light} --size 400 400 --spp 16 -o traced.png)
cslf_run(compare preview.png traced.png --json)
expect_json_at_least(22 psnr)

# The viewer off screen: all lookups beside the reference, with everything that keys switch on.
cslf_run(view box.vti cornell-box ${light} --keys stoavh --truth-samples 32 --size 288 192
  --screenshot window.png --json)
expect_json(32 truth_samples)
expect_json_at_least(20 psnr depth)
string(JSON psnr_depth GET "${output}" psnr depth)
string(JSON psnr_nearest GET "${output}" psnr nearest)
if (NOT psnr_depth GREATER psnr_nearest)
  message(FATAL_ERROR "In the viewer nearest has ${psnr_nearest} dB, depth ${psnr_depth} dB")
endif ()
if (NOT EXISTS "${DIRECTORY}/window.png")
  message(FATAL_ERROR "The screenshot is missing.")
endif ()
cslf_run(view box.vti --screenshot plain.png --size 96 96 --keys "m[p")
if (NOT EXISTS "${DIRECTORY}/cslf-view-1.png")
  message(FATAL_ERROR "The key p wrote no picture.")
endif ()
cslf_fail("key z" "never.png" view box.vti --keys z --screenshot never.png)

# Exposure and tone mapping at view time: the reference is shown likewise.
cslf_run(render box.vti -o dim.png --view-exposure 0.25 ${camera})
cslf_run(compare dim.png depth.png --json)
string(JSON psnr_dim GET "${output}" psnr)
if (psnr_dim GREATER 30)
  message(FATAL_ERROR "A quarter of the exposure changes the picture to ${psnr_dim} dB only.")
endif ()
cslf_run(evaluate box.vti cornell-box --views 1 --size 64 --spp 1024 ${light} --view-exposure 0.5
  --tone-mapping reinhard --json)
expect_json_at_least(20 lookups depth psnr)
