# Finds Debian's MUMPS for several processes (libmumps-dev) beside the MPI it was built with.
# Defines the imported target MumpsMpi::dmumps.
find_package(MPI REQUIRED COMPONENTS C)
find_package(PkgConfig REQUIRED)
find_path(MUMPS_INCLUDE_DIR dmumps_c.h)
find_library(MUMPS_MPI_LIBRARY NAMES dmumps)
include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(MumpsMpi DEFAULT_MSG MUMPS_MPI_LIBRARY MUMPS_INCLUDE_DIR)
if(MumpsMpi_FOUND AND NOT TARGET MumpsMpi::dmumps)
  add_library(MumpsMpi::dmumps INTERFACE IMPORTED)
  set_target_properties(MumpsMpi::dmumps PROPERTIES
    INTERFACE_INCLUDE_DIRECTORIES "${MUMPS_INCLUDE_DIR}"
    INTERFACE_LINK_LIBRARIES "${MUMPS_MPI_LIBRARY};MPI::MPI_C")
endif()
mark_as_advanced(MUMPS_MPI_LIBRARY)
