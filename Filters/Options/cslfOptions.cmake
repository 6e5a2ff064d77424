# SPDX-FileCopyrightText: Copyright (c) CSLF contributors
# SPDX-License-Identifier: BSD-3-Clause

# Reads the table of options, cslfOptions.json. For a row NAME, it sets the variables NAME_DEFAULT,
# NAME_RANGE (attributes of ParaView's domains) and NAME_HELP (a sentence) for configure_file, and
# it appends the row in C++ to cslf_option_rows. A row without minimum or maximum has no limit. If
# the useful range is smaller than the permitted one, "slider" is that of ParaView's panel. Without
# a second value, there is no slider.

# Sets the variables `name`, `type` and so on to the fields of a row, or to empty texts.
macro (cslf_read_fields table row)
  foreach (field IN ITEMS name type default minimum maximum slider help key flag)
    string(JSON "${field}" ERROR_VARIABLE missing GET "${table}" "${row}" "${field}")
    if (missing)
      set("${field}" "")
    endif ()
  endforeach ()
endmacro ()

# Sets `default` as ParaView's XML has it, and `value` as C++ has it.
macro (cslf_convert_default)
  set(value "${default}")
  if (type STREQUAL "vector")
    string(REGEX REPLACE "[][ \n]" "" default "${default}")
    # CMake writes 17 digits.
    string(REGEX REPLACE "([.][0-9]*[1-9])00000000+1" "\\1" default "${default}")
    string(REPLACE "," ", " value "{ ${default} }")
    string(REPLACE "," " " default "${default}")
  elseif (type STREQUAL "bool" AND default)
    set(default 1)
    set(value "true")
  elseif (type STREQUAL "bool")
    set(default 0)
    set(value "false")
  elseif (type STREQUAL "string")
    set(value "\"${default}\"")
  endif ()
endmacro ()

# Sets `range` as ParaView's XML has it.
macro (cslf_convert_range)
  set(low "${minimum}")
  set(high "${maximum}")
  if (NOT slider STREQUAL "")
    string(JSON low GET "${slider}" 0)
    string(JSON high ERROR_VARIABLE missing GET "${slider}" 1)
    if (missing)
      set(high "")
    endif ()
  endif ()
  if (type STREQUAL "vector" AND NOT slider STREQUAL "")
    set(low "${low} ${low} ${low}")
    set(high "${high} ${high} ${high}")
  endif ()
  set(range "")
  if (NOT low STREQUAL "")
    string(APPEND range " min=\"${low}\"")
  endif ()
  if (NOT high STREQUAL "")
    string(APPEND range " max=\"${high}\"")
  endif ()
endmacro ()

# Sets `kind` and `limits`, the type of the row in C++ and the range in its initializer.
macro (cslf_convert_type)
  set(limits "")
  if (type STREQUAL "string")
    set(kind "Option<const char*>")
  elseif (type STREQUAL "bool")
    set(kind "Option<bool>")
  elseif (type STREQUAL "vector")
    set(kind "Option<std::array<double, 3>>")
  else ()
    set(kind "NumberOption<${type}>")
    if (minimum STREQUAL "")
      set(minimum "std::numeric_limits<${type}>::lowest()")
    endif ()
    if (maximum STREQUAL "")
      set(maximum "std::numeric_limits<${type}>::max()")
    endif ()
    set(limits "${minimum}, ${maximum}, ")
  endif ()
endmacro ()

function (cslf_read_options file)
  file(READ "${file}" table)
  set(rows "")
  string(JSON count LENGTH "${table}")
  math(EXPR last "${count} - 1")
  foreach (row RANGE "${last}")
    cslf_read_fields("${table}" "${row}")
    cslf_convert_default()
    cslf_convert_range()
    cslf_convert_type()
    string(APPEND rows
      "/// ${help}\n"
      "constexpr ${kind} ${name}{ \"${name}\", ${value},\n"
      "  ${limits}\"${help}\",\n  \"${key}\", \"${flag}\" };\n")
    string(SUBSTRING "${help}" 0 1 first)
    string(SUBSTRING "${help}" 1 -1 rest)
    string(TOUPPER "${first}" first)
    set("${name}_DEFAULT" "${default}" PARENT_SCOPE)
    set("${name}_RANGE" "${range}" PARENT_SCOPE)
    set("${name}_HELP" "${first}${rest}." PARENT_SCOPE)
  endforeach ()
  set(cslf_option_rows "${rows}" PARENT_SCOPE)
endfunction ()

if (NOT CMAKE_SCRIPT_MODE_FILE)
  set_property(DIRECTORY APPEND
    PROPERTY CMAKE_CONFIGURE_DEPENDS "${CMAKE_CURRENT_LIST_DIR}/cslfOptions.json")
endif ()
cslf_read_options("${CMAKE_CURRENT_LIST_DIR}/cslfOptions.json")
