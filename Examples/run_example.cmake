# SPDX-FileCopyrightText: Copyright (c) CSLF contributors
# SPDX-License-Identifier: BSD-3-Clause

# Runs an example: -DCOMMAND=<list> [-DPICTURE=<name> -DEXPECTED=<file> -DLEAST=<dB> -DCSLF=<tool>].
# Its picture must be similar, by the PSNR that -DCSLF measures, to that of the same example with
# more viewpoints and texels.
cmake_policy(VERSION 3.22)
if (PICTURE)
  file(REMOVE "${PICTURE}")
endif ()
execute_process(COMMAND ${COMMAND} COMMAND_ERROR_IS_FATAL ANY)
if (PICTURE AND CSLF)
  execute_process(
    COMMAND "${CSLF}" compare "${PICTURE}" "${EXPECTED}" --json
    OUTPUT_VARIABLE json
    COMMAND_ERROR_IS_FATAL ANY)
  string(JSON psnr GET "${json}" psnr)
  message("${PICTURE}: ${psnr} dB")
  if (psnr LESS LEAST)
    message(FATAL_ERROR "${PICTURE} is not like ${EXPECTED}: ${psnr} dB, less than ${LEAST}")
  endif ()
endif ()
