# SPDX-FileCopyrightText: Copyright (c) CSLF contributors
# SPDX-License-Identifier: BSD-3-Clause

# A light field is sampled, and converted to every format.
include("${CMAKE_CURRENT_LIST_DIR}/cslfToolTesting.cmake")

set(scene cornell-box -M 2 -N 16 --spp 2 --max-depth 2 --seed 7)
cslf_run(sample ${scene} -o box.vti --json)
expect_json(2 views)
expect_json(16 resolution)
expect_json("box.vti" output)
# Centres of some texels lie on edges of the blocks, where rounding decides for either surface: with
# few triangles, as in the scene, depth from the geometry decides like the rays.
cslf_run(sample ${scene} --geometry-triangles 60 -o box.mp4)
cslf_run(sample ${scene} -o box)

# The samples are the same in all formats.
cslf_run(compare box box.vti --json)
expect_json(ON channels Color equal)
expect_json(ON channels Coverage equal)
expect_json(ON channels Depth equal)
cslf_run(compare box.mp4 box.vti --json)
expect_json_at_least(25 channels Color psnr)
expect_json_at_least(25 channels Depth psnr)

# A larger field is written in several pieces.
set(large cornell-box -M 3 -N 128 --spp 1 --max-depth 1 --integrator path --geometry-triangles 0)
cslf_run(sample ${large} -o large.vti)
file(STRINGS "${DIRECTORY}/large.vti" pieces REGEX "<Piece" LIMIT_INPUT 10000)
list(LENGTH pieces count)
if (count LESS 2)
  message(FATAL_ERROR "large.vti has ${count} pieces")
endif ()
cslf_run(sample ${large} -o large)
cslf_run(compare large large.vti --json)
expect_json(ON channels Color equal)
expect_json(ON channels Depth equal)

cslf_run(encode box.vti -o lossless.mkv --lossless)
cslf_run(decode lossless.mkv -o decoded)
cslf_run(decode decoded -o decoded.vti)
cslf_run(compare decoded.vti box --json)
expect_json(ON channels Color equal)
expect_json(ON channels Depth equal)
cslf_run(encode box -o box.mp4 --crf 30 --preset fast --json)
expect_json(30.0 crf)
expect_json_at_least(20 psnr)
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

# A video's parts besides the light field.
cslf_run(info "${DATA}/Golden/v2-hevc-parts.mp4" --json)
expect_json(application/octet-stream parts 0 type)
expect_json("every byte" parts 0 name)
expect_json(256 parts 0 bytes)
expect_json(text/plain parts 1 type)
cslf_run(info "${DATA}/Golden/v2-hevc-parts.mkv")
if (NOT output MATCHES "part +application/octet-stream \"every byte\", 256 bytes")
  message(FATAL_ERROR "The parts are not listed: ${output}")
endif ()

cslf_run(info box.vti)
if (NOT output MATCHES "resolution +16 x 16")
  message(FATAL_ERROR "The table is:\n${output}")
endif ()

cslf_run(sample ${scene} -o linear --float --no-depth)
cslf_run(info linear --json)
expect_json(exr codec)
expect_json(float32 channels 0 type)

# Float colours in all steps.
cslf_run(sample ${scene} -o linear.vti --float --no-depth)
cslf_run(sample ${scene} -o linear.mp4 --float --no-depth --crf 4)
cslf_run(decode linear.mp4 -o back.vti)
cslf_run(info back.vti --json)
expect_json(float32 channels 0 type)
expect_json(linear-associated-alpha channels 0 encoding)
cslf_run(compare back.vti linear.vti --json)
expect_json_at_least(22 channels Color psnr)
cslf_fail("without loss" "no" encode linear.vti -o no.mp4 --lossless)

# Other codecs, if they exist.
execute_process(COMMAND "${CSLF}" encode box.vti -o h264.mp4 --codec h264
  WORKING_DIRECTORY "${DIRECTORY}" RESULT_VARIABLE result ERROR_VARIABLE error OUTPUT_QUIET)
if (result STREQUAL "0")
  cslf_run(info h264.mp4 --json)
  expect_json(h264 codec)
elseif (NOT error MATCHES "has encoders for")
  message(FATAL_ERROR "encode --codec h264 said: ${error}")
endif ()
cslf_fail("none of hevc, av1, h264" "no" encode box.vti -o no.mp4 --codec none)

# A folder of cube maps without one picture is still a light field.
file(REMOVE "${DIRECTORY}/decoded/000003.Color.png")
cslf_run(info decoded --json)
expect_json(1 missing)

# A coarser field in every format, and refusals.
cslf_run(sample cornell-box -M 3 -N 32 --spp 2 --max-depth 2 -o fine.vti)
cslf_run(resample fine.vti -o coarse.vti --resolution-divisor 2 --viewpoint-stride 2 --json)
expect_json(2 views)
expect_json(24 slices)
expect_json(16 resolution)
expect_json(2 sampling resampled viewpoint_stride)
cslf_run(encode fine.vti -o fine.mkv --lossless)
cslf_run(resample fine.mkv -o coarse.mkv --resolution-divisor 2 --viewpoint-stride 2 --lossless)
cslf_run(resample fine.vti -o coarse --resolution-divisor 2 --viewpoint-stride 2)
foreach (other IN ITEMS coarse.mkv coarse)
  cslf_run(compare ${other} coarse.vti --json)
  expect_json(ON channels Color equal)
  expect_json(ON channels Depth equal)
endforeach ()
cslf_fail("divided by 5" "x" resample fine.vti -o x.vti --resolution-divisor 5)
cslf_fail("must divide 2" "x" resample fine.vti -o x.mp4 --viewpoint-stride 3)
cslf_fail("at least 16" "x" resample fine.vti -o x.mp4 --resolution-divisor 4)
