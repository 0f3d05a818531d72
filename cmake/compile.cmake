# osculate_compile(TARGET hot|cold|tests): how sources are compiled, the same in every preset of one
# build type, so that program and tests share the library's objects.
#   hot    kernels: -O2
#   cold   readers, reports, commands, cases: -O1 (their time is the compiler's)
#   tests  as cold, with GoogleTest in the precompiled header
# Flags are never exported to users. Where sources are compiled together, what one calls a local
# variable another may call a constant, and a source is an included file.
option(OSCULATE_PRECOMPILE "Precompile the headers that most sources need" ON)
add_library(osculate_flags INTERFACE)
target_compile_options(osculate_flags INTERFACE -fPIC
  -Wall -Wextra -Wpedantic -Wnon-virtual-dtor
  $<IF:$<BOOL:$<TARGET_PROPERTY:UNITY_BUILD>>,$<$<CXX_COMPILER_ID:GNU>:-Wno-subobject-linkage>,-Wshadow>
  # The compiler collects garbage only from 1 GB on: a tenth of its time.
  $<$<CXX_COMPILER_ID:GNU>:-Wcast-align=strict;-Wno-maybe-uninitialized;--param=ggc-min-heapsize=1000000>)
if(OSCULATE_WERROR)
  target_compile_options(osculate_flags INTERFACE -Werror)
endif()
if(NOT OSCULATE_BASELINE AND CMAKE_SYSTEM_PROCESSOR STREQUAL "x86_64")
  target_compile_options(osculate_flags INTERFACE -march=x86-64-v3)
endif()
# Whether solid/batch_wide.cpp is for processors with AVX-512. Without optimisation, and by clang, functions that others
# have, too, would not be inlined (tests/tools/wide_symbols.sh).
set(OSCULATE_WIDE OFF)
if(CMAKE_SYSTEM_PROCESSOR STREQUAL "x86_64" AND CMAKE_BUILD_TYPE STREQUAL "Release" AND
   CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND NOT OSCULATE_BASELINE AND NOT OSCULATE_SANITIZE)
  set(OSCULATE_WIDE ON)
endif()
if(OSCULATE_SANITIZE)  # what AddressSanitizer sees as well need not be checked twice: a third of the time
  # Alignment: Eigen asserts that of its arrays, g++ refuses casts that raise it (-Wcast-align). Checked at every
  # access only where pointers come from users: a fifth of the time of all others.
  target_compile_options(osculate_flags INTERFACE -fsanitize=address,undefined -fno-sanitize-recover=all
    -fno-sanitize=null,object-size,pointer-overflow,vptr
    $<$<NOT:$<STREQUAL:$<TARGET_PROPERTY:NAME>,osculate_embed>>:-fno-sanitize=alignment>
    -fno-omit-frame-pointer
    # Checks are calls: a fifth of the time. Not where tests solve large systems: there they are half of a run.
    "$<$<NOT:$<STREQUAL:$<TARGET_PROPERTY:NAME>,osculate_la>>:SHELL:-mllvm -asan-instrumentation-with-call-threshold=0>")
  target_link_options(osculate_flags INTERFACE -fsanitize=address,undefined)
endif()
find_program(OSCULATE_LLD ld.lld)
mark_as_advanced(OSCULATE_LLD)
if(OSCULATE_LLD)
  target_link_options(osculate_flags INTERFACE -fuse-ld=lld)
endif()

function(osculate_optimise target temperature)
  if(NOT temperature STREQUAL "hot")
    target_compile_options(${target} PRIVATE $<$<CONFIG:Release>:-O1>)
  endif()
endfunction()
# A precompiled header for each temperature: g++ takes the level of optimisation from it, not from the command line.
function(osculate_precompile target temperature)
  set(name osculate_precompiled_${temperature})
  if(NOT TARGET ${name})
    file(CONFIGURE OUTPUT ${CMAKE_BINARY_DIR}/${name}.cpp CONTENT "")
    add_library(${name} OBJECT ${CMAKE_BINARY_DIR}/${name}.cpp)
    target_link_libraries(${name} PRIVATE osculate_flags osculate_values fmt::fmt)
    osculate_optimise(${name} ${temperature})
    target_precompile_headers(${name} PRIVATE ${PROJECT_SOURCE_DIR}/cmake/precompiled.hpp)
    if(temperature STREQUAL "tests")
      target_link_libraries(${name} PRIVATE GTest::gtest GTest::gmock)
      target_precompile_headers(${name} PRIVATE <gtest/gtest.h> <gmock/gmock.h>)
    endif()
  endif()
  target_precompile_headers(${target} REUSE_FROM ${name})
endfunction()
function(osculate_compile target temperature)
  target_link_libraries(${target} PRIVATE $<BUILD_INTERFACE:osculate_flags>)
  osculate_optimise(${target} ${temperature})
  if(OSCULATE_SANITIZE AND temperature STREQUAL "tests")  # what runs once need not be inlined
    target_compile_options(${target} PRIVATE "SHELL:-mllvm -inline-threshold=0")
  endif()
  if(OSCULATE_PRECOMPILE)
    osculate_precompile(${target} ${temperature})
  endif()
  if(OSCULATE_BATCHES)
    osculate_batches(${target})
  endif()
endfunction()
