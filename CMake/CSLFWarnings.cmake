# SPDX-FileCopyrightText: Copyright (c) CSLF contributors
# SPDX-License-Identifier: BSD-3-Clause

# Warnings are errors for sources in this folder and those below it. They include VTK's warnings of
# functions that a future version removes.
if (CSLF_WARNINGS_AS_ERRORS)
  add_compile_options(
    "$<$<COMPILE_LANG_AND_ID:CXX,GNU,Clang,AppleClang>:-Wall;-Wextra;-Wshadow;-Werror>"
    "$<$<COMPILE_LANG_AND_ID:CXX,MSVC>:/W4;/WX>")
endif ()

# For a folder of generated sources, which we cannot change.
macro (cslf_ignore_warnings)
  set_property(DIRECTORY PROPERTY COMPILE_OPTIONS "")
endmacro ()
