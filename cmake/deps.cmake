# Every third-party dependency in one place. All are Debian 12 packages; see tools/setup.
find_package(Eigen3 3.4 REQUIRED NO_MODULE)
find_package(fmt 9 REQUIRED)
find_package(yaml-cpp 0.7 REQUIRED)
find_package(nlohmann_json 3.11 REQUIRED)
find_package(CLI11 2.1 REQUIRED)
find_package(PkgConfig REQUIRED)
pkg_check_modules(LIBDEFLATE REQUIRED IMPORTED_TARGET libdeflate)
find_package(MumpsSeq REQUIRED)
find_package(Spectra 1.0 CONFIG REQUIRED HINTS /usr/share/spectra/cmake)
if(OSCULATE_TESTS)
  find_package(GTest 1.12 REQUIRED)
  find_package(ZLIB REQUIRED)
endif()
# Eigen as all use it. The library is built with AVX unless OSCULATE_BASELINE is set, a host code
# perhaps without: both must align small matrices alike, or values change their layout on the way.
add_library(osculate_values INTERFACE)
target_link_libraries(osculate_values INTERFACE Eigen3::Eigen)
target_compile_definitions(osculate_values INTERFACE EIGEN_MAX_ALIGN_BYTES=32 EIGEN_MAX_STATIC_ALIGN_BYTES=32)
