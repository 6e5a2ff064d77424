# SPDX-FileCopyrightText: Copyright (c) CSLF contributors
# SPDX-License-Identifier: BSD-3-Clause

# A missing decoder or a lack of memory gives one error. LACKS is the library that takes it away.
include("${CMAKE_CURRENT_LIST_DIR}/cslfToolTesting.cmake")

set(field "${DATA}/field.mp4")

# Runs the tool without the resource named by `lack`. Sets `result`, `output` and `error`.
function (run_without lack)
  execute_process(
    COMMAND "${CMAKE_COMMAND}" -E env "LD_PRELOAD=${LACKS}" "CSLF_LACKS_${lack}" "${CSLF}" ${ARGN}
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
