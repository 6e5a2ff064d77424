# SPDX-FileCopyrightText: Copyright (c) CSLF contributors
# SPDX-License-Identifier: BSD-3-Clause

# CPack runs this before it makes the Debian package, to add files for Debian only. Debian's policy
# requires a changelog and the licence below share/doc.
set(root "${CPACK_TEMPORARY_INSTALL_DIRECTORY}${CPACK_PACKAGING_INSTALL_PREFIX}/share")
set(doc "${root}/doc/${CPACK_PACKAGE_NAME}")
file(READ "${CMAKE_CURRENT_LIST_DIR}/copyright" copyright)
file(STRINGS "${CPACK_RESOURCE_FILE_LICENSE}" lines)
foreach (line IN LISTS lines)
  if (line STREQUAL "")
    set(line ".")
  endif ()
  string(APPEND copyright " ${line}\n")
endforeach ()
file(WRITE "${doc}/copyright" "${copyright}")

string(TIMESTAMP date "%a, %d %b %Y %H:%M:%S +0000" UTC)
file(WRITE "${doc}/changelog" "${CPACK_PACKAGE_NAME} (${CPACK_PACKAGE_VERSION}) unstable; urgency=medium

  * Package made by CPack. CHANGELOG.md in the source tells what changed.

 -- ${CPACK_PACKAGE_CONTACT}  ${date}
")
set(manual "${root}/man/man1/cslf.1")
foreach (file IN ITEMS "${doc}/changelog" "${manual}")
  if (EXISTS "${file}")
    execute_process(COMMAND gzip -9 --no-name --force "${file}" COMMAND_ERROR_IS_FATAL ANY)
  endif ()
endforeach ()
# Debian's zsh looks for packages' completions in a folder of its own.
file(RENAME "${root}/zsh/site-functions" "${root}/zsh/vendor-completions")
file(MAKE_DIRECTORY "${root}/lintian/overrides")
file(COPY_FILE "${CMAKE_CURRENT_LIST_DIR}/lintian-overrides"
  "${root}/lintian/overrides/${CPACK_PACKAGE_NAME}")
