# SPDX-FileCopyrightText: Copyright (c) CSLF contributors
# SPDX-License-Identifier: BSD-3-Clause

# What Doxygen is given in place of a header: functions that every VTK class has, and the overrides
# by which it takes part in the pipeline, are as in VTK, so headers do not explain them.
s#^  static vtk[A-Za-z]*\* New();#  /// Makes an object with default parameters.\n&#
s#^  void PrintSelf(.*) override;#  /// Prints the parameters.\n&#
s#^  int \(FillInputPortInformation\|Request[A-Za-z]*\)(#  /// As in vtkAlgorithm.\n&#
