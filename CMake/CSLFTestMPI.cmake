# SPDX-FileCopyrightText: Copyright (c) CSLF contributors
# SPDX-License-Identifier: BSD-3-Clause

# Sets cslf_mpi_environment, the environment of tests that run Open MPI. All processes are on one
# machine, and version 5 prints warnings if it finds no network.
set(cslf_mpi_environment
  OMPI_ALLOW_RUN_AS_ROOT=1
  OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1
  OMPI_MCA_btl=^tcp)
# The permission to start more processes than cores has another name in versions 4, 5 and 6, and
# version 6 warns of the name of version 5.
find_program(CSLF_MPIRUN mpirun)
mark_as_advanced(CSLF_MPIRUN)
set(cslf_mpirun_version)
if (CSLF_MPIRUN)
  execute_process(COMMAND "${CSLF_MPIRUN}" --version
    OUTPUT_VARIABLE cslf_mpirun_version
    ERROR_QUIET)
endif ()
if (cslf_mpirun_version MATCHES "Open MPI\\) [1-4]\\.")
  list(APPEND cslf_mpi_environment OMPI_MCA_rmaps_base_oversubscribe=1)
elseif (cslf_mpirun_version MATCHES "Open MPI\\) 5\\.")
  list(APPEND cslf_mpi_environment PRTE_MCA_rmaps_default_mapping_policy=:oversubscribe)
else ()
  list(APPEND cslf_mpi_environment PRTE_MCA_mapby=:oversubscribe)
endif ()
