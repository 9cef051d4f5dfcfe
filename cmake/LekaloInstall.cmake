include(CMakePackageConfigHelpers)
get_property(modules GLOBAL PROPERTY LEKALO_MODULES)
install(TARGETS ${modules} EXPORT lekaloTargets ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
install(TARGETS lekalo RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
install(DIRECTORY include/lekalo DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
install(EXPORT lekaloTargets NAMESPACE lekalo:: DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/lekalo)
configure_package_config_file(cmake/lekaloConfig.cmake.in ${CMAKE_CURRENT_BINARY_DIR}/lekaloConfig.cmake
  INSTALL_DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/lekalo)
write_basic_package_version_file(${CMAKE_CURRENT_BINARY_DIR}/lekaloConfigVersion.cmake
  COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/lekaloConfig.cmake
              ${CMAKE_CURRENT_BINARY_DIR}/lekaloConfigVersion.cmake
        DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/lekalo)
