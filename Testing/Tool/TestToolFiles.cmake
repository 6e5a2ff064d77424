# SPDX-FileCopyrightText: Copyright (c) CSLF contributors
# SPDX-License-Identifier: BSD-3-Clause

# Whatever the tool writes, it does not change files that it has not made.
include("${CMAKE_CURRENT_LIST_DIR}/cslfToolTesting.cmake")

cslf_run(sample cornell-box -o field.vti -M 2 -N 16 --spp 1 --max-depth 1)

# Files that could be mistaken for temporary files of an output of that name.
function (make_neighbours name)
  foreach (suffix IN ITEMS writable replaced unfinished partial.old)
    file(WRITE "${DIRECTORY}/${name}.${suffix}" "thesis")
  endforeach ()
  file(WRITE "${DIRECTORY}/${name}.partial/thesis" "thesis")
endfunction ()

# They must still exist, and nothing else but the output.
function (expect_neighbours name)
  file(GLOB all RELATIVE "${DIRECTORY}" "${DIRECTORY}/${name}.*" "${DIRECTORY}/${name}.partial/*")
  list(REMOVE_ITEM all ${name}.partial)
  list(SORT all)
  set(expected)
  foreach (suffix IN ITEMS partial.old partial/thesis replaced unfinished writable)
    list(APPEND expected "${name}.${suffix}")
  endforeach ()
  list(SORT expected)
  if (NOT all STREQUAL expected)
    message(FATAL_ERROR "Beside ${name} are ${all}, not ${expected}.")
  endif ()
endfunction ()

# Runs the tool, which must succeed with a warning that its folder could not be removed.
function (run_with_word output)
  cslf_warn(1 "${output}.partial was not removed, because it contains other files: thesis.\n$" ${ARGN})
endfunction ()

set(outputs copy.vti folder.d scene.obj)
set(copy.vti decode field.vti)
set(folder.d decode field.vti)
set(scene.obj export cornell-box)
if (HAS_ENCODER)
  list(APPEND outputs video.mp4)
  set(video.mp4 encode field.vti --preset ultrafast)
endif ()
foreach (output IN LISTS outputs)
  set(name ${output})
  if (output STREQUAL "folder.d")
    set(name folder)
  endif ()
  make_neighbours(${name})
  run_with_word(${name} ${${output}} -o ${name})
  # Again, over the existing output.
  run_with_word(${name} ${${output}} -o ${name})
  expect_neighbours(${name})
endforeach ()

# A folder with other files than those of a light field.
file(WRITE "${DIRECTORY}/folder/notes.txt" "thesis")
cslf_fail("contains other files than a light field: notes.txt" "" decode field.vti -o folder)
file(READ "${DIRECTORY}/folder/notes.txt" notes)
if (NOT notes STREQUAL "thesis")
  message(FATAL_ERROR "The notes are gone.")
endif ()

# The tool neither replaces nor waits for anything that is not a file.
find_program(MKFIFO mkfifo)
if (MKFIFO)
  execute_process(COMMAND "${MKFIFO}" pipe.vti pipe.png WORKING_DIRECTORY "${DIRECTORY}")
  file(CREATE_LINK pipe.vti "${DIRECTORY}/linked.vti" SYMBOLIC)
  file(CREATE_LINK nowhere.vti "${DIRECTORY}/dangling.vti" SYMBOLIC)
  foreach (name IN ITEMS pipe linked dangling)
    cslf_fail("already exists and is not a file" "${name}.vti.partial" decode field.vti -o ${name}.vti)
  endforeach ()
  cslf_fail("already exists and is not a file" "" render field.vti -o pipe.png --size 8 8)
  cslf_fail("no file or folder pipe.vti" "" info pipe.vti)
  foreach (name IN ITEMS pipe.vti pipe.png)
    execute_process(COMMAND test -p ${name} WORKING_DIRECTORY "${DIRECTORY}" RESULT_VARIABLE result)
    if (NOT result STREQUAL "0")
      message(FATAL_ERROR "The pipe ${name} is gone.")
    endif ()
  endforeach ()
endif ()

# Another process writes it. The lock is that of flock(1).
find_program(FLOCK flock)
if (FLOCK)
  file(REMOVE_RECURSE "${DIRECTORY}/folder" "${DIRECTORY}/folder.partial")
  foreach (name IN ITEMS copy.vti folder)
    file(REMOVE_RECURSE "${DIRECTORY}/${name}.partial")
    file(WRITE "${DIRECTORY}/${name}.partial/cslf.lock"
      "CSLF: a light field is being written here.\n")
    execute_process(
      COMMAND "${FLOCK}" -n ${name}.partial/cslf.lock "${CSLF}" decode field.vti -o ${name}
      WORKING_DIRECTORY "${DIRECTORY}"
      RESULT_VARIABLE result
      ERROR_VARIABLE error)
    if (result STREQUAL "0" OR NOT error MATCHES
        "^cslf: error: [^\n]*another process is writing it[^\n]*\n$")
      message(FATAL_ERROR "A second writer of ${name} ended with ${result}: ${error}")
    endif ()
  endforeach ()
endif ()

# Files that cannot grow beyond 1 kB: some of VTK's writers do not notice.
find_program(BASH bash)
if (BASH)
  foreach (arguments IN ITEMS "decode field.vti -o big.vti" "export cornell-box -o big.obj")
    execute_process(
      COMMAND "${BASH}" -c "ulimit -f 1; trap '' XFSZ; '${CSLF}' ${arguments}"
      WORKING_DIRECTORY "${DIRECTORY}"
      RESULT_VARIABLE result
      ERROR_VARIABLE error)
    file(GLOB left "${DIRECTORY}/big.*")
    if (NOT result STREQUAL "1" OR NOT error MATCHES "^cslf: error: [^\n]*File too large[^\n]*\n$" OR left)
      message(FATAL_ERROR "cslf ${arguments}\nended with ${result}, left ${left}, and said: ${error}")
    endif ()
  endforeach ()
endif ()

# Files have the permissions that the umask leaves them, and those of the file that they replace.
find_program(STAT stat)
if (BASH AND STAT AND NOT APPLE)
  # Runs the tool under a umask.
  function (run_under umask)
    execute_process(
      COMMAND "${BASH}" -c "umask ${umask}; exec \"$@\"" bash "${CSLF}" ${ARGN}
      WORKING_DIRECTORY "${DIRECTORY}"
      RESULT_VARIABLE result
      OUTPUT_QUIET
      ERROR_VARIABLE error)
    if (NOT result STREQUAL "0")
      message(FATAL_ERROR "cslf ${ARGN}\nended with ${result}: ${error}")
    endif ()
  endfunction ()
  function (expect_mode mode name)
    execute_process(
      COMMAND "${STAT}" -c %a "${name}"
      WORKING_DIRECTORY "${DIRECTORY}"
      OUTPUT_VARIABLE found
      OUTPUT_STRIP_TRAILING_WHITESPACE)
    if (NOT found STREQUAL mode)
      message(FATAL_ERROR "${name} has the mode ${found}, not ${mode}.")
    endif ()
  endfunction ()
  function (set_mode mode name)
    execute_process(COMMAND chmod ${mode} "${name}" WORKING_DIRECTORY "${DIRECTORY}")
  endfunction ()
  set(outputs mode.vti mode.obj mode.png)
  set(mode.vti decode field.vti)
  set(mode.obj export cornell-box)
  set(mode.png trace cornell-box --size 8 8 --spp 1)
  if (HAS_ENCODER)
    list(APPEND outputs mode.mp4)
    set(mode.mp4 encode field.vti --preset ultrafast)
  endif ()
  foreach (name IN LISTS outputs)
    run_under(027 ${${name}} -o ${name})
    expect_mode(640 ${name})
    foreach (mode IN ITEMS 600 444 664)
      set_mode(${mode} ${name})
      run_under(022 ${${name}} -o ${name})
      expect_mode(${mode} ${name})
    endforeach ()
  endforeach ()

  # A folder and the images in it.
  file(REMOVE_RECURSE "${DIRECTORY}/modes")
  run_under(007 decode field.vti -o modes)
  expect_mode(770 modes)
  file(GLOB images RELATIVE "${DIRECTORY}" "${DIRECTORY}/modes/*")
  list(GET images 0 image)
  expect_mode(660 "${image}")
  set_mode(2750 modes)
  set_mode(600 "${image}")
  run_under(022 decode field.vti -o modes)
  expect_mode(2750 modes)
  expect_mode(600 "${image}")
  list(GET images 1 image)
  expect_mode(660 "${image}")

  # The folder in which a killed run was writing is open to the same users as the rest.
  if (HAS_ENCODER)
    foreach (mode IN ITEMS 775 700)
      if (mode STREQUAL "700")
        file(WRITE "${DIRECTORY}/shared.mp4" "private")
        set_mode(600 shared.mp4)
      endif ()
      file(REMOVE_RECURSE "${DIRECTORY}/shared.mp4.partial")
      execute_process(
        COMMAND "${BASH}" -c
          "umask 002; '${CSLF}' encode field.vti --preset veryslow -o shared.mp4 & \
          until compgen -G 'shared.mp4.partial/unfinished-*' > found; do :; done; \
          kill -9 $!; wait; stat -c %a shared.mp4.partial shared.mp4.partial/unfinished-*"
        WORKING_DIRECTORY "${DIRECTORY}"
        OUTPUT_VARIABLE found
        ERROR_QUIET)
      if (NOT found STREQUAL "${mode}\n${mode}\n")
        message(FATAL_ERROR "The folders of a killed run have the modes ${found}, not ${mode}.")
      endif ()
    endforeach ()
  endif ()
endif ()
