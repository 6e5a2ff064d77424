# SPDX-FileCopyrightText: Copyright (c) CSLF contributors
# SPDX-License-Identifier: BSD-3-Clause

# Videos carry a certificate, which agrees with `evaluate` and is verified: damage and other scenes
# are found.
include("${CMAKE_CURRENT_LIST_DIR}/cslfToolTesting.cmake")

# The mean square difference in billionths, which are whole numbers, of a PSNR in dB.
function (to_square psnr result)
  execute_process(
    COMMAND awk "BEGIN { printf \"%.0f\", 1e9 * 10 ^ (-0.1 * ${psnr}) }"
    OUTPUT_VARIABLE square)
  set("${result}" "${square}" PARENT_SCOPE)
endfunction ()

set(scene terrain -M 2 -N 32 --quality preview)
cslf_run(sample ${scene} -o terrain.mp4 --threads 2)
cslf_run(sample ${scene} -o single.mp4 --threads 1)
file(SHA256 "${DIRECTORY}/terrain.mp4" two)
file(SHA256 "${DIRECTORY}/single.mp4" one)
if (NOT one STREQUAL two)
  message(FATAL_ERROR "The number of threads changed the file.")
endif ()
cslf_run(info terrain.mp4)
if (NOT output MATCHES "\ncertificate +[0-9.]+ dB [^\n]*4096 rays of 256 samples, seed 0")
  message(FATAL_ERROR "cslf info does not show the certificate: ${output}")
endif ()
cslf_run(info terrain.mp4 --json)
expect_json(4096 certificate rays)
string(JSON hash GET "${output}" sampling scene)
expect_json("${hash}" certificate scene)
# As it is written: CMake would change the digits.
string(REGEX MATCH "\"psnr\": ([0-9.]+)" found "${output}")
set(psnr "${CMAKE_MATCH_1}")
cslf_run(verify terrain.mp4)
if (NOT output MATCHES "^terrain.mp4: ${psnr}[0-9]* dB ")
  message(FATAL_ERROR "cslf verify says: ${output}")
endif ()

# The same rays have the same result, others nearly.
cslf_run(verify terrain.mp4 terrain --json)
foreach (key IN ITEMS mean mean_square psnr seed)
  string(JSON certified GET "${output}" certificate ${key})
  expect_json("${certified}" measured ${key})
endforeach ()
cslf_run(verify terrain.mp4 terrain --json --seed 3 --rays 2000 --samples 100)
expect_json(3 measured seed)
expect_json(2000 measured rays)
expect_json(128 measured samples)
expect_json(256 certificate samples)

# Novel views have the same mean square, but for their number and that of the rays.
cslf_run(evaluate terrain.mp4 terrain --views 4 --size 256 --spp 16 --lookups geometry --json)
set(squares 0)
foreach (view RANGE 3)
  string(JSON view_psnr GET "${output}" lookups geometry psnr_of_views ${view})
  to_square("${view_psnr}" square)
  math(EXPR squares "${squares} + ${square}")
endforeach ()
to_square("${psnr}" certified)
math(EXPR of_views "${squares} / 4")
math(EXPR least "${of_views} / 2")
math(EXPR most "${of_views} * 2")
message(STATUS "certificate ${certified}, views ${of_views}")
if (certified LESS least OR certified GREATER most)
  message(FATAL_ERROR "The certificate has ${certified} e-9, novel views have ${of_views} e-9.")
endif ()

# Another exposure makes the same scene brighter than the field shows it.
cslf_fail("terrain.mp4 is not as good as it was: the field has [0-9.]+ dB, not ${psnr}" ""
  verify terrain.mp4 terrain --exposure 1.3)
# Other scenes.
cslf_fail("another scene[^\n]*${hash}" "" verify terrain.mp4 cornell-box)
cslf_fail("another scene" "" verify terrain.mp4 terrain --metallic 1)

# Fields without a certificate.
cslf_run(sample ${scene} -o without.mp4 --no-certificate)
cslf_run(info without.mp4)
if (output MATCHES "certificate")
  message(FATAL_ERROR "There is a certificate: ${output}")
endif ()
cslf_fail("without.mp4 has no certificate" "" verify without.mp4)
cslf_fail("without.mp4 has no certificate to compare with. Measured: [0-9.]+ dB" ""
  verify without.mp4 terrain)
cslf_run(encode terrain.mp4 -o again.mp4)
cslf_fail("again.mp4 has no certificate" "" verify again.mp4)

# Interrupted runs have the certificate of an uninterrupted one.
cslf_kill_at(group-0-color.part killed.mp4 sample cornell-box -M 3 -N 32 --quality preview)
cslf_run(sample cornell-box -M 3 -N 32 --quality preview -o killed.mp4)
cslf_run(sample cornell-box -M 3 -N 32 --quality preview -o whole.mp4)
file(SHA256 "${DIRECTORY}/killed.mp4" killed)
file(SHA256 "${DIRECTORY}/whole.mp4" whole)
if (NOT killed STREQUAL whole)
  message(FATAL_ERROR "The resumed run has other bytes.")
endif ()
