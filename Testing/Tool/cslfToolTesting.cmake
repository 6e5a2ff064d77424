# SPDX-FileCopyrightText: Copyright (c) CSLF contributors
# SPDX-License-Identifier: BSD-3-Clause

# Common functions for tests of the tools cslf and cslf-lab. They are run with -DCSLF=<cslf>
# -DLAB=<cslf-lab> -DDATA=<folder of test data> -DUTILITIES=<folder of scripts> -DMPIEXEC=<mpiexec,
# if there is one> -DHAS_ENCODER=<whether the tools have the video encoder> -DDIRECTORY=<folder to
# work in>, which is emptied first.
cmake_policy(VERSION 3.22)
file(REMOVE_RECURSE "${DIRECTORY}")
file(MAKE_DIRECTORY "${DIRECTORY}")

# Runs the tool, which must succeed without messages on standard error. Sets `output` to its
# standard output.
function (cslf_run)
  execute_process(
    COMMAND "${CSLF}" ${ARGN}
    WORKING_DIRECTORY "${DIRECTORY}"
    RESULT_VARIABLE result
    OUTPUT_VARIABLE output
    ERROR_VARIABLE error)
  if (NOT result STREQUAL "0" OR NOT error STREQUAL "")
    message(FATAL_ERROR "cslf ${ARGN}\nended with ${result}: ${error}")
  endif ()
  set(output "${output}" PARENT_SCOPE)
endfunction ()

# Runs the tool, which must succeed with exactly `count` warnings, at least one of which matches
# `pattern`. Sets `output` to its standard output.
function (cslf_warn count pattern)
  execute_process(
    COMMAND "${CSLF}" ${ARGN}
    WORKING_DIRECTORY "${DIRECTORY}"
    RESULT_VARIABLE result
    OUTPUT_VARIABLE output
    ERROR_VARIABLE error)
  string(REGEX MATCHALL "\n" lines "${error}")
  list(LENGTH lines lines)
  if (NOT result STREQUAL "0" OR NOT error MATCHES "^(cslf: warning: [^\n]+\n)+$" OR
      NOT lines EQUAL count OR NOT error MATCHES "${pattern}")
    message(FATAL_ERROR "cslf ${ARGN}\nended with ${result}: ${error}")
  endif ()
  set(output "${output}" PARENT_SCOPE)
endfunction ()

# Runs the tool, which must end with that exit code and print exactly one line that matches
# `pattern`. It must leave nothing of `output`, unless that is empty.
function (cslf_end code pattern output)
  execute_process(
    COMMAND "${CSLF}" ${ARGN}
    WORKING_DIRECTORY "${DIRECTORY}"
    RESULT_VARIABLE result
    OUTPUT_VARIABLE text
    ERROR_VARIABLE error)
  if (NOT result STREQUAL "${code}")
    message(FATAL_ERROR "cslf ${ARGN}\nended with ${result}, not ${code}: ${error}")
  endif ()
  if (NOT error MATCHES "^cslf(-lab)?: error: [^\n]+\n$" OR NOT error MATCHES "${pattern}")
    message(FATAL_ERROR "cslf ${ARGN}\nsaid: ${error}")
  endif ()
  if (output)
    file(GLOB left "${DIRECTORY}/${output}*")
    if (left)
      message(FATAL_ERROR "cslf ${ARGN}\nleft ${left}")
    endif ()
  endif ()
endfunction ()

# The same with exit code 1.
function (cslf_fail pattern output)
  cslf_end(1 "${pattern}" "${output}" ${ARGN})
endfunction ()

# The same for cslf-lab.
function (lab_run)
  set(CSLF "${LAB}")
  cslf_run(${ARGN})
  set(output "${output}" PARENT_SCOPE)
endfunction ()
function (lab_end code pattern output)
  set(CSLF "${LAB}")
  cslf_end("${code}" "${pattern}" "${output}" ${ARGN})
endfunction ()
function (lab_fail pattern output)
  lab_end(1 "${pattern}" "${output}" ${ARGN})
endfunction ()

# Checks a value in the JSON that the last run printed: expect_json(expected key...)
function (expect_json expected)
  string(JSON actual ERROR_VARIABLE error GET "${output}" ${ARGN})
  if (error OR NOT actual STREQUAL "${expected}")
    message(FATAL_ERROR "${ARGN} is \"${actual}\", not \"${expected}\" ${error}:\n${output}")
  endif ()
endfunction ()

# Checks that a number in that JSON has a minimum.
function (expect_json_at_least least)
  string(JSON actual GET "${output}" ${ARGN})
  if (NOT actual GREATER_EQUAL "${least}")
    message(FATAL_ERROR "${ARGN} is ${actual}, below ${least}:\n${output}")
  endif ()
endfunction ()

# Starts a run and kills it as soon as a file of that name is among its parts. Tries again if that
# was too late.
function (cslf_kill_at name file)
  execute_process(
    COMMAND bash -c "
      for attempt in 1 2 3 4 5; do
        rm -f ${file}
        '${CSLF}' \"$@\" -o ${file} > log.txt 2>&1 &
        while kill -0 $! && ! [ -e ${file}.partial/${name} ]; do sleep 0.01; done
        kill -KILL $!
        wait $!
        if [ -e ${file}.partial/${name} ] && ! [ -e ${file} ]; then exit 0; fi
      done
      exit 1" bash ${ARGN}
    WORKING_DIRECTORY "${DIRECTORY}"
    RESULT_VARIABLE result
    ERROR_QUIET)
  if (NOT result STREQUAL "0")
    message(FATAL_ERROR "cslf ${ARGN} was not killed in the middle of its work.")
  endif ()
endfunction ()
