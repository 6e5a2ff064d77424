# SPDX-FileCopyrightText: Copyright (c) CSLF contributors
# SPDX-License-Identifier: BSD-3-Clause

# The code that writes files on Windows, compiled by MinGW and run by Wine. Called with SOURCE, the
# source folder, and DIRECTORY, an own folder.
find_program(COMPILER x86_64-w64-mingw32-g++-posix)
find_program(WINE NAMES wine64 wine PATHS /usr/lib/wine)
if (NOT COMPILER OR NOT WINE)
  message("Skipped: MinGW (g++-mingw-w64-x86-64-posix) and Wine (wine64) are not installed.")
  return()
endif ()
file(REMOVE_RECURSE "${DIRECTORY}")
file(MAKE_DIRECTORY "${DIRECTORY}/run")
# Nothing is exported from a single program.
file(WRITE "${DIRECTORY}/vtkCSLFModule.h" "#define VTKCSLF_EXPORT\n")
set(filters "${SOURCE}/Filters")
execute_process(
  COMMAND "${COMPILER}" -std=c++17 -Wall -Wextra -Werror -static
    "-I${DIRECTORY}" "-I${filters}"
    "${SOURCE}/Testing/Windows/TestWindowsFiles.cxx"
    "${SOURCE}/Applications/Console/cslfTerminal.cxx"
    "${filters}/Coding/Reading/cslfBackgroundThread.cxx"
    "${filters}/Files/Windows/cslfFileSystem.cxx"
    "${filters}/Files/Windows/cslfLockedFile.cxx"
    "${filters}/Files/cslfFileSystem.cxx"
    "${filters}/Files/cslfAtomicFile.cxx"
    "${filters}/Files/cslfWorkFolder.cxx"
    -o "${DIRECTORY}/TestWindowsFiles.exe"
  RESULT_VARIABLE result)
if (NOT result EQUAL 0)
  message(FATAL_ERROR "It does not compile.")
endif ()
execute_process(
  COMMAND "${CMAKE_COMMAND}" -E env "WINEPREFIX=${DIRECTORY}/wine" WINEDEBUG=-all
    "${WINE}" "${DIRECTORY}/TestWindowsFiles.exe"
  WORKING_DIRECTORY "${DIRECTORY}/run"
  RESULT_VARIABLE result)
if (NOT result EQUAL 0)
  message(FATAL_ERROR "It ended with ${result}.")
endif ()
