# SPDX-FileCopyrightText: Copyright (c) CSLF contributors
# SPDX-License-Identifier: BSD-3-Clause

# Killed runs are resumed, and end with the bytes of an uninterrupted run.
include("${CMAKE_CURRENT_LIST_DIR}/cslfToolTesting.cmake")

set(scene cornell-box -M 5 -N 32 --spp 4 --max-depth 3 --integrator path --preset ultrafast)
execute_process(
  COMMAND "${UTILITIES}/measure-restart.sh" "${CSLF}" 4 "${DIRECTORY}/kills" sample ${scene}
  RESULT_VARIABLE result
  OUTPUT_VARIABLE output
  ERROR_VARIABLE output)
if (NOT result STREQUAL "0")
  message(FATAL_ERROR "Killing and restarting ended with ${result}:\n${output}")
endif ()
message("${output}")

# Starts a run and kills it as soon as some of its parts are complete.
function (cslf_kill file)
  cslf_kill_at(group-3-color.part ${file} ${ARGN})
endfunction ()

# The versions that a run depends on.
cslf_kill(versions.mp4 sample ${scene})
file(READ "${DIRECTORY}/versions.mp4.partial/manifest.json" manifest)
foreach (name IN ITEMS cslf ffmpeg)
  string(JSON version GET "${manifest}" ${name})
  if (version STREQUAL "")
    message(FATAL_ERROR "The manifest is ${manifest}")
  endif ()
endforeach ()

# Runs the tool, which must succeed with one line on standard error that matches `pattern`, and give
# the bytes of `expected`.
function (cslf_expect_bytes pattern expected file)
  execute_process(
    COMMAND "${CSLF}" ${ARGN} -o ${file}
    WORKING_DIRECTORY "${DIRECTORY}"
    RESULT_VARIABLE result
    OUTPUT_QUIET
    ERROR_VARIABLE error)
  if (NOT result STREQUAL "0" OR NOT error MATCHES "${pattern}")
    message(FATAL_ERROR "cslf ${ARGN}\nended with ${result}, and said: ${error}")
  endif ()
  file(SHA256 "${DIRECTORY}/${expected}" wanted)
  file(SHA256 "${DIRECTORY}/${file}" actual)
  if (NOT actual STREQUAL wanted)
    message(FATAL_ERROR "cslf ${ARGN}\ngave other bytes than ${expected}.")
  endif ()
  if (EXISTS "${DIRECTORY}/${file}.partial")
    message(FATAL_ERROR "cslf ${ARGN}\nleft ${file}.partial.")
  endif ()
  file(REMOVE "${DIRECTORY}/${file}")
endfunction ()

# A part damaged by hand is coded again.
set(slow cornell-box -M 5 -N 32 --spp 8 --max-depth 3 --integrator path --preset ultrafast)
cslf_run(sample ${slow} -o slow.mp4)

# Interrupted by Ctrl+C. The next run tells what it resumes.
execute_process(
  COMMAND bash -c "set -m; '${CSLF}' \"$@\" -o cut.mp4 &
    while kill -0 $! && ! [ -e cut.mp4.partial/group-3-color.part ]; do sleep 0.01; done
    kill -INT $!; wait $!" bash sample ${slow}
  WORKING_DIRECTORY "${DIRECTORY}"
  RESULT_VARIABLE result
  ERROR_VARIABLE error)
if (NOT result STREQUAL "130" OR NOT error MATCHES "cslf: interrupted: rerun to resume\n")
  message(FATAL_ERROR "An interrupted run ended with ${result}: ${error}")
endif ()
# In a terminal: the phase, but no time before it is known.
find_program(script script)
if (script AND CMAKE_HOST_SYSTEM_NAME STREQUAL "Linux")
  list(JOIN slow " " line)
  execute_process(
    COMMAND "${script}" -q -e -c "'${CSLF}' sample ${line} -o cut.mp4 --json" /dev/null
    WORKING_DIRECTORY "${DIRECTORY}"
    RESULT_VARIABLE result
    OUTPUT_VARIABLE output)
  if (NOT result STREQUAL "0" OR output MATCHES "  0 %, " OR NOT output MATCHES "[A-Z][a-z ]+ \\[#* +\\] +[0-9]+ %" OR
      NOT output MATCHES "cslf: resuming an interrupted run: [1-9][0-9]* of [1-9][0-9]* groups")
    message(FATAL_ERROR "In a terminal, the rerun ended with ${result}: ${output}")
  endif ()
  string(REGEX MATCH "{\r?\n.*}" output "${output}")
  string(REPLACE "\r" "" output "${output}")
  expect_json_at_least(1 resumed_groups)
endif ()
file(REMOVE_RECURSE "${DIRECTORY}/cut.mp4" "${DIRECTORY}/cut.mp4.partial")
cslf_kill(killed.mp4 sample ${slow})
file(APPEND "${DIRECTORY}/killed.mp4.partial/group-1-color.part" "x")
file(WRITE "${DIRECTORY}/killed.mp4.partial/group-2-color.part" "")
cslf_expect_bytes("^cslf: warning: [^\n]*2 group[^\n]*damaged[^\n]*sampled again[^\n]*\n$" slow.mp4 killed.mp4
  sample ${slow})

# If only some of a group's parts exist, as after a kill between them, nothing is damaged.
cslf_kill(killed.mp4 sample ${slow})
file(REMOVE "${DIRECTORY}/killed.mp4.partial/group-0-color.part"
  "${DIRECTORY}/killed.mp4.partial/group-1-depth.part")
cslf_expect_bytes("^$" slow.mp4 killed.mp4 sample ${slow})

# Other parameters, another scene, or --no-restart: from the beginning.
cslf_run(sample ${slow} --seed 1 -o seed.mp4)
cslf_kill(killed.mp4 sample ${slow})
cslf_expect_bytes("^cslf: warning: [^\n]*discarded[^\n]*\n$" seed.mp4 killed.mp4
  sample ${slow} --seed 1)
file(WRITE "${DIRECTORY}/scene.obj" "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 1\nf 1 2 3\nf 1 3 4\n")
set(triangles scene.obj -M 5 -N 32 --spp 32 --integrator path --preset ultrafast)
cslf_kill(killed.mp4 sample ${triangles})
file(WRITE "${DIRECTORY}/scene.obj" "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 1\nf 1 2 3\nf 2 3 4\n")
cslf_run(sample ${triangles} -o other.mp4)
cslf_expect_bytes("^cslf: warning: [^\n]*discarded[^\n]*\n$" other.mp4 killed.mp4
  sample ${triangles})
cslf_kill(killed.mp4 sample ${slow})
cslf_expect_bytes("^$" seed.mp4 killed.mp4 sample ${slow} --seed 1 --no-restart)

# A run that was killed as soon as it had made the folder, or the lock in it, leaves nothing either.
set(short cornell-box -M 2 -N 16 --spp 1 --max-depth 1 --integrator path --preset ultrafast)
cslf_run(sample ${short} -o short.mp4)
file(MAKE_DIRECTORY "${DIRECTORY}/killed.mp4.partial")
cslf_expect_bytes("^$" short.mp4 killed.mp4 sample ${short})
file(WRITE "${DIRECTORY}/killed.mp4.partial/cslf.lock" "")
cslf_expect_bytes("^$" short.mp4 killed.mp4 sample ${short})

# A run that is killed while it makes its cache begins the cache again. A run that is killed later
# finds the cache complete, unless it is damaged or belongs to another scene.
set(cached cornell-box -M 3 -N 16 --spp 32 --cache-samples 64 --cache-spacing 0.05
  --cache-tolerance 0.05 --preset ultrafast)
cslf_run(sample ${cached} -o cached.mp4)
cslf_kill_at(cslf.lock killed.mp4 sample ${cached})
cslf_expect_bytes("^$" cached.mp4 killed.mp4 sample ${cached})
cslf_kill_at(radiance.cache killed.mp4 sample ${cached})
cslf_run(sample ${cached} -o killed.mp4 --json)
expect_json(0 cost cache_rays)
file(SHA256 "${DIRECTORY}/killed.mp4" actual)
file(SHA256 "${DIRECTORY}/cached.mp4" wanted)
if (NOT actual STREQUAL wanted OR EXISTS "${DIRECTORY}/killed.mp4.partial")
  message(FATAL_ERROR "A kept cache gave other bytes, or was left.")
endif ()
file(REMOVE "${DIRECTORY}/killed.mp4")
file(REMOVE_RECURSE "${DIRECTORY}/killed.mp4.partial")
cslf_kill_at(radiance.cache killed.mp4 sample ${cached})
file(MAKE_DIRECTORY "${DIRECTORY}/kept")
file(COPY_FILE "${DIRECTORY}/killed.mp4.partial/radiance.cache" "${DIRECTORY}/kept/radiance.cache")
file(COPY_FILE "${DIRECTORY}/killed.mp4.partial/cslf.lock" "${DIRECTORY}/kept/cslf.lock")
file(APPEND "${DIRECTORY}/killed.mp4.partial/radiance.cache" "x")
cslf_expect_bytes("^cslf: warning: [^\n]*cache[^\n]*damaged[^\n]*\n$" cached.mp4 killed.mp4
  sample ${cached})
cslf_run(sample ${cached} --max-depth 2 -o shallow.mp4)
file(MAKE_DIRECTORY "${DIRECTORY}/killed.mp4.partial")
file(COPY_FILE "${DIRECTORY}/kept/radiance.cache" "${DIRECTORY}/killed.mp4.partial/radiance.cache")
file(COPY_FILE "${DIRECTORY}/kept/cslf.lock" "${DIRECTORY}/killed.mp4.partial/cslf.lock")
cslf_expect_bytes("^$" shallow.mp4 killed.mp4 sample ${cached} --max-depth 2)
# A run that fails before anything is known of the field leaves what it found.
file(MAKE_DIRECTORY "${DIRECTORY}/killed.mp4.partial")
file(COPY_FILE "${DIRECTORY}/kept/radiance.cache" "${DIRECTORY}/killed.mp4.partial/radiance.cache")
file(COPY_FILE "${DIRECTORY}/kept/cslf.lock" "${DIRECTORY}/killed.mp4.partial/cslf.lock")
cslf_fail("must strictly contain" "" sample ${cached} --center 5 5 5 --edges 1 -o killed.mp4)
if (NOT EXISTS "${DIRECTORY}/killed.mp4.partial/radiance.cache")
  message(FATAL_ERROR "A run that failed removed the cache that another had left.")
endif ()
cslf_run(sample ${cached} -o killed.mp4 --json)
expect_json(0 cost cache_rays)
