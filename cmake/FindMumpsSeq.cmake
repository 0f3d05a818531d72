# Finds Debian's sequential MUMPS as static archives, with the orderings it needs.
# Defines the imported target MumpsSeq::dmumps. The archives carry stub MPI symbols; link them
# into a shared object with hidden symbols (see src/osculate/la/CMakeLists.txt).
set(_mumps_libs dmumps_seq mumps_common_seq pord_seq mpiseq_seq)
set(_mumps_archives "")
foreach(_lib IN LISTS _mumps_libs)
  find_library(MUMPS_${_lib} NAMES lib${_lib}.a)
  mark_as_advanced(MUMPS_${_lib})
  list(APPEND _mumps_archives ${MUMPS_${_lib}})
endforeach()
find_path(MUMPS_INCLUDE_DIR dmumps_c.h)
find_library(MUMPS_ESMUMPS NAMES esmumps)
find_library(MUMPS_SCOTCH NAMES scotch)
find_library(MUMPS_SCOTCHERR NAMES scotcherr)
find_library(MUMPS_METIS NAMES metis)
find_library(MUMPS_OPENBLAS NAMES openblas PATH_SUFFIXES openblas-pthread)
find_library(MUMPS_GFORTRAN NAMES gfortran libgfortran.so.5)
include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(MumpsSeq DEFAULT_MSG MUMPS_dmumps_seq MUMPS_INCLUDE_DIR
  MUMPS_ESMUMPS MUMPS_SCOTCH MUMPS_SCOTCHERR MUMPS_METIS MUMPS_OPENBLAS MUMPS_GFORTRAN)
if(MumpsSeq_FOUND AND NOT TARGET MumpsSeq::dmumps)
  add_library(MumpsSeq::dmumps INTERFACE IMPORTED)
  set_target_properties(MumpsSeq::dmumps PROPERTIES
    INTERFACE_INCLUDE_DIRECTORIES "${MUMPS_INCLUDE_DIR};${MUMPS_INCLUDE_DIR}/mumps_seq"
    INTERFACE_LINK_LIBRARIES
    "${_mumps_archives};${MUMPS_ESMUMPS};${MUMPS_SCOTCH};${MUMPS_SCOTCHERR};${MUMPS_METIS};${MUMPS_OPENBLAS};${MUMPS_GFORTRAN};pthread;m")
endif()
mark_as_advanced(MUMPS_INCLUDE_DIR MUMPS_ESMUMPS MUMPS_SCOTCH MUMPS_SCOTCHERR MUMPS_METIS
  MUMPS_OPENBLAS MUMPS_GFORTRAN)
