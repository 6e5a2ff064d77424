# SPDX-FileCopyrightText: Copyright (c) CSLF contributors
# SPDX-License-Identifier: BSD-3-Clause

# Makes the viewer of exported pages: one script of the modules here, and the page. Both become
# strings of the library.
set(web "${CSLF_SOURCE_DIR}/Web")
set(web_modules geometry colors camera surfaces picture viewer)
set(web_encoding "${CSLF_SOURCE_DIR}/Rendering/Shaders/cslfEncoding.glsl")
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS
  "${web}/page.html" "${web}/viewer.css" "${web_encoding}")

# Leaves out comments that fill lines, and white space at the beginning of lines.
function (cslf_squeeze variable)
  string(REGEX REPLACE "/\\*\\*([^*]|\\*[^/])*\\*/" "" text "${${variable}}")
  string(REGEX REPLACE "(^|\n)[ \t]*//[^\n]*" "\\1" text "${text}")
  string(REGEX REPLACE "\n[ \t\n]+" "\n" text "${text}")
  set(${variable} "${text}" PARENT_SCOPE)
endfunction ()

set(web_viewer "")
foreach (module IN LISTS web_modules)
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS "${web}/${module}.js")
  file(READ "${web}/${module}.js" web_text)
  # One script has neither imports nor exports.
  string(REGEX REPLACE "(^|\n)import [^;]*;" "\\1" web_text "${web_text}")
  string(REGEX REPLACE "(^|\n)export " "\\1" web_text "${web_text}")
  string(APPEND web_viewer "${web_text}")
endforeach ()
file(READ "${web_encoding}" web_text)
string(REPLACE "@cslfEncoding@" "${web_text}" web_viewer "${web_viewer}")
cslf_squeeze(web_viewer)
file(READ "${web}/page.html" web_page)
file(READ "${web}/viewer.css" web_text)
string(REPLACE "@cslfStyle@" "${web_text}" web_page "${web_page}")
string(REPLACE "@PROJECT_VERSION@" "${PROJECT_VERSION}" web_page "${web_page}")

set(web_cslfPage "${web_page}")
set(web_cslfPageViewer "${web_viewer}")
foreach (name IN ITEMS cslfPage cslfPageViewer)
  set(web_file "${CMAKE_CURRENT_BINARY_DIR}/Web/${name}.txt")
  file(CONFIGURE OUTPUT "${web_file}" CONTENT "${web_${name}}" @ONLY)
  vtk_encode_string(
    INPUT "${web_file}"
    NAME "${name}"
    HEADER_OUTPUT web_header
    SOURCE_OUTPUT web_source)
  list(APPEND sources "${web_source}")
  list(APPEND private_headers "${web_header}")
endforeach ()
