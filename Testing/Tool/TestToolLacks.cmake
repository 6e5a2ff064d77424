# SPDX-FileCopyrightText: Copyright (c) CSLF contributors
# SPDX-License-Identifier: BSD-3-Clause

# A missing decoder, a lack of memory or a name that is taken gives one error. LACKS is the library
# that takes it away.
include("${CMAKE_CURRENT_LIST_DIR}/cslfToolTesting.cmake")

set(field "${DATA}/field.mp4")

# Runs the tool without the resources that `lacks` names. Sets `result`, `output` and `error`.
function (run_without lacks)
  separate_arguments(lacks)
  list(REMOVE_ITEM lacks "")
  list(TRANSFORM lacks PREPEND CSLF_LACKS_)
  execute_process(
    COMMAND "${CMAKE_COMMAND}" -E env "LD_PRELOAD=${LACKS}" ${lacks} "${CSLF}" ${ARGN}
    WORKING_DIRECTORY "${DIRECTORY}"
    RESULT_VARIABLE result
    OUTPUT_VARIABLE output
    ERROR_VARIABLE error)
  foreach (name IN ITEMS result output error)
    set("${name}" "${${name}}" PARENT_SCOPE)
  endforeach ()
endfunction ()

foreach (command IN ITEMS info "decode -o x" "compare ${field}")
  separate_arguments(command)
  list(POP_FRONT command name)
  run_without(DECODER=hevc ${name} "${field}" ${command})
  if (NOT result STREQUAL "1" OR NOT error MATCHES
      "^cslf: error: Cannot read [^\n]*field.mp4: this FFmpeg has no decoder for hevc.\n$")
    message(FATAL_ERROR "Without a decoder, ${name} ended with ${result}: ${error}")
  endif ()
endforeach ()
run_without(DECODER=av1 info "${field}" --json)
expect_json(0 missing)

# Memory runs out at any time: while the file is opened, checked or decoded, by two threads.
set(succeeded 0)
set(failed 0)
foreach (count IN ITEMS 1 5 18 40 60 135 200 300 100000)
  run_without(MEMORY=${count} compare "${field}" "${field}" --threads 2)
  if (result STREQUAL "0" AND error STREQUAL "")
    math(EXPR succeeded "${succeeded} + 1")
  elseif (result STREQUAL "1" AND error MATCHES "^cslf: error: [^\n]*not enough memory.\n$")
    math(EXPR failed "${failed} + 1")
  else ()
    message(FATAL_ERROR "With memory for ${count} arrays, comparing ended with ${result}: ${error}")
  endif ()
endforeach ()
message("Memory was too little ${failed} times, enough ${succeeded} times")
if (failed LESS 5 OR succeeded LESS 1)
  message(FATAL_ERROR "Memory was not taken away as meant.")
endif ()

# And while threads write images: the error names the missing file.
foreach (count IN ITEMS 260 350 400 450)
  run_without(MEMORY=${count} decode "${field}" -o images --threads 2)
  if (NOT result STREQUAL "1" OR EXISTS "${DIRECTORY}/images" OR
      NOT error MATCHES "cslf: error: (Cannot read [^\n]*field.mp4|images was not written): [^\n]*\n$")
    message(FATAL_ERROR "With memory for ${count} arrays, decoding ended with ${result}: ${error}")
  endif ()
endforeach ()

# What gets the name of a field or a picture while they are made stays: on all kinds of file systems.
if (HAS_ENCODER)
  file(WRITE "${DIRECTORY}/plain.obj" "v -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\nf 1 2 3\nf 1 3 4\n")
  set(small plain.obj -M 2 -N 16 --spp 1 --max-depth 1 --threads 2)
  foreach (lacks IN ITEMS "" "FLAGS=1" "FLAGS=1 LINKS=1")
    foreach (name IN ITEMS plain.png plain.mp4)
      file(REMOVE "${DIRECTORY}/plain.png")
      run_without("NAME=${name} ${lacks}" sample ${small})
      file(READ "${DIRECTORY}/${name}" text)
      if (NOT result STREQUAL "1" OR NOT text STREQUAL "mine" OR
          NOT error MATCHES "^cslf: error: [^\n]*${name}[^\n]*: a file of that name has appeared meanwhile[^\n]*\n$")
        message(FATAL_ERROR "With ${name} taken (${lacks}), sampling ended with ${result}: ${error}")
      endif ()
      file(REMOVE "${DIRECTORY}/${name}")
    endforeach ()
    # The message names the groups, which are found when the name is free again.
    if (NOT error MATCHES "; [1-9][0-9]* of [1-9][0-9]* groups of viewpoints are kept in plain.mp4.partial, and")
      message(FATAL_ERROR "The field was lost: ${error}")
    endif ()
    run_without("${lacks}" sample ${small} --json)
    if (NOT result STREQUAL "0" OR NOT error STREQUAL "" OR EXISTS "${DIRECTORY}/plain.mp4.partial")
      message(FATAL_ERROR "With the name free again, sampling ended with ${result}: ${error}")
    endif ()
    expect_json_at_least(1 resumed_groups)
    file(REMOVE "${DIRECTORY}/plain.mp4")
  endforeach ()
endif ()
