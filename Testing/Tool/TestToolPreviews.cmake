# SPDX-FileCopyrightText: Copyright (c) CSLF contributors
# SPDX-License-Identifier: BSD-3-Clause

# A video can be seen while it is being written, by its name, its folder's or the preview's.
include("${CMAKE_CURRENT_LIST_DIR}/cslfToolTesting.cmake")

set(scene cornell-box -M 5 -N 32 --spp 16 --integrator path --preset ultrafast)
file(MAKE_DIRECTORY "${DIRECTORY}/new.mp4.partial")
cslf_fail("new.mp4: it is unfinished, and there is no preview yet.\n" "" view new.mp4)

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
cslf_run(sample ${scene} -o box.mp4)
cslf_run(info box.mp4.partial --json)
expect_json(OFF unfinished)
expect_json(0 missing)
cslf_run(render box.mp4 -o late.png)
cslf_run(compare early.png late.png --json)
expect_json_at_least(15 psnr)
