# SPDX-FileCopyrightText: Copyright (c) CSLF contributors
# SPDX-License-Identifier: BSD-3-Clause

# Other programs and the videos: FFmpeg's tools report no errors, and a video that they copy from
# one container to the other and back is still the same field.
include("${CMAKE_CURRENT_LIST_DIR}/cslfToolTesting.cmake")

find_program(ffmpeg ffmpeg)
find_program(ffprobe ffprobe)
if (NOT ffmpeg OR NOT ffprobe)
  message("The programs ffmpeg and ffprobe are not installed.")
  return ()
endif ()

# Runs another program, which must succeed without output.
function (run_silently)
  execute_process(
    COMMAND ${ARGN}
    WORKING_DIRECTORY "${DIRECTORY}"
    RESULT_VARIABLE result
    OUTPUT_VARIABLE output
    ERROR_VARIABLE output)
  if (NOT result STREQUAL "0" OR NOT output STREQUAL "")
    message(FATAL_ERROR "${ARGN}\nended with ${result}: ${output}")
  endif ()
endfunction ()

# Checks that two videos are the same field without missing viewpoints.
function (expect_same first second)
  cslf_run(info ${second} --json)
  expect_json(0 missing)
  cslf_run(compare ${first} ${second} --json)
  expect_json(ON channels Color equal)
  expect_json(ON channels Coverage equal)
  expect_json(${ARGN})
endfunction ()

set(scene cornell-box -M 3 -N 32 --spp 1 --max-depth 1 --integrator path)
set(coding --group-length 5 --preset fast)
cslf_run(sample ${scene} -o field.vti)
cslf_run(sample ${scene} -o flat.vti --no-depth)
cslf_run(sample ${scene} -o covered.vti --show-environment)
cslf_run(encode field.vti -o plain.mp4 ${coding})
cslf_run(encode field.vti -o plain.mkv ${coding})
cslf_run(encode field.vti -o lossless.mp4 ${coding} --lossless)
cslf_run(encode field.vti -o lossless.mkv ${coding} --lossless)
cslf_run(encode field.vti -o small.mkv ${coding} --pixel-format yuv420p)
cslf_run(encode field.vti -o deep.mp4 ${coding} --pixel-format yuv444p10le)
cslf_run(encode flat.vti -o flat.mp4 ${coding})
cslf_run(encode covered.vti -o covered.mp4 ${coding})
foreach (video IN ITEMS
    plain.mp4 plain.mkv lossless.mp4 lossless.mkv flat.mp4 small.mkv deep.mp4 covered.mp4)
  run_silently("${ffprobe}" -v error "${video}")
  run_silently("${ffmpeg}" -v warning -i "${video}" -map 0 -f null -)
endforeach ()

foreach (name IN ITEMS plain lossless)
  run_silently("${ffmpeg}" -v error -i ${name}.mp4 -map 0 -c copy ${name}-there.mkv)
  run_silently("${ffmpeg}" -v error -i ${name}-there.mkv -map 0 -c copy ${name}-back.mp4)
  expect_same(${name}.mp4 ${name}-there.mkv ON channels Depth equal)
  expect_same(${name}.mp4 ${name}-back.mp4 ON channels Depth equal)
endforeach ()
