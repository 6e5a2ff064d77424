# SPDX-FileCopyrightText: Copyright (c) CSLF contributors
# SPDX-License-Identifier: BSD-3-Clause

# Names of files that are not UTF-8 or lack an extension, and numbers as people write them.
include("${CMAKE_CURRENT_LIST_DIR}/cslfToolTesting.cmake")

set(tiny -M 2 -N 16 --spp 1 --max-depth 1)
set(small --size 8 8 --spp 1 --max-depth 1)
cslf_run(sample cornell-box -o field.vti ${tiny})

# JSON shows a byte that is not UTF-8 as U+FFFD. Each line is a command whose option --json names
# the file x\377, and the key of that name.
string(ASCII 239 191 189 other)
function (run_with_bytes key extension)
  string(REPLACE ";" "' '" arguments "'${ARGN}'")
  string(REPLACE "@" "'\"$n\"'" arguments "${arguments}")
  execute_process(
    COMMAND bash -c "n=$(printf 'x\\377'); '${CSLF}' ${arguments} --json"
    WORKING_DIRECTORY "${DIRECTORY}"
    RESULT_VARIABLE result
    OUTPUT_VARIABLE output
    ERROR_VARIABLE error)
  if (NOT result STREQUAL "0" OR NOT error STREQUAL "")
    message(FATAL_ERROR "cslf ${ARGN}\nended with ${result}: ${error}")
  endif ()
  if (key)
    string(JSON name GET "${output}" ${key})
    if (NOT name STREQUAL "x${other}${extension}")
      message(FATAL_ERROR "cslf ${ARGN}\nnames ${name}")
    endif ()
  endif ()
endfunction ()
find_program(BASH bash)
set(tool "${CSLF}")
if (BASH)
  run_with_bytes(output .vti sample cornell-box -o @.vti ${tiny})
  run_with_bytes(output .png trace cornell-box -o @.png ${small})
  run_with_bytes(output "" decode @.vti -o @)
  run_with_bytes(output .c.vti resample @ -o @.c.vti --resolution-divisor 2)
  run_with_bytes(output .s.png sheet @.png -o @.s.png)
  run_with_bytes(output .obj export cornell-box -o @.obj)
  run_with_bytes("" "" info @.vti)
  run_with_bytes("" "" compare @.vti @)
  if (HAS_ENCODER)
    run_with_bytes(output .mp4 encode @.vti -o @.mp4 --preset ultrafast --part notes=text/plain:@.obj)
  endif ()
  if (DEFINED ENV{DISPLAY})
    run_with_bytes(output .r.png render @.vti -o @.r.png --size 8 8)
  endif ()
  set(CSLF "${LAB}")
  run_with_bytes("" "" evaluate-texels @.vti cornell-box --texels 4 --reference-spp 4)
  if (DEFINED ENV{DISPLAY})
    run_with_bytes("" "" opening @.vti -o @.bench --repeats 1 --size 8)
  endif ()
endif ()
set(CSLF "${tool}")

# A number may begin with a point.
set(wanted)
foreach (position IN ITEMS "1;-0.5;4" "1;-.5;4" "1;-5e-1;4" "+1;-.5e0;4.")
  cslf_run(trace cornell-box -o now.png ${small} --position ${position} --focal-point -.1 .1 -.1
    --view-up -.1 1 .0)
  file(MD5 "${DIRECTORY}/now.png" sum)
  if (wanted AND NOT sum STREQUAL wanted)
    message(FATAL_ERROR "From ${position} the picture is another one.")
  endif ()
  set(wanted ${sum})
endforeach ()
cslf_run(sample cornell-box -o center.vti ${tiny} --center -.5 -.25 -.125 --edges 4 .4e1 4)
cslf_run(info center.vti --json)
expect_json(-0.5 center 0)
expect_json(-0.125 center 2)
expect_json(4.0 edge)
cslf_fail("--exposure: Value -0.5 is not above 0" "none" sample cornell-box -o none.vti ${tiny} --exposure -.5)
cslf_fail("--center: Value nan is not a finite number" "none"
  sample cornell-box -o none.vti ${tiny} --center 0 nan 0 --edges 4)
cslf_fail("--position: Value 1e999 is not a finite number" "none"
  trace cornell-box -o none.png ${small} --position 0 1e999 0)

# A file without an extension is not a folder.
file(WRITE "${DIRECTORY}/plain" "no light field\n")
foreach (arguments IN ITEMS "info plain" "decode plain -o none" "resample plain -o none.vti --viewpoint-stride 2"
         "compare plain field.vti")
  separate_arguments(arguments)
  cslf_fail("plain is a file without an extension" "none" ${arguments})
endforeach ()
cslf_fail("plain is not a scene" "none" sample plain -o none.vti ${tiny})
cslf_fail("plain already exists and is not a folder" "" decode field.vti -o plain)
