# Flags shared by every target of the project (never exported to users).
add_library(osculate_flags INTERFACE)
target_compile_options(osculate_flags INTERFACE -Wall -Wextra -Wpedantic -Wshadow -Wnon-virtual-dtor
  $<$<CXX_COMPILER_ID:GNU>:-Wno-maybe-uninitialized>)
if(OSCULATE_WERROR)
  target_compile_options(osculate_flags INTERFACE -Werror)
endif()
if(NOT OSCULATE_BASELINE AND CMAKE_SYSTEM_PROCESSOR STREQUAL "x86_64")
  target_compile_options(osculate_flags INTERFACE -march=x86-64-v3)
endif()
if(OSCULATE_SANITIZE)
  target_compile_options(osculate_flags INTERFACE -fsanitize=address,undefined -fno-sanitize-recover=all
    -fno-omit-frame-pointer)
  target_link_options(osculate_flags INTERFACE -fsanitize=address,undefined)
endif()
if(OSCULATE_FUZZ)
  target_compile_options(osculate_flags INTERFACE -fsanitize=fuzzer-no-link)
endif()
