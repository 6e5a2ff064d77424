# SPDX-FileCopyrightText: Copyright (c) CSLF contributors
# SPDX-License-Identifier: BSD-3-Clause

# A video can be seen while it is being written, by its name, its folder's or the preview's.
include("${CMAKE_CURRENT_LIST_DIR}/cslfToolTesting.cmake")

set(scene cornell-box -M 5 -N 32 --spp 16 --integrator path --preset ultrafast)
# Before there is a preview, and folders of such names that are the user's own.
file(WRITE "${DIRECTORY}/new.mp4.partial/cslf.lock" "")
foreach (name IN ITEMS new.mp4 new.mp4.partial)
  cslf_fail("${name} is unfinished, and there is no preview yet.\n" "" view ${name})
endforeach ()
cslf_run(sample cornell-box -M 2 -N 16 --spp 1 --max-depth 1 -o old.mp4)
file(MAKE_DIRECTORY "${DIRECTORY}/old.mp4.partial")
cslf_run(sample cornell-box -M 3 -N 16 --spp 1 --max-depth 1 -o old.mp4.partial/preview.mkv)
cslf_run(info old.mp4.partial/preview.mkv --json)
expect_json(3 views)

cslf_kill_at(preview.mp4 box.mp4 sample ${scene})
foreach (name IN ITEMS box.mp4 box.mp4.partial box.mp4.partial/ box.mp4.partial/preview.mp4)
  cslf_run(info ${name} --json)
  expect_json(ON unfinished)
  expect_json_at_least(1 missing)
  cslf_run(view ${name} --screenshot view.png)
  if (NOT EXISTS "${DIRECTORY}/view.png")
    message(FATAL_ERROR "There is no picture of ${name}.")
  endif ()
  file(REMOVE "${DIRECTORY}/view.png")
endforeach ()
cslf_end(2 "^cslf: error: box.mp4 is unfinished: [0-9]+ of 150 viewpoints are missing[^\n]*\n$" ""
  render box.mp4 -o view.png)
cslf_run(render box.mp4 --allow-missing -o early.png)
# What a run will resume from is not overwritten by what was made of it.
foreach (name IN ITEMS box.mp4 box.mp4.partial box.mp4.partial/preview.mp4)
  cslf_fail("The input and the output are the same" "" encode ${name} --allow-missing -o box.mp4)
endforeach ()
execute_process(
  COMMAND "${CSLF}" resample box.mp4 --allow-missing --resolution-divisor 2 -o early.vti
  WORKING_DIRECTORY "${DIRECTORY}"
  RESULT_VARIABLE result
  ERROR_VARIABLE error)
if (NOT result STREQUAL "0" OR NOT error MATCHES "^cslf: warning: [^\n]*is unfinished[^\n]*\n$")
  message(FATAL_ERROR "Resampling ended with ${result}: ${error}")
endif ()
cslf_run(info early.vti --json)
expect_json_at_least(1 missing)
cslf_run(sample ${scene} -o box.mp4)
cslf_run(info box.mp4.partial --json)
expect_json(OFF unfinished)
expect_json(0 missing)
cslf_run(render box.mp4 -o late.png)
cslf_run(compare early.png late.png --json)
expect_json_at_least(15 psnr)
