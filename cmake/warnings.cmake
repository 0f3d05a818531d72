# Flags shared by every target of the project (never exported to users). Where sources are compiled
# together, what one calls a local variable another may call a constant.
add_library(osculate_flags INTERFACE)
target_compile_options(osculate_flags INTERFACE -Wall -Wextra -Wpedantic -Wnon-virtual-dtor
  $<$<NOT:$<BOOL:$<TARGET_PROPERTY:UNITY_BUILD>>>:-Wshadow>
  $<$<CXX_COMPILER_ID:GNU>:-Wno-maybe-uninitialized>)
if(OSCULATE_WERROR)
  target_compile_options(osculate_flags INTERFACE -Werror)
endif()
if(NOT OSCULATE_BASELINE AND CMAKE_SYSTEM_PROCESSOR STREQUAL "x86_64")
  target_compile_options(osculate_flags INTERFACE -march=x86-64-v3)
endif()
if(OSCULATE_SANITIZE)  # what AddressSanitizer sees as well need not be checked twice: a third of the time
  target_compile_options(osculate_flags INTERFACE -fsanitize=address,undefined -fno-sanitize-recover=all
    -fno-sanitize=null,object-size,pointer-overflow,vptr
    -fno-omit-frame-pointer)
  target_link_options(osculate_flags INTERFACE -fsanitize=address,undefined)
endif()
