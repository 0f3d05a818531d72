include(CMakePackageConfigHelpers)
get_property(layers GLOBAL PROPERTY OSCULATE_LAYERS)
set(targets "")
foreach(layer IN LISTS layers)
  list(APPEND targets osculate_${layer})
endforeach()
install(TARGETS ${targets} EXPORT OsculateTargets
  ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR})
install(DIRECTORY src/osculate DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} FILES_MATCHING PATTERN "*.hpp"
  PATTERN "detail" EXCLUDE)
install(EXPORT OsculateTargets NAMESPACE Osculate:: DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/Osculate)
configure_package_config_file(cmake/OsculateConfig.cmake.in ${CMAKE_BINARY_DIR}/OsculateConfig.cmake
  INSTALL_DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/Osculate PATH_VARS CMAKE_INSTALL_INCLUDEDIR)
write_basic_package_version_file(${CMAKE_BINARY_DIR}/OsculateConfigVersion.cmake
  COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_BINARY_DIR}/OsculateConfig.cmake ${CMAKE_BINARY_DIR}/OsculateConfigVersion.cmake
  DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/Osculate)
if(OSCULATE_APP)
  install(TARGETS osculate RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
  install(DIRECTORY verification DESTINATION ${CMAKE_INSTALL_DATADIR}/osculate)
endif()
