# SPDX-FileCopyrightText: Copyright (c) CSLF contributors
# SPDX-License-Identifier: BSD-3-Clause

# The cost of a bake is estimated without writing anything. A time budget chooses samples, which are
# stored and kept.
include("${CMAKE_CURRENT_LIST_DIR}/cslfToolTesting.cmake")

set(scene cornell-box -M 3 -N 16 --cache-samples 64 --cache-spacing 0.05 --cache-tolerance 0.05
  --preset ultrafast)
foreach (output IN ITEMS x.mp4 x.vti x)
  cslf_run(sample ${scene} --spp 4 --estimate -o ${output} --json)
  expect_json_at_least(0 scene_seconds)
  expect_json_at_least(0 cache_seconds)
  expect_json_at_least(1000 bytes)
  expect_json(4 samples)
endforeach ()
file(GLOB left "${DIRECTORY}/*")
if (left)
  message(FATAL_ERROR "An estimate left ${left}")
endif ()

# Better fields are larger.
function (cslf_suggest target psnr bytes)
  cslf_run(sample ${scene} --spp 4 --estimate ${target} --json)
  string(JSON found_psnr GET "${output}" suggestion psnr)
  string(JSON found_bytes GET "${output}" suggestion bytes)
  set(${psnr} "${found_psnr}" PARENT_SCOPE)
  set(${bytes} "${found_bytes}" PARENT_SCOPE)
endfunction ()
cslf_suggest("--suggest-for-novel-psnr;20" psnr_low bytes_low)
cslf_suggest("--suggest-for-novel-psnr;34" psnr_high bytes_high)
if (psnr_low LESS 20 OR psnr_high LESS 34 OR NOT bytes_high GREATER bytes_low)
  message(FATAL_ERROR "${psnr_low} dB in ${bytes_low} bytes, ${psnr_high} dB in ${bytes_high}")
endif ()
cslf_suggest("--suggest-for-size;2MB" psnr bytes)
if (bytes GREATER 2000000)
  message(FATAL_ERROR "${bytes} bytes were suggested where 2000000 were allowed.")
endif ()
cslf_fail("No field reaches" "" sample ${scene} --estimate --suggest-for-novel-psnr 59)
cslf_fail("need a video" "" sample ${scene} --estimate --suggest-for-novel-psnr 20 -o x.vti)
cslf_fail("estimate" "" sample ${scene} --suggest-for-novel-psnr 30 -o x.mp4)

# A budget's samples are the same as if they were given; a restarted run keeps its own.
cslf_fail("single sample" "x" sample ${scene} --time-budget 0.0001 -o x.mp4)
cslf_run(sample ${scene} --time-budget 20 -o budget.mp4 --json)
string(JSON samples GET "${output}" sampling samples)
cslf_run(sample ${scene} --spp ${samples} -o named.mp4)
file(SHA256 "${DIRECTORY}/budget.mp4" budget)
file(SHA256 "${DIRECTORY}/named.mp4" named)
if (NOT budget STREQUAL named)
  message(FATAL_ERROR "A time budget gave other bytes than --spp ${samples}.")
endif ()
execute_process(
  COMMAND bash -c "
    '${CSLF}' \"$@\" --spp 37 -o killed.mp4 > log.txt 2>&1 &
    while kill -0 $! && ! [ -e killed.mp4.partial/group-1-color.part ]; do sleep 0.01; done
    kill -KILL $!
    wait $!" bash sample ${scene}
  WORKING_DIRECTORY "${DIRECTORY}"
  ERROR_QUIET)
if (EXISTS "${DIRECTORY}/killed.mp4.partial/manifest.json")
  cslf_run(sample ${scene} --time-budget 20 -o killed.mp4 --json)
  expect_json(37 sampling samples)
endif ()
