# SPDX-FileCopyrightText: Copyright (c) CSLF contributors
# SPDX-License-Identifier: BSD-3-Clause

# A video's parts besides the light field: added, listed and extracted again.
include("${CMAKE_CURRENT_LIST_DIR}/cslfToolTesting.cmake")

# Checks that two files have the same bytes.
function (expect_same_bytes first second)
  file(SHA256 "${DIRECTORY}/${first}" one)
  file(SHA256 "${DIRECTORY}/${second}" other)
  if (NOT one STREQUAL other)
    message(FATAL_ERROR "${first} and ${second} differ.")
  endif ()
endfunction ()

file(WRITE "${DIRECTORY}/notes.txt" "Two lines,\nthe second of them short\n")
file(WRITE "${DIRECTORY}/a=b:c.csv" "x,y\n1,2\n")
file(WRITE "${DIRECTORY}/empty" "")
string(REPEAT "0123456789abcdef" 800000 large)
file(WRITE "${DIRECTORY}/large" "${large}")

set(scene cornell-box -M 2 -N 16 --spp 1 --max-depth 1 --integrator path --preset ultrafast
  --geometry-triangles 0)
cslf_run(sample ${scene} -o plain.vti)
cslf_run(sample ${scene} -o box.mp4 --part notes=text/plain:notes.txt --part "=text/csv:a=b:c.csv"
  --part "mesh=model/ply:${DATA}/dragon.ply")
cslf_run(info box.mp4 --json)
expect_json(notes parts 0 name)
expect_json(text/plain parts 0 type)
expect_json(36 parts 0 bytes)
expect_json("" parts 1 name)
expect_json(text/csv parts 1 type)
cslf_run(compare box.mp4 plain.vti --json)
expect_json_at_least(25 channels Color psnr)

cslf_run(decode box.mp4 --part notes -o out.txt --json)
expect_json(out.txt output)
expect_json(notes name)
expect_json(text/plain type)
expect_json(36 bytes)
expect_same_bytes(notes.txt out.txt)
cslf_run(decode box.mp4 --part =text/csv -o out.csv)
expect_same_bytes("a=b:c.csv" out.csv)
# Any bytes, over an earlier file.
cslf_run(decode box.mp4 -o out.txt --part mesh)
file(COPY_FILE "${DATA}/dragon.ply" "${DIRECTORY}/dragon.ply")
expect_same_bytes(dragon.ply out.txt)

# When a video is coded again, it keeps its parts, except for those that are replaced.
cslf_run(encode box.mp4 -o again.mkv --preset ultrafast --part notes=text/plain:empty
  --part notes=text/csv:a=b:c.csv)
cslf_run(info again.mkv --json)
string(JSON count LENGTH "${output}" parts)
if (NOT count EQUAL 4)
  message(FATAL_ERROR "There are ${count} parts: ${output}")
endif ()
cslf_run(decode again.mkv --part notes=text/plain -o out)
expect_same_bytes(empty out)
cslf_run(decode again.mkv --part notes=text/csv -o out)
expect_same_bytes("a=b:c.csv" out)
cslf_run(decode again.mkv --part mesh -o out)
expect_same_bytes(dragon.ply out)
cslf_warn(1 "larger" resample box.mp4 -o coarse.mp4 --geometry-triangles 100000 --preset ultrafast)
cslf_run(decode coarse.mp4 --part notes -o out)
expect_same_bytes(notes.txt out)
# The parts do not change the field itself.
cslf_run(encode plain.vti -o without.mkv --lossless)
cslf_run(encode plain.vti -o with.mkv --lossless --part notes=text/plain:notes.txt)
cslf_run(compare with.mkv without.mkv --json)
expect_json(ON channels Color equal)

# Parts that cannot be added: then nothing is sampled.
set(encode encode plain.vti -o x.mp4 --preset ultrafast)
foreach (option IN ITEMS notes notes.txt notes=notes.txt notes=text/plain notes=:notes.txt
    notes=text/plain:)
  cslf_fail("NAME=TYPE:FILE" "x" ${encode} --part ${option})
endforeach ()
cslf_fail("Cannot read missing.txt: No such file" "x" ${encode} --part a=b:missing.txt)
file(MAKE_DIRECTORY "${DIRECTORY}/folder")
cslf_fail("Cannot read folder: Is a directory" "x" ${encode} --part a=b:folder)
cslf_fail("12 MiB in total.*does not fit" "x" ${encode} --part a=b:large)
cslf_fail("12 MiB in total.*does not fit" "x" sample ${scene} -o x.mkv --part a=b:large)
string(REPEAT "a" 101 long)
cslf_fail("at most 100 bytes" "x" ${encode} --part ${long}=b:notes.txt)
cslf_fail("two parts \"a\" .b." "x" ${encode} --part a=b:notes.txt --part a=b:empty)
cslf_fail("need a video" "x" sample ${scene} -o x.vti --part a=b:notes.txt)
cslf_fail("--part" "x" ${encode} --part)

# Parts that cannot be extracted.
cslf_fail("no part \"mash\" but \"notes\" .text/plain., \"\" .text/csv., \"mesh\"" "x"
  decode box.mp4 --part mash -o x)
cslf_fail("more than one part \"notes\".*NAME=TYPE" "x" decode again.mkv --part notes -o x)
cslf_fail("has no parts" "x" decode without.mkv --part notes -o x)
cslf_fail("has no parts" "x" decode plain.vti --part notes -o x)
cslf_fail("Cannot write nowhere/x" "x" decode box.mp4 --part notes -o nowhere/x)
cslf_fail("it is a folder" "x" decode box.mp4 --part notes -o folder)
cslf_fail("are the same" "x" decode box.mp4 --part notes -o box.mp4)
