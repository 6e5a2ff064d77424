# SPDX-FileCopyrightText: Copyright (c) CSLF contributors
# SPDX-License-Identifier: BSD-3-Clause

# The tool under mpiexec: one file of the same bytes for any number of processes, also after a kill;
# one message and exit code 1 if a process fails.
include("${CMAKE_CURRENT_LIST_DIR}/cslfToolTesting.cmake")

set(scene cornell-box -M 5 -N 32 --spp 4 --max-depth 3 --integrator path --preset ultrafast --threads 1)
cslf_run(sample ${scene} -o one.mp4)
file(SHA256 "${DIRECTORY}/one.mp4" expected)

# Runs `command...` in that many processes. Sets `result`, `output` and `error`.
macro (cslf_run_parallel processes)
  execute_process(
    COMMAND "${MPIEXEC}" -n ${processes} ${ARGN}
    WORKING_DIRECTORY "${DIRECTORY}"
    RESULT_VARIABLE result
    OUTPUT_VARIABLE output
    ERROR_VARIABLE error)
endmacro ()

macro (cslf_expect_same file)
  if (NOT result STREQUAL "0" OR NOT error STREQUAL "")
    message(FATAL_ERROR "${file} ended with ${result}: ${error}")
  endif ()
  file(SHA256 "${DIRECTORY}/${file}" actual)
  if (NOT actual STREQUAL expected OR EXISTS "${DIRECTORY}/${file}.partial")
    message(FATAL_ERROR "${file} has other bytes than that of one process, or left its parts.")
  endif ()
endmacro ()

foreach (processes IN ITEMS 2 3)
  cslf_run_parallel(${processes} "${CSLF}" sample ${scene} -o ${processes}.mp4 --json)
  cslf_expect_same(${processes}.mp4)
  expect_json(5 views)
endforeach ()

# Several processes use what a killed process left.
execute_process(
  COMMAND bash -c "
    '${CSLF}' \"$@\" -o killed.mp4 > log.txt 2>&1 &
    while kill -0 $! && ! [ -e killed.mp4.partial/group-1-color.part ]; do sleep 0.01; done
    kill -KILL $!
    wait $!" bash sample ${scene}
  WORKING_DIRECTORY "${DIRECTORY}"
  ERROR_QUIET)
cslf_run_parallel(2 "${CSLF}" sample ${scene} -o killed.mp4)
cslf_expect_same(killed.mp4)

# Processes make the radiance cache together, and all use the cache of a killed one.
set(cached cornell-box -M 3 -N 16 --spp 4 --cache-samples 64 --cache-spacing 0.05
  --cache-tolerance 0.05 --preset ultrafast
  --threads 1)
cslf_run(sample ${cached} -o cached.mp4 --json)
string(JSON rays GET "${output}" cost cache_rays)
set(expected_of_paths "${expected}")
file(SHA256 "${DIRECTORY}/cached.mp4" expected)
foreach (processes IN ITEMS 2 3)
  cslf_run_parallel(${processes} "${CSLF}" sample ${cached} -o cached-${processes}.mp4 --json)
  cslf_expect_same(cached-${processes}.mp4)
  expect_json("${rays}" cost cache_rays)
endforeach ()
execute_process(
  COMMAND bash -c "
    for attempt in 1 2 3 4 5; do
      rm -f kept.mp4
      '${CSLF}' \"$@\" -o kept.mp4 > log.txt 2>&1 &
      while kill -0 $! && ! [ -e kept.mp4.partial/radiance.cache ]; do sleep 0.01; done
      kill -KILL $!
      wait $!
      if ! [ -e kept.mp4 ]; then exit 0; fi
    done" bash sample ${cached}
  WORKING_DIRECTORY "${DIRECTORY}"
  ERROR_QUIET)
cslf_run_parallel(3 "${CSLF}" sample ${cached} -o kept.mp4 --json)
cslf_expect_same(kept.mp4)
expect_json(0 cost cache_rays)
set(expected "${expected_of_paths}")

# Only the first process writes other formats.
cslf_run(decode one.mp4 -o one.vti)
cslf_run_parallel(2 "${CSLF}" encode one.vti -o again.mp4 --preset ultrafast)
if (NOT result STREQUAL "0" OR NOT EXISTS "${DIRECTORY}/again.mp4")
  message(FATAL_ERROR "Encoding ended with ${result}: ${error}")
endif ()
cslf_run_parallel(2 "${CSLF}" decode one.mp4 -o two.vti)
cslf_run(compare one.vti two.vti --json)
expect_json(ON channels Color equal)

# Checks that the last run failed with one message from the tool; mpiexec may add its own.
macro (cslf_expect_failure pattern)
  string(REGEX MATCHALL "cslf: error: [^\n]+" messages "${error}")
  list(LENGTH messages count)
  if (NOT result STREQUAL "1" OR NOT count EQUAL 1 OR NOT messages MATCHES "${pattern}")
    message(FATAL_ERROR "Instead of ${pattern}, the run ended with ${result}: ${error}")
  endif ()
  file(GLOB left "${DIRECTORY}/x*")
  if (left)
    message(FATAL_ERROR "The run left ${left}")
  endif ()
endmacro ()

cslf_run_parallel(3 "${CSLF}" sample ${scene} -o nowhere/x.mp4)
cslf_expect_failure("Cannot write")
cslf_run_parallel(3 "${CSLF}" sample missing.ply -o x.mp4)
cslf_expect_failure("missing.ply")
# Only one process fails: the last one, with another scene or none.
function (cslf_write_script name last)
  file(WRITE "${DIRECTORY}/${name}" "#!/usr/bin/env bash
if [ \"\${OMPI_COMM_WORLD_RANK:-\${PMI_RANK:-0}}\" = 2 ]; then
  set -- \"$@\" ${last}
fi
exec '${CSLF}' \"$@\"
")
  file(CHMOD "${DIRECTORY}/${name}" PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE)
endfunction ()
cslf_write_script(missing.sh missing.ply)
cslf_run_parallel(3 ./missing.sh sample ${scene} -o x.mp4)
cslf_expect_failure("missing.ply")
cslf_run_parallel(3 ./missing.sh sample ${cached} -o x.mp4)
cslf_expect_failure("missing.ply")
cslf_write_script(outside.sh "--center 5 5 5 --edges 1")
cslf_run_parallel(3 ./outside.sh sample ${cached} -o x.mp4)
cslf_expect_failure("must strictly contain")
cslf_write_script(other.sh "--seed 3")
cslf_run_parallel(3 ./other.sh sample ${cached} -o x.mp4)
cslf_expect_failure("different")
cslf_run_parallel(3 ./other.sh sample ${scene} -o x.mp4)
cslf_expect_failure("different")
