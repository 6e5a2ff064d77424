# SPDX-FileCopyrightText: Copyright (c) CSLF contributors
# SPDX-License-Identifier: BSD-3-Clause

# The help of all commands of cslf and cslf-lab, and the completion of cslf in shells.
include("${CMAKE_CURRENT_LIST_DIR}/cslfToolTesting.cmake")

set(tool_cslf "${CSLF}")
set(tool_cslf-lab "${LAB}")

# Checks the help of a program, or of one of its commands: in plain words, in lines of at most 80
# characters, with examples that the parser accepts. Sets `help`.
function (check_help program command)
  execute_process(
    COMMAND "${tool_${program}}" ${command} --help
    OUTPUT_VARIABLE help
    RESULT_VARIABLE result)
  if (NOT result STREQUAL "0" OR help MATCHES "INT|FLOAT|{false}| in \\[[0-9.e+-]+ - |POSITIVE|>=|\\(\\)|;[ \n]*\\)|\n\n\n")
    message(FATAL_ERROR "The help of ${program} ${command} has signs of the parser:\n${help}")
  endif ()
  string(REPEAT "[^\n]" 81 long_line)
  string(REGEX MATCH "${long_line}" long "${help}")
  if (long)
    message(FATAL_ERROR "The help of ${program} ${command} has a line of more than 80 characters: ${long}")
  endif ()
  if (NOT help MATCHES "\nExamples?:\n  ${program} " AND NOT help MATCHES "\nExamples:\n  source")
    message(FATAL_ERROR "The help of ${program} ${command} has no example:\n${help}")
  endif ()
  # All arguments are right up to the last, which is unknown.
  string(REGEX MATCHALL "\n  ${program} [^\n|]+" examples "${help}")
  foreach (example IN LISTS examples)
    string(REGEX REPLACE "^\n  ${program} | \\| .*" "" example "${example}")
    separate_arguments(arguments UNIX_COMMAND "${example}")
    execute_process(
      COMMAND "${tool_${program}}" ${arguments} --unknown-option
      WORKING_DIRECTORY "${DIRECTORY}"
      ERROR_VARIABLE error)
    if (NOT error MATCHES "^${program}: error: [^\n]*not expected: --unknown-option\n$")
      message(FATAL_ERROR "The example ${program} ${example} is wrong: ${error}")
    endif ()
  endforeach ()
  set(help "${help}" PARENT_SCOPE)
endfunction ()

# Checks the help of a program and of all its commands, of which there must be so many.
function (check_program program expected)
  check_help(${program} "")
  string(REGEX MATCH "\nCommands:\n(.*)\nExample" list "${help}")
  string(REGEX MATCHALL "(^|\n)  [a-z-]+" commands "${CMAKE_MATCH_1}")
  list(TRANSFORM commands STRIP)
  list(LENGTH commands count)
  if (NOT count EQUAL expected)
    message(FATAL_ERROR "There are ${count} commands, not ${expected}: ${commands}")
  endif ()
  foreach (command IN LISTS commands)
    check_help(${program} "${command}")
  endforeach ()
  # Without a command, the help is an error. Other ways to ask for it.
  set(CSLF "${tool_${program}}")
  cslf_run(help)
  execute_process(
    COMMAND "${CSLF}"
    RESULT_VARIABLE result
    OUTPUT_VARIABLE nothing
    ERROR_VARIABLE error)
  if (NOT result STREQUAL "1" OR nothing OR NOT error STREQUAL output)
    message(FATAL_ERROR "${program} ended with ${result}: ${nothing}${error}")
  endif ()
  set(text "${output}")
  cslf_run(help help)
  if (NOT output STREQUAL text)
    message(FATAL_ERROR "${program} help help is not ${program} help:\n${output}")
  endif ()
  # There is no help of a command that does not exist.
  foreach (arguments IN ITEMS "help nonsense" "nonsense --help" "nonsense")
    separate_arguments(arguments)
    cslf_fail("There is no command nonsense; see ${program} --help" "" ${arguments})
  endforeach ()
  cslf_fail("There is no option --nonsense" "" help --nonsense)
endfunction ()

check_program(cslf 15)
if (HAS_ENCODER)
  check_program(cslf-lab 6)
else ()
  check_program(cslf-lab 4)
endif ()
check_help(cslf sample)
cslf_run(help sample)
if (NOT output STREQUAL help)
  message(FATAL_ERROR "cslf help sample is not cslf sample --help:\n${output}")
endif ()
foreach (text IN ITEMS
    "-M, --viewpoints NUMBER\n      the number of viewpoints along each side of a face (2 to 1024; default 17)\n"
    "  --quality NAME\n" "(preview,\n      good, best; default good)\n" "--depth, --no-depth\n" "\nGeneral:\n  -h, --help\n")
  string(FIND "${help}" "${text}" place)
  if (place LESS 0)
    message(FATAL_ERROR "No \"${text}\" in:\n${help}")
  endif ()
endforeach ()

# Completion. Each shell completes the same lines; what it offers is sorted.
foreach (shell IN ITEMS bash zsh fish)
  execute_process(
    COMMAND "${CSLF}" completion ${shell}
    OUTPUT_FILE "${DIRECTORY}/completion.${shell}"
    RESULT_VARIABLE result)
  if (NOT result STREQUAL "0")
    message(FATAL_ERROR "cslf completion ${shell} ended with ${result}.")
  endif ()
endforeach ()
cslf_fail("shell" "" completion tcsh)
file(WRITE "${DIRECTORY}/field.mp4" "")
file(MAKE_DIRECTORY "${DIRECTORY}/folder")
set(lines
  "cslf res|resample"
  "cslf sample --qual|--quality"
  "cslf sample --quality |best good preview"
  "cslf sample --codec h|h264 hevc"
  "cslf evaluate --lookups b|bilinear"
  "cslf sample cornell|cornell-box"
  "cslf view field.mp4 --no-|"
  "cslf completion |bash fish zsh"
  "cslf info fie|field.mp4"
  "cslf evaluate --truth f|folder")
file(WRITE "${DIRECTORY}/complete.bash" [=[
source ./completion.bash
COMP_WORDS=($1)
[[ $1 != *' ' ]] || COMP_WORDS+=('')
COMP_CWORD=$((${#COMP_WORDS[@]} - 1))
_cslf
printf '%s\n' "${COMPREPLY[@]}"
]=])
file(WRITE "${DIRECTORY}/complete.fish" [=[
source completion.fish
complete --do-complete $argv[1] | string split --fields 1 \t
]=])
# Zsh completes in a terminal only.
file(WRITE "${DIRECTORY}/complete.zsh" [=[
zmodload zsh/zpty
zpty shell zsh -f -i
zpty -w shell 'PROMPT=; fpath=($PWD $fpath); autoload -Uz compinit; compinit -D -u; source ./completion.zsh'
zpty -w shell 'list() {
  compadd() {
    local -a found; builtin compadd -O found "$@"; builtin compadd "$@"
    local word; for word in $found; do print -r -- "<$word>" >> offered; done
  }
  _main_complete; unfunction compadd; print end >> offered
}
zle -C list complete-word list; bindkey "^T" list; print ready > offered'
for i in {1..300}; do [[ ! -s offered ]] || break; sleep 0.1; done
: > offered
zpty -w -n shell "$1"$'\C-T'
for i in {1..300}; do ! grep -q end offered || break; sleep 0.1; done
zpty -d shell
sed -n 's/^<\(.*\)>$/\1/p' offered | sort -u
rm offered
]=])
foreach (shell IN ITEMS bash fish zsh)
  find_program("found_${shell}" ${shell})
  if (NOT found_${shell})
    message("${shell} is not tested, as there is none.")
    continue ()
  endif ()
  foreach (line IN LISTS lines)
    string(REGEX MATCH "^([^|]*)\\|(.*)$" ignored "${line}")
    set(typed "${CMAKE_MATCH_1}")
    set(expected "${CMAKE_MATCH_2}")
    execute_process(
      COMMAND "${found_${shell}}" complete.${shell} "${typed}"
      WORKING_DIRECTORY "${DIRECTORY}"
      OUTPUT_VARIABLE offered
      ERROR_VARIABLE error)
    string(REGEX MATCHALL "[^\n]+" offered "${offered}")
    list(TRANSFORM offered REPLACE "/$" "")
    list(SORT offered)
    list(JOIN offered " " offered)
    if (NOT offered STREQUAL expected)
      message(FATAL_ERROR "${shell} completes \"${typed}\" by \"${offered}\", not \"${expected}\". ${error}")
    endif ()
  endforeach ()
endforeach ()
