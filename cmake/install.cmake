include(CMakePackageConfigHelpers)
set(CMAKE_INSTALL_DEFAULT_COMPONENT_NAME development)
# The program's own shared layer, and Osculate::contact for other codes; everything else is private.
install(TARGETS osculate_la RUNTIME_DEPENDENCY_SET osculate_needs
  LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT program)
install(TARGETS osculate_library EXPORT OsculateTargets LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR})
install(DIRECTORY include/osculate DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
install(EXPORT OsculateTargets NAMESPACE Osculate:: DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/Osculate)
configure_package_config_file(cmake/OsculateConfig.cmake.in ${CMAKE_BINARY_DIR}/OsculateConfig.cmake
  INSTALL_DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/Osculate PATH_VARS CMAKE_INSTALL_INCLUDEDIR)
write_basic_package_version_file(${CMAKE_BINARY_DIR}/OsculateConfigVersion.cmake
  COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_BINARY_DIR}/OsculateConfig.cmake ${CMAKE_BINARY_DIR}/OsculateConfigVersion.cmake
  DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/Osculate)
if(OSCULATE_APP)
  install(TARGETS osculate RUNTIME_DEPENDENCY_SET osculate_needs
    RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT program)
  set(written ${CMAKE_BINARY_DIR}/app/osculate)  # by the program itself
  install(FILES ${written}/osculate.1 DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 COMPONENT program OPTIONAL)
  install(FILES ${written}/osculate.bash DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions
    RENAME osculate COMPONENT program OPTIONAL)
  install(FILES ${written}/_osculate DESTINATION ${CMAKE_INSTALL_DATADIR}/zsh/vendor-completions COMPONENT program OPTIONAL)
  install(FILES ${written}/osculate.fish DESTINATION ${CMAKE_INSTALL_DATADIR}/fish/vendor_completions.d
    COMPONENT program OPTIONAL)
  if(OSCULATE_MPI)  # with what it needs a package of its own: the program's has no MPI
    install(TARGETS osculate_mpi LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT mpi)
  endif()
  if(OSCULATE_VERIFICATION)
    install(TARGETS osculate-verify RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT verification)
    install(DIRECTORY verification DESTINATION ${CMAKE_INSTALL_DATADIR}/osculate COMPONENT verification
      PATTERN "*.?pp" EXCLUDE)
  endif()
  include(package)
endif()
