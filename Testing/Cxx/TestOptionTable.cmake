# SPDX-FileCopyrightText: Copyright (c) CSLF contributors
# SPDX-License-Identifier: BSD-3-Clause

# Makes the XML of the ParaView plugin from the table of options, without ParaView. Each @reference@
# must name a row of the table, and the result must have the row's default, range and help.
cmake_minimum_required(VERSION 3.22)
include("${SOURCE}/Filters/Options/cslfOptions.cmake")

function (expect what text part)
  string(FIND "${text}" "${part}" place)
  if (place EQUAL -1)
    message(SEND_ERROR "${what} lacks ${part}")
  endif ()
endfunction ()

foreach (kind IN ITEMS Filters Readers Writers Representations)
  set(template "${SOURCE}/ParaViewPlugin/CSLF${kind}.xml.in")
  file(READ "${template}" text)
  string(REGEX MATCHALL "@[A-Za-z_]+@" references "${text}")
  foreach (reference IN LISTS references)
    string(REPLACE "@" "" variable "${reference}")
    if (NOT DEFINED "${variable}")
      message(SEND_ERROR "${template}: ${reference} is not in the table of options.")
    endif ()
  endforeach ()
  configure_file("${template}" "${DIRECTORY}/CSLF${kind}.xml" @ONLY)
  file(READ "${DIRECTORY}/CSLF${kind}.xml" "${kind}")
endforeach ()

expect(CSLFFilters.xml "${Filters}" [[default_values="-1"]])
expect(CSLFFilters.xml "${Filters}"
  [[name="Quality" command="SetQuality" number_of_elements="1" default_values="0"]])
expect(CSLFFilters.xml "${Filters}" [[<DoubleRangeDomain name="range" min="1e-6" max="10"/>]])
expect(CSLFFilters.xml "${Filters}" [[default_values="0.2 0.2 0.2"]])
expect(CSLFFilters.xml "${Filters}" [[<DoubleRangeDomain name="range" min="0 0 0" max="1 1 1"/>]])
expect(CSLFFilters.xml "${Filters}" [[<IntRangeDomain name="range" min="0" max="65536"/>]])
expect(CSLFFilters.xml "${Filters}" [[<IntRangeDomain name="range"/>]])
expect(CSLFFilters.xml "${Filters}" [[<Documentation>The seed of all random numbers.</Documentation>]])
expect(CSLFWriters.xml "${Writers}" [[default_values="22"]])
expect(CSLFWriters.xml "${Writers}" [[default_values="hevc"]])
expect(CSLFWriters.xml "${Writers}" [[<DoubleRangeDomain name="range" min="0" max="51"/>]])
expect(CSLFWriters.xml "${Writers}" [[<DoubleRangeDomain name="range" min="0"/>]])
expect(CSLFWriters.xml "${Writers}" [[<String value="gbrp"/>]])
expect(CSLFRepresentations.xml "${Representations}" [[<Entry value="2" text="ACES"/>]])
expect(CSLFRepresentations.xml "${Representations}" [[property="LookupMode" values="3"/>]])
expect(CSLFReaders.xml "${Readers}" [[label="Allow Missing Viewpoints"]])
