# SPDX-FileCopyrightText: Copyright (c) CSLF contributors
# SPDX-License-Identifier: BSD-3-Clause

# Reads the table of options, cslfOptions.json. It writes each row NAME in C++ to cslf_option_rows,
# and as a property of ParaView's XML to NAME_PROPERTY. Parts of the property are NAME_DEFAULT,
# NAME_DOMAIN (which includes the documentation) and NAME_HELP (a sentence).
#
# Fields of a row:
#   name, help, key, flag   key is the name in JSON, flag that of the tool
#   type                    int, double, bool, string, vector, color or enum
#   default, preview        preview is the default in ParaView, if it differs
#   minimum, maximum        without them, there is no limit
#   slider                  the range in ParaView, if it is smaller; it need not have an end
#   values, texts           of an enum, and what ParaView shows instead; for a string, suggestions
#   label, advanced         of ParaView's panel
#   visible_if              a property, and its values for which the panel shows this one
#
# Lists are texts with commas. Vectors, and numbers that are not whole, are texts, too, because
# CMake would change their digits.

# Sets the variables `name`, `type` and so on to the fields of a row, or to empty texts.
macro (cslf_read_fields table row)
  foreach (field IN ITEMS name type default preview minimum maximum slider values texts label
      advanced visible_if key flag help)
    string(JSON "${field}" ERROR_VARIABLE missing GET "${table}" "${row}" "${field}")
    string(JSON json_type ERROR_VARIABLE ignored TYPE "${table}" "${row}" "${field}")
    if (missing)
      set("${field}" "")
    elseif (json_type STREQUAL "BOOLEAN")
      string(REPLACE "ON" 1 "${field}" "${${field}}")
      string(REPLACE "OFF" 0 "${field}" "${${field}}")
    elseif (json_type STREQUAL "NUMBER" AND NOT "${${field}}" MATCHES "^-?[0-9]+$")
      message(FATAL_ERROR "cslfOptions.json: ${field} of ${name} must be a text.")
    endif ()
  endforeach ()
  string(REPLACE "," ";" values "${values}")
  string(REPLACE "," ";" texts "${texts}")
  string(REPLACE "," ";" slider "${slider}")
endmacro ()

# Sets `element` and `size`, the type and the number of values of a property in ParaView's XML, and
# other fields that follow from the type. Defaults of an enum become their numbers.
macro (cslf_convert_row)
  set(element Double)
  set(size 1)
  if (type MATCHES "^(int|bool|enum)$")
    set(element Int)
  elseif (type STREQUAL "string")
    set(element String)
  elseif (type MATCHES "^(vector|color)$")
    set(size 3)
  endif ()
  if (type STREQUAL "color")
    set(minimum 0)
    set(maximum 1)
  elseif (type STREQUAL "enum")
    list(FIND values "${default}" default)
    if (NOT preview STREQUAL "")
      list(FIND values "${preview}" preview)
    endif ()
  endif ()
  if (texts STREQUAL "")
    set(texts "${values}")
  endif ()
endmacro ()

function (cslf_capitalize result text)
  string(SUBSTRING "${text}" 0 1 first)
  string(SUBSTRING "${text}" 1 -1 rest)
  string(TOUPPER "${first}" first)
  set("${result}" "${first}${rest}" PARENT_SCOPE)
endfunction ()

# Sets `cxx`, the row in C++.
macro (cslf_make_cxx)
  set(start "${name}{ \"${name}\", ${default},")
  set(end "\n  \"${help}\",\n  \"${key}\", \"${flag}\" }")
  if (type STREQUAL "bool")
    set(cxx "Option<bool> ${start}${end}")
  elseif (type STREQUAL "string")
    list(JOIN values ", " suggestions)
    set(cxx "TextOption ${name}{ { \"${name}\", \"${default}\",${end}, \"${suggestions}\" }")
  elseif (type STREQUAL "enum")
    list(LENGTH values count)
    list(JOIN values "\", \"" names)
    string(REPLACE "{" "{ {" start "${start}")
    set(cxx "EnumOption<${count}> ${start} 0, ${count} - 1,${end}, { { \"${names}\" } } }")
  elseif (size EQUAL 3)
    string(REPLACE " " ", " numbers "${default}")
    set(cxx "Option<std::array<double, 3>> ${name}{ \"${name}\", { ${numbers} },${end}")
  else ()
    set(low "${minimum}")
    set(high "${maximum}")
    if (low STREQUAL "")
      set(low "std::numeric_limits<${type}>::lowest()")
    endif ()
    if (high STREQUAL "")
      set(high "std::numeric_limits<${type}>::max()")
    endif ()
    set(cxx "NumberOption<${type}> ${start} ${low}, ${high},${end}")
  endif ()
endmacro ()

# Sets `range`, the attributes of a domain of numbers.
macro (cslf_make_range)
  set(low "${minimum}")
  set(high "${maximum}")
  if (NOT slider STREQUAL "")
    list(POP_FRONT slider low high)
  endif ()
  set(range "")
  if (NOT "${low}" STREQUAL "")
    string(APPEND range " min=\"${low}\"")
  endif ()
  if (NOT "${high}" STREQUAL "")
    string(APPEND range " max=\"${high}\"")
  endif ()
  if (size EQUAL 3)
    string(REGEX REPLACE "\"([^\"]+)\"" "\"\\1 \\1 \\1\"" range "${range}")
  endif ()
endmacro ()

# Sets `domain`, with the documentation, in ParaView's XML.
macro (cslf_make_domain)
  set(domain "")
  set(number 0)
  if (type STREQUAL "bool")
    set(domain "<BooleanDomain name=\"bool\"/>\n        ")
  elseif (type STREQUAL "enum")
    set(domain "<EnumerationDomain name=\"enum\">\n")
    foreach (text IN LISTS texts)
      cslf_capitalize(text "${text}")
      string(APPEND domain "          <Entry value=\"${number}\" text=\"${text}\"/>\n")
      math(EXPR number "${number} + 1")
    endforeach ()
    string(APPEND domain "        </EnumerationDomain>\n        ")
  elseif (type STREQUAL "string")
    list(TRANSFORM values REPLACE "(.+)" "          <String value=\"\\1\"/>\n")
    list(JOIN values "" strings)
    set(domain "<StringListDomain name=\"list\">\n${strings}        </StringListDomain>\n        ")
  else ()
    set(domain "<${element}RangeDomain name=\"range\"${range}/>\n        ")
  endif ()
  string(APPEND domain "<Documentation>${sentence}.</Documentation>")
endmacro ()

# Sets `property`, the whole property in ParaView's XML.
macro (cslf_make_property)
  set(property "<${element}VectorProperty name=\"${name}\" command=\"Set${name}\"")
  string(APPEND property " number_of_elements=\"${size}\" default_values=\"${default}\"")
  if (NOT label STREQUAL "")
    string(APPEND property " label=\"${label}\"")
  endif ()
  if (advanced)
    string(APPEND property " panel_visibility=\"advanced\"")
  endif ()
  if (type STREQUAL "color")
    string(APPEND property " panel_widget=\"color_selector\"")
  endif ()
  string(APPEND property ">\n        ${domain}\n")
  if (visible_if MATCHES "^([^ ]+) (.+)$")
    string(APPEND property
      "        <Hints>\n"
      "          <PropertyWidgetDecorator type=\"GenericDecorator\" mode=\"visibility\"\n"
      "            property=\"${CMAKE_MATCH_1}\" values=\"${CMAKE_MATCH_2}\"/>\n"
      "        </Hints>\n")
  endif ()
  string(APPEND property "      </${element}VectorProperty>")
endmacro ()

function (cslf_read_options file)
  file(READ "${file}" table)
  set(rows "")
  string(JSON count LENGTH "${table}")
  math(EXPR last "${count} - 1")
  foreach (row RANGE "${last}")
    cslf_read_fields("${table}" "${row}")
    cslf_convert_row()
    cslf_make_cxx()
    string(APPEND rows "/// ${help}\nconstexpr ${cxx};\n")
    if (NOT preview STREQUAL "")
      set(default "${preview}")
    endif ()
    cslf_capitalize(sentence "${help}")
    cslf_make_range()
    cslf_make_domain()
    cslf_make_property()
    set("${name}_DEFAULT" "${default}" PARENT_SCOPE)
    set("${name}_HELP" "${sentence}." PARENT_SCOPE)
    set("${name}_DOMAIN" "${domain}" PARENT_SCOPE)
    set("${name}_PROPERTY" "${property}" PARENT_SCOPE)
  endforeach ()
  set(cslf_option_rows "${rows}" PARENT_SCOPE)
endfunction ()

if (NOT CMAKE_SCRIPT_MODE_FILE)
  set_property(DIRECTORY APPEND
    PROPERTY CMAKE_CONFIGURE_DEPENDS "${CMAKE_CURRENT_LIST_DIR}/cslfOptions.json")
endif ()
cslf_read_options("${CMAKE_CURRENT_LIST_DIR}/cslfOptions.json")
