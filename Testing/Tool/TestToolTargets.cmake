# SPDX-FileCopyrightText: Copyright (c) CSLF contributors
# SPDX-License-Identifier: BSD-3-Clause

# Videos with a target size, ratio or quality, and of key views.
include("${CMAKE_CURRENT_LIST_DIR}/cslfToolTesting.cmake")

set(scene cornell-box -M 5 -N 32 --spp 4 --max-depth 2 --integrator path)
cslf_run(sample ${scene} -o box.vti)

# Checks that a number in the last JSON lies in a range.
function (expect_json_between least most)
  expect_json_at_least(${least} ${ARGN})
  string(JSON actual GET "${output}" ${ARGN})
  if (actual GREATER "${most}")
    message(FATAL_ERROR "${ARGN} is ${actual}, above ${most}:\n${output}")
  endif ()
endfunction ()

set(coding --preset ultrafast --json)
cslf_run(encode box.vti -o box.mp4 ${coding} --target-ratio 80)
expect_json_between(77.6 82.4 ratio)
cslf_run(encode box.vti -o box.mkv ${coding} --target-size 25kB)
expect_json_between(24250 25750 bytes)
cslf_run(encode box.vti -o box.mkv ${coding} --target-size 24.4140625KiB)
expect_json_between(24250 25750 bytes)
# With depth of its own, the file has the field's colours at silhouettes, too.
cslf_run(encode box.vti -o box.mp4 ${coding} --target-psnr 36 --no-depth-from-geometry)
expect_json_between(35.7 36.3 psnr)
expect_json_between(1 50 crf)
cslf_run(compare box.mp4 box.vti --json)
expect_json_between(35.7 36.3 channels Color psnr)
cslf_run(sample ${scene} -o sampled.mp4 ${coding} --target-ratio 80)
expect_json_between(77.6 82.4 ratio)

cslf_run(encode box.vti -o keys.mp4 ${coding} --key-views 2)
expect_json(3 views)
expect_json(2 key_view_step)
cslf_run(info keys.mp4 --json)
expect_json(54 slices)
cslf_run(sample ${scene} -o sampled.mp4 ${coding} --key-views auto --target-novel-psnr 10)
expect_json_at_least(10 novel_psnr)
expect_json_at_least(2 key_view_step)
cslf_run(evaluate keys.mp4 cornell-box --views 1 --size 32 --spp 256 --max-depth 2 --json)
expect_json_at_least(10 lookups depth psnr)

cslf_fail("cannot be met" x encode box.vti -o x.mp4 --target-size 1)
cslf_fail("xb unit not recognized" x encode box.vti -o x.mp4 --target-size 5XB)
cslf_fail("cannot be met" x encode box.vti -o x.mp4 --target-psnr 99)
cslf_fail("no key views reach" x
  encode box.vti -o x.mp4 --key-views auto --target-novel-psnr 99)
cslf_fail("must be 1 to 4" x encode box.vti -o x.mp4 --key-views 5)
cslf_fail("key-views auto" x encode box.vti -o x.mp4 --key-views 2 --target-novel-psnr 30)
cslf_fail("excludes" x encode box.vti -o x.mp4 --crf 20 --target-psnr 30)
cslf_fail("excludes" x encode box.vti -o x.mp4 --target-size 1M --target-psnr 30)
cslf_fail("lossless" x encode box.vti -o x.mp4 --lossless --target-psnr 30)
cslf_fail("need a video" "x.vti" sample ${scene} -o x.vti --target-psnr 30)
cslf_fail("estimate" x sample ${scene} -o x.mp4 --estimate --target-psnr 30)
