# SPDX-FileCopyrightText: Copyright (c) CSLF contributors
# SPDX-License-Identifier: BSD-3-Clause

# Processors that compute differently are detected. QEMU simulates them.
include("${CMAKE_CURRENT_LIST_DIR}/cslfToolTesting.cmake")

find_program(QEMU qemu-x86_64)
if (NOT QEMU)
  message("qemu-x86_64 (qemu-user) is not installed.")
  return ()
endif ()

set(scene sample cornell-box -M 2 -N 8 --spp 2 --threads 1 --integrator path)
cslf_run(${scene} -o here.vti --json)
string(JSON here GET "${output}" sampling arithmetic)
cslf_run(${scene} --seed 5 -o again.vti --json)
expect_json("${here}" sampling arithmetic)

# Without fused multiply-adds, and with them.
set(known "${here}")
foreach (processor IN ITEMS Nehalem Haswell-noTSX)
  execute_process(
    COMMAND "${QEMU}" -cpu ${processor} "${CSLF}" ${scene} -o ${processor}.vti --json
    WORKING_DIRECTORY "${DIRECTORY}"
    RESULT_VARIABLE result
    OUTPUT_VARIABLE output
    ERROR_QUIET)
  if (NOT result STREQUAL "0")
    message(FATAL_ERROR "QEMU's ${processor} ended with ${result}.")
  endif ()
  string(JSON there GET "${output}" sampling arithmetic)
  if (there IN_LIST known)
    message(FATAL_ERROR "QEMU's ${processor} has the arithmetic ${there} of another processor.")
  endif ()
  list(APPEND known "${there}")
endforeach ()
