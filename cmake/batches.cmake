# osculate_batches(TARGET): its sources compiled several at a time (tools/batches says which), for
# builds from nothing: most of their time goes into headers and templates that every source needs. More of
# them by clang: g++'s look-ups grow with the square of what is there, so that it is fastest with eight.
option(OSCULATE_BATCHES "Compile sources together" OFF)
if(OSCULATE_BATCHES)
  find_package(Python3 REQUIRED COMPONENTS Interpreter)
endif()
function(osculate_batches target)
  get_target_property(sources ${target} SOURCES)
  get_target_property(folder ${target} SOURCE_DIR)
  set(size 8)
  if(CMAKE_CXX_COMPILER_ID STREQUAL "Clang")
    set(size 16)
  endif()
  execute_process(COMMAND ${Python3_EXECUTABLE} ${PROJECT_SOURCE_DIR}/tools/batches ${size} ${sources}
    WORKING_DIRECTORY ${folder} OUTPUT_VARIABLE numbers OUTPUT_STRIP_TRAILING_WHITESPACE COMMAND_ERROR_IS_FATAL ANY)
  foreach(source number IN ZIP_LISTS sources numbers)
    set_source_files_properties(${source} PROPERTIES UNITY_GROUP ${number})
  endforeach()
  set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_MODE GROUP)
  set_property(DIRECTORY ${folder} APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/tools/batches)
endfunction()
