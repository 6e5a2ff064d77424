# SPDX-FileCopyrightText: Copyright (c) CSLF contributors
# SPDX-License-Identifier: BSD-3-Clause

# Warnings as errors, of what is compiled in this folder and those below it. VTK's warnings of what a
# coming version removes are among them.
if (CSLF_WARNINGS_AS_ERRORS)
  add_compile_options(
    "$<$<COMPILE_LANG_AND_ID:CXX,GNU,Clang,AppleClang>:-Wall;-Wextra;-Wshadow;-Werror>"
    "$<$<COMPILE_LANG_AND_ID:CXX,MSVC>:/W4;/WX>")
endif ()

# For a folder of sources that a generator writes, which are not ours to mend.
macro (cslf_ignore_warnings)
  set_property(DIRECTORY PROPERTY COMPILE_OPTIONS "")
endmacro ()
