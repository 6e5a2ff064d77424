# SPDX-FileCopyrightText: Copyright (c) CSLF contributors
# SPDX-License-Identifier: BSD-3-Clause

# Makes the files that the documentation's commands need: box.mp4, box.vti, dragon.mp4 and
# dragon.ply in DIRECTORY, with the tool CSLF and from the test data in DATA.
cmake_policy(VERSION 3.22)
file(REMOVE_RECURSE "${DIRECTORY}")
file(MAKE_DIRECTORY "${DIRECTORY}")
file(COPY "${DATA}/dragon.ply" DESTINATION "${DIRECTORY}")

function (cslf_run)
  execute_process(
    COMMAND "${CSLF}" ${ARGN}
    WORKING_DIRECTORY "${DIRECTORY}"
    OUTPUT_QUIET
    COMMAND_ERROR_IS_FATAL ANY)
endfunction ()
set(cache --cache-samples 64 --cache-tolerance 0.06)
cslf_run(sample cornell-box -M 3 -N 32 --spp 4 ${cache} -o box.vti)
cslf_run(encode box.vti -o box.mp4 --preset ultrafast)
cslf_run(sample dragon.ply --metallic 1 --roughness 0.3 --base-color 0.9 0.7 0.3 -M 3 -N 32 --spp 4
  ${cache} -o dragon.mp4 --preset ultrafast)
