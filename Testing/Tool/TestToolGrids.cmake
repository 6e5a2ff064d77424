# SPDX-FileCopyrightText: Copyright (c) CSLF contributors
# SPDX-License-Identifier: BSD-3-Clause

# Data sets of VTK in all formats: the surface of a cube of two cells a side, coloured by its active
# scalars.
include("${CMAKE_CURRENT_LIST_DIR}/cslfToolTesting.cmake")

set(view --size 32 24 --spp 16 --max-depth 2)
set(points)
set(values)
foreach (z RANGE 2)
  foreach (y RANGE 2)
    foreach (x RANGE 2)
      string(APPEND points "${x} ${y} ${z} ")
      string(APPEND values "200 100 50 ")
    endforeach ()
  endforeach ()
endforeach ()
set(cells)
foreach (z RANGE 1)
  foreach (y RANGE 1)
    foreach (x RANGE 1)
      math(EXPR c "${x} + 3 * ${y} + 9 * ${z}")
      foreach (offset IN ITEMS 0 1 4 3 9 10 13 12)
        math(EXPR id "${c} + ${offset}")
        string(APPEND cells "${id} ")
      endforeach ()
    endforeach ()
  endforeach ()
endforeach ()
set(scalars "<PointData Scalars=\"Heat\"><DataArray type=\"UInt8\" Name=\"Heat\" NumberOfComponents=\"3\"
format=\"ascii\">${values}</DataArray></PointData>")
set(lattice "<Points><DataArray type=\"Float64\" NumberOfComponents=\"3\" format=\"ascii\">${points}</DataArray></Points>")
set(axis "<DataArray type=\"Float64\" format=\"ascii\">0 1 2</DataArray>")
set(extent "0 2 0 2 0 2")

function (write_xml name kind attributes piece content)
  file(WRITE "${DIRECTORY}/${name}" "<VTKFile type=\"${kind}\" version=\"0.1\" byte_order=\"LittleEndian\">
<${kind} ${attributes}><Piece ${piece}>${content}</Piece></${kind}></VTKFile>\n")
endfunction ()
write_xml(cube.vti ImageData "WholeExtent=\"${extent}\"" "Extent=\"${extent}\"" "${scalars}")
write_xml(cube.vtr RectilinearGrid "WholeExtent=\"${extent}\"" "Extent=\"${extent}\""
  "${scalars}<Coordinates>${axis}${axis}${axis}</Coordinates>")
write_xml(cube.vts StructuredGrid "WholeExtent=\"${extent}\"" "Extent=\"${extent}\""
  "${scalars}${lattice}")
write_xml(cube.vtu UnstructuredGrid "" "NumberOfPoints=\"27\" NumberOfCells=\"8\""
  "${scalars}${lattice}<Cells><DataArray type=\"Int64\" Name=\"connectivity\" format=\"ascii\">${cells}</DataArray>
<DataArray type=\"Int64\" Name=\"offsets\" format=\"ascii\">8 16 24 32 40 48 56 64</DataArray>
<DataArray type=\"UInt8\" Name=\"types\" format=\"ascii\">12 12 12 12 12 12 12 12</DataArray></Cells>")
set(header "<PPointData Scalars=\"Heat\"><PDataArray type=\"UInt8\" Name=\"Heat\" NumberOfComponents=\"3\"/></PPointData>
<PPoints><PDataArray type=\"Float64\" NumberOfComponents=\"3\"/></PPoints>")
file(WRITE "${DIRECTORY}/cube.pvtu" "<VTKFile type=\"PUnstructuredGrid\" version=\"0.1\"
byte_order=\"LittleEndian\"><PUnstructuredGrid GhostLevel=\"0\">${header}<Piece Source=\"cube.vtu\"/>
</PUnstructuredGrid></VTKFile>\n")
file(WRITE "${DIRECTORY}/cube.pvti" "<VTKFile type=\"PImageData\" version=\"0.1\"
byte_order=\"LittleEndian\"><PImageData GhostLevel=\"0\" WholeExtent=\"${extent}\" Origin=\"0 0 0\"
Spacing=\"1 1 1\">${header}<Piece Extent=\"${extent}\" Source=\"cube.vti\"/></PImageData></VTKFile>\n")
file(WRITE "${DIRECTORY}/cube.vtm" "<VTKFile type=\"vtkMultiBlockDataSet\" version=\"1.0\">
<vtkMultiBlockDataSet><DataSet index=\"0\" file=\"cube.vtu\"/></vtkMultiBlockDataSet></VTKFile>\n")
file(WRITE "${DIRECTORY}/cube.vtpd" "<VTKFile type=\"vtkPartitionedDataSet\" version=\"1.0\">
<vtkPartitionedDataSet><DataSet index=\"0\" file=\"cube.vtu\"/></vtkPartitionedDataSet></VTKFile>\n")
file(WRITE "${DIRECTORY}/cube.vtpc" "<VTKFile type=\"vtkPartitionedDataSetCollection\" version=\"1.0\">
<vtkPartitionedDataSetCollection><Partitions index=\"0\"><DataSet index=\"0\" file=\"cube.vtu\"/></Partitions>
</vtkPartitionedDataSetCollection></VTKFile>\n")
file(WRITE "${DIRECTORY}/cube.pvd" "<VTKFile type=\"Collection\" version=\"0.1\"><Collection>
<DataSet timestep=\"0.5\" part=\"0\" file=\"cube.vtu\"/></Collection></VTKFile>\n")
set(legacy "# vtk DataFile Version 3.0\ncube\nASCII\nDATASET ")
string(REGEX REPLACE "([0-9]+ [0-9]+ [0-9]+ [0-9]+ [0-9]+ [0-9]+ [0-9]+ [0-9]+) " "8 \\1\n" counted "${cells}")
set(colors "POINT_DATA 27\nCOLOR_SCALARS Heat 3\n")
foreach (point RANGE 26)
  string(APPEND colors "0.784314 0.392157 0.196078\n")
endforeach ()
file(WRITE "${DIRECTORY}/cube.vtk" "${legacy}UNSTRUCTURED_GRID\nPOINTS 27 double\n${points}
CELLS 8 72\n${counted}CELL_TYPES 8\n12\n12\n12\n12\n12\n12\n12\n12\n${colors}")

file(WRITE "${DIRECTORY}/cube.obj" "v 0 0 0\nv 2 0 0\nv 2 2 0\nv 0 2 0\nv 0 0 2\nv 2 0 2\nv 2 2 2\nv 0 2 2
f 1 4 3 2\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n")
cslf_run(trace cube.obj -o expected.png ${view} --base-color 0.784314 0.392157 0.196078)
foreach (format IN ITEMS vti vtr vts vtu vtk pvtu pvti vtm vtpd vtpc pvd)
  set(shown "Of the cells of cube.[a-z]+, the surface is shown. Its active scalars are Heat.\n$")
  # Six faces of four squares.
  cslf_warn(1 "${shown}" export cube.${format} -o exported.obj --json)
  expect_json(48 triangles)
endforeach ()
foreach (format IN ITEMS vti vtk pvd)
  cslf_warn(1 "${shown}" trace cube.${format} -o ${format}.png ${view})
  cslf_run(compare ${format}.png expected.png --json)
  expect_json_at_least(32 psnr)
endforeach ()

# Without active scalars.
file(READ "${DIRECTORY}/cube.vtu" text)
string(REPLACE " Scalars=\"Heat\"" "" text "${text}")
file(WRITE "${DIRECTORY}/grey.vtu" "${text}")
cslf_warn(1 "No scalars are active.\n$" trace grey.vtu -o grey.png ${view})

# A tetrahedron covers half of the square of a wedge, which is shown all the same, as by clipped grids.
write_xml(half.vtu UnstructuredGrid "" "NumberOfPoints=\"7\" NumberOfCells=\"2\""
  "<Points><DataArray type=\"Float64\" NumberOfComponents=\"3\" format=\"ascii\">
0 0 0 2 0 0 1 1 0 0 0 2 2 0 2 1 1 2 0.5 -1 0.5</DataArray></Points>
<Cells><DataArray type=\"Int64\" Name=\"connectivity\" format=\"ascii\">0 1 2 3 4 5 0 1 3 6</DataArray>
<DataArray type=\"Int64\" Name=\"offsets\" format=\"ascii\">6 10</DataArray>
<DataArray type=\"UInt8\" Name=\"types\" format=\"ascii\">13 10</DataArray></Cells>")
file(WRITE "${DIRECTORY}/half.obj" "v 0 0 0\nv 2 0 0\nv 1 1 0\nv 0 0 2\nv 2 0 2\nv 1 1 2\nv 0.5 -1 0.5
f 1 2 3\nf 4 6 5\nf 1 4 5 2\nf 2 5 6 3\nf 3 6 4 1\nf 1 2 7\nf 2 4 7\nf 4 1 7\n")
set(below --position 4 -6 4 --focal-point 1 0 1)
cslf_warn(1 "No scalars are active.\n$" trace half.vtu -o half.png ${view} ${below})
cslf_run(trace half.obj -o whole.png ${view} ${below})
cslf_run(compare half.png whole.png --json)
expect_json_at_least(32 psnr)

# Of several time steps, the first is shown, and its missing files are an error.
file(WRITE "${DIRECTORY}/steps.pvd" "<VTKFile type=\"Collection\" version=\"0.1\"><Collection>
<DataSet timestep=\"10\" part=\"0\" file=\"nowhere.vtu\"/><DataSet timestep=\"9.5\" part=\"0\" file=\"cube.vtu\"/>
</Collection></VTKFile>\n")
cslf_warn(2 "Of the 2 time steps of steps.pvd, the first is shown" export steps.pvd -o exported.obj --json)
expect_json(48 triangles)
file(WRITE "${DIRECTORY}/lost.pvd" "<VTKFile type=\"Collection\" version=\"0.1\"><Collection>
<DataSet timestep=\"1\" part=\"0\" file=\"nowhere.vtu\"/></Collection></VTKFile>\n")
cslf_fail("Cannot read lost.pvd: there is no file nowhere.vtu" "x" export lost.pvd -o x.obj)

# Cells that cannot be are left out; a light field is not a scene.
string(REPLACE "0 1 4 3 9 10 13 12 " "0 1 4 3 9 10 13 1200 " text "${text}")
file(WRITE "${DIRECTORY}/wild.vtu" "${text}")
cslf_warn(2 "Parts of wild.vtu that are invalid or have no surface were left out: 1 cell.s." export wild.vtu -o exported.obj)
cslf_run(sample cornell-box -o field.vti -M 2 -N 16 --spp 1 --max-depth 1)
cslf_fail("Cannot read field.vti: it is a light field, not a scene" "x" export field.vti -o x.obj)
file(WRITE "${DIRECTORY}/large.vtk" "${legacy}STRUCTURED_POINTS\nDIMENSIONS 3000 3000 3000\nORIGIN 0 0 0\nSPACING 1 1 1\n")
cslf_fail("large.vtk: it announces 27000000000 points" "x" export large.vtk -o x.obj)
# VTK's readers read out of bounds.
write_xml(strings.vtp PolyData "" "NumberOfPoints=\"27\" NumberOfPolys=\"0\" NumberOfVerts=\"0\" NumberOfLines=\"0\" NumberOfStrips=\"0\""
  "<PointData><Array type=\"String\" Name=\"S\" format=\"ascii\"></Array></PointData>${lattice}")
cslf_fail("Cannot read strings.vtp" "x" export strings.vtp -o x.obj)
file(WRITE "${DIRECTORY}/crash.vtk" "${legacy}UNSTRUCTURED_GRID\nPOINTS 4 float\n0 0 0 1 0 0 0 1 0 0 0 1
CELLS 1 5\n400000000 0 1 2 3\nCELL_TYPES 1\n10\n")
cslf_fail("Cannot read crash.vtk" "x" export crash.vtk -o x.obj)
# Points without cells are shown as those with vertices are.
set(ids)
foreach (id RANGE 26)
  string(APPEND ids "${id} ")
endforeach ()
write_xml(points.vtp PolyData "" "NumberOfPoints=\"27\"" "${scalars}${lattice}")
write_xml(points.vtu UnstructuredGrid "" "NumberOfPoints=\"27\" NumberOfCells=\"0\""
  "${scalars}${lattice}<Cells><DataArray type=\"Int64\" Name=\"connectivity\"/>
<DataArray type=\"Int64\" Name=\"offsets\"/><DataArray type=\"UInt8\" Name=\"types\"/></Cells>")
write_xml(verts.vtp PolyData "" "NumberOfPoints=\"27\" NumberOfVerts=\"1\""
  "${scalars}${lattice}<Verts><DataArray type=\"Int64\" Name=\"connectivity\" format=\"ascii\">${ids}</DataArray>
<DataArray type=\"Int64\" Name=\"offsets\" format=\"ascii\">27</DataArray></Verts>")
foreach (name IN ITEMS verts.vtp points.vtp points.vtu)
  cslf_run(trace ${name} -o ${name}.png ${view})
  cslf_run(compare ${name}.png verts.vtp.png --json)
  expect_json_at_least(60 psnr)
endforeach ()

# Pieces without points, as VTK's writers make them, are left out.
write_xml(empty.vtu UnstructuredGrid "" "NumberOfPoints=\"0\" NumberOfCells=\"0\""
  "<PointData/><CellData/><Points/><Cells><DataArray type=\"Int64\" Name=\"connectivity\" format=\"ascii\"/>
<DataArray type=\"Int64\" Name=\"offsets\" format=\"ascii\"/><DataArray type=\"UInt8\" Name=\"types\" format=\"ascii\"/></Cells>")
write_xml(empty.vtp PolyData "" "NumberOfPoints=\"0\" NumberOfVerts=\"0\" NumberOfLines=\"0\" NumberOfStrips=\"0\" NumberOfPolys=\"0\""
  "<PointData/><CellData/><Points/><Polys><DataArray type=\"Int64\" Name=\"connectivity\" format=\"ascii\"/>
<DataArray type=\"Int64\" Name=\"offsets\" format=\"ascii\"/></Polys>")
file(WRITE "${DIRECTORY}/none.vtu" "<VTKFile type=\"UnstructuredGrid\" version=\"0.1\"><UnstructuredGrid/></VTKFile>\n")
function (write_pieces name kind)
  set(pieces)
  foreach (piece IN LISTS ARGN)
    string(APPEND pieces "<Piece Source=\"${piece}\"/>")
  endforeach ()
  file(WRITE "${DIRECTORY}/${name}" "<VTKFile type=\"P${kind}\" version=\"0.1\" byte_order=\"LittleEndian\">
<P${kind} GhostLevel=\"0\">${header}${pieces}</P${kind}></VTKFile>\n")
endfunction ()
write_pieces(pieces.pvtu UnstructuredGrid empty.vtu cube.vtu none.vtu)
cslf_warn(1 "Its active scalars are Heat.\n$" export pieces.pvtu -o exported.obj --json)
expect_json(48 triangles)
write_pieces(pieces.pvtp PolyData verts.vtp empty.vtp)
cslf_run(trace pieces.pvtp -o pieces.png ${view})
cslf_run(compare pieces.png verts.vtp.png --json)
expect_json_at_least(60 psnr)
write_pieces(nothing.pvtu UnstructuredGrid empty.vtu none.vtu)
cslf_fail("Cannot read nothing.pvtu: it has no cells" "x" export nothing.pvtu -o x.obj)
file(WRITE "${DIRECTORY}/pieces.pvd" "<VTKFile type=\"Collection\" version=\"0.1\"><Collection>
<DataSet timestep=\"0\" part=\"0\" file=\"empty.vtp\"/><DataSet timestep=\"0\" part=\"1\" file=\"cube.vtu\"/>
</Collection></VTKFile>\n")
cslf_warn(1 "Its active scalars are Heat.\n$" export pieces.pvd -o exported.obj --json)
expect_json(48 triangles)

# All arrays of a kind in legacy files.
file(WRITE "${DIRECTORY}/two.vtk" "${legacy}POLYDATA\nPOINTS 4 float\n0 0 0 1 0 0 1 1 0 0 1 0
POLYGONS 1 5\n4 0 1 2 3\nPOINT_DATA 4\nSCALARS one float 1\nLOOKUP_TABLE default\n0 1 2 3
SCALARS two float 1\nLOOKUP_TABLE default\n3 2 1 0\nVECTORS three float\n0 0 0 1 0 0 1 1 0 0 1 0
VECTORS four float\n0 0 0 1 0 0 1 1 0 0 1 0\n")
foreach (array IN ITEMS one two three:x four:y)
  cslf_run(trace two.vtk -o two.png --size 8 8 --spp 1 --color-by ${array})
endforeach ()

# In files of text, NaN among scalars has the grey of the look, and cells of points that are not
# finite are left out. `value` and `corner` are those of the fourth point.
function (write_square value corner)
  set(square "0 0 0 1 0 0 1 1 0 ${corner} 1 0")
  file(WRITE "${DIRECTORY}/square.vtk" "${legacy}POLYDATA\nPOINTS 4 float\n${square}
POLYGONS 2 8\n3 0 1 2\n3 0 2 3\nCELL_DATA 2\nSCALARS nan float 1\nLOOKUP_TABLE default\n1\n${value} \n")
  write_xml(square.vtp PolyData "" "NumberOfPoints=\"4\" NumberOfPolys=\"2\""
    "<CellData Scalars=\"nan\"><DataArray type=\"Float32\" Name=\"nan\" format=\"ascii\">1 ${value} </DataArray></CellData>
<Points><DataArray type=\"Float32\" NumberOfComponents=\"3\" format=\"ascii\">${square} </DataArray></Points>
<Polys><DataArray type=\"Int64\" Name=\"connectivity\" format=\"ascii\">0 1 2 0 2 3 </DataArray>
<DataArray type=\"Int64\" Name=\"offsets\" format=\"ascii\">3 6 </DataArray></Polys>")
endfunction ()
set(close --position 0.3 0.7 0.5 --focal-point 0.3 0.7 0 --size 32 24 --spp 16 --light white)
file(WRITE "${DIRECTORY}/square.obj" "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3\nf 1 3 4\n")
cslf_run(trace square.obj -o expected.png ${close} --base-color 0.6 0.6 0.6)
foreach (value IN ITEMS nan -nan NaN)
  write_square(${value} 0)
  foreach (name IN ITEMS square.vtk square.vtp)
    cslf_run(trace ${name} -o value.png ${close} --color-by nan --range 0 2)
    cslf_run(compare value.png expected.png --json)
    expect_json_at_least(32 psnr)
  endforeach ()
endforeach ()
foreach (value IN ITEMS inf -inf Infinity -Infinity)
  write_square(${value} 0)
  cslf_run(trace square.vtk -o value.png ${close} --color-by nan --range 0 1)
  string(REGEX REPLACE "^-.*" 0 finite "${value}")
  string(REGEX REPLACE "^[iI].*" 1 finite "${finite}")
  write_square(${finite} 0)
  cslf_run(trace square.vtk -o finite.png ${close} --color-by nan --range 0 1)
  cslf_run(compare value.png finite.png --json)
  expect_json_at_least(32 psnr)
endforeach ()
foreach (corner IN ITEMS nan -nan inf -inf)
  write_square(2 ${corner})
  set(names square.vtk square.vtp)
  if (corner STREQUAL "-inf")
    set(names square.vtk)
  endif ()
  foreach (name IN LISTS names)
    cslf_warn(1 "1 polygon.s. with coordinates that are not finite" trace ${name} -o x.png ${close})
  endforeach ()
endforeach ()
# VTK's reader would stop at these.
foreach (value IN ITEMS Infinity -inf)
  write_square(${value} 0)
  cslf_fail("square.vtp has an array with coordinates or other values that are not finite" "infinite"
    trace square.vtp -o infinite.png ${close})
endforeach ()
