# SPDX-FileCopyrightText: Copyright (c) CSLF contributors
# SPDX-License-Identifier: BSD-3-Clause

# Makes the Debian package of the build tree BUILD, unpacks it to an empty folder, and uses its
# contents: the tool, the Python package, and the CMake package in a program that finds it.
cmake_policy(VERSION 3.22)
foreach (program IN ITEMS dpkg dpkg-deb dpkg-shlibdeps file)
  find_program(found_${program} "${program}")
  if (NOT found_${program})
    message("${program} is not installed")
    return ()
  endif ()
endforeach ()
file(REMOVE_RECURSE "${DIRECTORY}")
file(MAKE_DIRECTORY "${DIRECTORY}")

function (run)
  execute_process(
    COMMAND ${ARGN}
    WORKING_DIRECTORY "${DIRECTORY}"
    OUTPUT_VARIABLE output
    ERROR_VARIABLE error
    RESULT_VARIABLE result)
  if (NOT result STREQUAL "0")
    message(FATAL_ERROR "${ARGN}\nended with ${result}:\n${output}\n${error}")
  endif ()
  set(output "${output}" PARENT_SCOPE)
endfunction ()

function (expect pattern)
  if (NOT output MATCHES "${pattern}")
    message(FATAL_ERROR "No \"${pattern}\" in:\n${output}")
  endif ()
endfunction ()

run("${CPACK}" --config "${BUILD}/CPackConfig.cmake" -B "${DIRECTORY}"
  -D "CPACK_PACKAGE_CONTACT=CSLF contributors <contributors@cslf.invalid>")
file(GLOB package "${DIRECTORY}/cslf_*.deb")
find_program(LINTIAN lintian)
if (LINTIAN)
  # Nobody can have the address above.
  run("${LINTIAN}" --allow-root --fail-on error,warning --suppress-tags bogus-mail-host
    "${package}")
else ()
  message("The package is not checked by lintian, as there is none.")
endif ()
run(dpkg-deb --field "${package}")
message("${output}")
expect("Package: cslf\n")
expect("Version: ${VERSION}")
expect("\nDepends: [^\n]*libavcodec[^\n]*libembree[^\n]*libvtk")
run(dpkg-deb --extract "${package}" installed)
set(prefix "${DIRECTORY}/installed/usr")

run("${prefix}/bin/cslf" --version)
expect("${VERSION}")
run("${prefix}/bin/cslf" --help)
expect("sample")
# Each command is in the manual page.
string(REGEX MATCHALL "\n  [a-z][a-z-]+  " commands "${output}")
run(gzip --decompress --stdout "${prefix}/share/man/man1/cslf.1.gz")
string(REPLACE "\\-" "-" output "${output}")
foreach (command IN LISTS commands)
  string(STRIP "${command}" command)
  expect("\n.B ${command}\n")
endforeach ()
foreach (file IN ITEMS bash-completion/completions/cslf zsh/vendor-completions/_cslf
    fish/vendor_completions.d/cslf.fish)
  file(READ "${prefix}/share/${file}" output)
  expect("evaluate")
endforeach ()
run("${CMAKE_COMMAND}" -E env --unset=LD_LIBRARY_PATH "${prefix}/bin/cslf" sample cornell-box
  -M 2 -N 16 --spp 1 -o box.vti)
if (PYTHON)
  run("${CMAKE_COMMAND}" -E env "PYTHONPATH=${prefix}/lib/python3/dist-packages"
    "${PYTHON}" -c "from cslf import __file__ as f, vtkCSLFSampler as s
print(f, s().GetViewpoints())")
  expect("installed/usr/lib/python3/dist-packages/cslf/__init__.py 17")
endif ()
run("${CMAKE_COMMAND}" -S "${SOURCE}" -B find "-DCMAKE_PREFIX_PATH=${prefix}" "-DVERSION=${VERSION}"
  "-DVTK_DIR=${VTK_DIR}" "-DCMAKE_CXX_COMPILER=${COMPILER}")
expect("CSLF ${VERSION} in ${prefix}/")
