# SPDX-FileCopyrightText: Copyright (c) CSLF contributors
# SPDX-License-Identifier: BSD-3-Clause

# A light field sampled, and taken through every format.
include("${CMAKE_CURRENT_LIST_DIR}/cslfToolTesting.cmake")

set(scene cornell-box -M 2 -N 16 --spp 2 --max-depth 2 --seed 7)
cslf_run(sample ${scene} -o box.vti --json)
expect_json(2 views)
expect_json(16 resolution)
expect_json("box.vti" output)
cslf_run(sample ${scene} -o box.mp4)
cslf_run(sample ${scene} -o box)

# The same samples, whichever way they are written.
cslf_run(compare box box.vti --json)
expect_json(ON channels Color equal)
expect_json(ON channels Coverage equal)
expect_json(ON channels Depth equal)
cslf_run(compare box.mp4 box.vti --json)
expect_json_at_least(25 channels Color psnr)
expect_json_at_least(25 channels Depth psnr)

cslf_run(encode box.vti -o lossless.mkv --lossless)
cslf_run(decode lossless.mkv -o decoded)
cslf_run(decode decoded -o decoded.vti)
cslf_run(compare decoded.vti box --json)
expect_json(ON channels Color equal)
expect_json(ON channels Depth equal)
cslf_run(encode box -o box.mp4 --crf 30 --preset fast --json)
cslf_run(decode box.mp4 -o decoded)

cslf_run(info box.mp4 --json)
expect_json(2 views)
expect_json(24 slices)
expect_json(16 resolution)
expect_json(hevc codec)
expect_json(0 missing)
expect_json(Color channels 0 name)
expect_json(Depth channels 1 name)
expect_json_at_least(1 bytes)
expect_json_at_least(2 edge)
string(JSON length LENGTH "${output}" center)
if (NOT length EQUAL 3)
  message(FATAL_ERROR "The centre has ${length} coordinates.")
endif ()
cslf_run(info box.vti)
if (NOT output MATCHES "resolution +16 x 16")
  message(FATAL_ERROR "The table is:\n${output}")
endif ()

cslf_run(sample ${scene} -o linear --float --no-depth)
cslf_run(info linear --json)
expect_json(exr codec)
expect_json(float32 channels 0 type)

# A folder of cube maps with one picture gone is still a light field.
file(REMOVE "${DIRECTORY}/decoded/000003.Color.png")
cslf_run(info decoded --json)
expect_json(1 missing)
