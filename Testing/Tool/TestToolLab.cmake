# SPDX-FileCopyrightText: Copyright (c) CSLF contributors
# SPDX-License-Identifier: BSD-3-Clause

# The errors of cslf-lab: one line each, and nothing half done. The other tests of it, which measure,
# are run at night.
include("${CMAKE_CURRENT_LIST_DIR}/cslfToolTesting.cmake")

set(tiny -M 2 -N 16 --spp 1 --max-depth 1)
cslf_run(sample cornell-box -o box.vti ${tiny})
file(WRITE "${DIRECTORY}/plain" "no light field\n")

lab_fail("no command dance; see cslf-lab --help" "" dance)
lab_fail("--update-rate" "x" render box.vti -o x --update-rate 1)
lab_fail("no file" "x" render nowhere.vti -o x)
lab_fail("no file" "x" render box.vti -o x --mesh nowhere.ply)
lab_fail("no file" "x" render box.vti nowhere.ply -o x)
lab_fail("no file" "x" opening nowhere.vti -o x)
lab_fail("path-spp" "x" sampler cornell-box --path-spp 4)
lab_fail("no file" "x" sampler nowhere.ply)
lab_fail("nowhere.vti" "" evaluate-texels nowhere.vti cornell-box)
lab_fail("plain is a file without an extension" "" evaluate-texels plain cornell-box)
if (HAS_ENCODER)
  lab_fail("vp9" "x/coded" codec box.vti -o x --codecs vp9 --crfs 20)
  lab_fail("no file" "y" codec missing.vti -o y)
  lab_fail("does not divide" "y" key-views box.vti cornell-box -o y --steps 3)
  lab_fail("16 or more" "y" key-views box.vti cornell-box -o y --steps 1 --divisors 4)
  lab_fail("need the scene" "y" key-views box.vti -o y)
endif ()

# A field with missing viewpoints.
cslf_run(sample cornell-box -o gap ${tiny})
file(REMOVE "${DIRECTORY}/gap/000003.Depth.png")
lab_end(2 "gap is damaged" "" evaluate-texels gap cornell-box)
