# SPDX-FileCopyrightText: Copyright (c) CSLF contributors
# SPDX-License-Identifier: BSD-3-Clause

# A tool without the video encoder reads videos, and reports that it cannot write them.
include("${CMAKE_CURRENT_LIST_DIR}/cslfToolTesting.cmake")

cslf_run(info "${DATA}/field.mp4" --json)
expect_json(hevc codec)
expect_json(0 missing)
cslf_run(decode "${DATA}/field.mp4" -o field.vti)
cslf_run(decode "${DATA}/field.mp4" -o field)
cslf_run(compare field.vti field --json)
expect_json(ON channels Color equal)
expect_json(ON channels Depth equal)
cslf_run(sample cornell-box -o box.vti -M 2 -N 16 --spp 1 --max-depth 1)

cslf_fail("without the video encoder" "x" encode field.vti -o x.mp4)
cslf_fail("without the video encoder" "x" sample cornell-box -o x.mkv -M 2 -N 16 --spp 1)
cslf_fail("without the video encoder" "x" sample cornell-box --estimate)
cslf_fail("without the video encoder" "x" sample cornell-box -o x.vti --time-budget 5)
