# SPDX-FileCopyrightText: Copyright (c) CSLF contributors
# SPDX-License-Identifier: BSD-3-Clause

# Key views with depth compared with all views without depth: tables, plots, and plausible figures.
include("${CMAKE_CURRENT_LIST_DIR}/cslfToolTesting.cmake")

set(light --max-depth 2)
cslf_run(sample cornell-box -o box.vti -M 3 -N 32 --spp 4 ${light})
lab_run(key-views box.vti cornell-box -o keys --crfs 40,16 --steps 1,2 --depth-crfs 12,40
  --preset ultrafast --views 1 --size 48 --spp 64 ${light} --json)
foreach (series IN ITEMS 0 1 2)
  expect_json_at_least(5 series ${series} uncoded_psnr)
  foreach (point IN ITEMS 0 1)
    expect_json_at_least(100 series ${series} points ${point} bytes)
    expect_json_at_least(5 series ${series} points ${point} psnr)
  endforeach ()
endforeach ()
expect_json(3 series 1 viewpoints)
expect_json(2 series 2 viewpoints)
expect_json(32 series 2 resolution)
# The paper's files contain only colour.
string(JSON tracks LENGTH "${output}" series 0 points 0 tracks)
string(JSON all LENGTH "${output}" series 1 points 0 tracks)
if (NOT tracks EQUAL 1 OR NOT all EQUAL 3)
  message(FATAL_ERROR "There are ${tracks} tracks without depth, ${all} with it.")
endif ()
# The table's values at equal quality and at equal size follow from the points.
string(JSON length LENGTH "${output}" comparisons)
string(JSON ratio GET "${output}" comparisons 0 ratio)
string(JSON gain GET "${output}" comparisons 0 gain)
if (NOT length EQUAL 2 OR NOT ratio GREATER 0.1 OR NOT gain GREATER 0)
  message(FATAL_ERROR "${length} comparisons; ${ratio} times fewer bytes, ${gain} dB more.")
endif ()
foreach (file IN ITEMS key-views.md key-views.json key-views.png)
  if (NOT EXISTS "${DIRECTORY}/keys/${file}")
    message(FATAL_ERROR "${file} is missing.")
  endif ()
endforeach ()
if (EXISTS "${DIRECTORY}/keys/coded.mp4")
  message(FATAL_ERROR "A video is left.")
endif ()
# Fewer texels, and two rate factors of depth.
lab_run(key-views box.vti cornell-box -o few --crfs 40 --steps 2 --divisors 2
  --depth-crfs 12,30 --preset ultrafast --views 1 --size 48 --spp 64 ${light} --json)
expect_json(16 series 1 resolution)
expect_json(30.0 series 1 points 1 depth_crf)
string(JSON fine GET "${output}" series 1 points 0 tracks depth)
string(JSON coarse GET "${output}" series 1 points 1 tracks depth)
if (NOT coarse LESS fine)
  message(FATAL_ERROR "Depth takes ${coarse} bytes coded coarsely, ${fine} coded finely.")
endif ()
string(JSON coverage GET "${output}" series 1 points 1 tracks coverage)
lab_run(key-views box.vti cornell-box -o coarse --crfs 40 --steps 2 --divisors 2
  --depth-crfs 30 --coverage-crf 50 --preset ultrafast --views 1 --size 48 --spp 64 ${light} --json)
expect_json(50.0 coverage_crf)
string(JSON coarse GET "${output}" series 1 points 0 tracks coverage)
if (NOT coarse LESS coverage)
  message(FATAL_ERROR "Coverage takes ${coarse} bytes coded coarsely, ${coverage} coded finely.")
endif ()
