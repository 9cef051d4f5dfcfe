include(CMakePackageConfigHelpers)
set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/lekalo)

get_property(modules GLOBAL PROPERTY LEKALO_MODULES)
install(TARGETS ${modules} EXPORT lekaloTargets ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
install(EXPORT lekaloTargets NAMESPACE lekalo:: DESTINATION ${package_dir})
install(DIRECTORY include/lekalo DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
if(TARGET lekalo)
  install(TARGETS lekalo RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
endif()

if(TARGET lekalo-step)
  install(TARGETS lekalo-step RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
endif()

configure_package_config_file(cmake/lekaloConfig.cmake.in ${PROJECT_BINARY_DIR}/lekaloConfig.cmake
  INSTALL_DESTINATION ${package_dir})
# Before 1.0 a minor version may change any header.
write_basic_package_version_file(${PROJECT_BINARY_DIR}/lekaloConfigVersion.cmake
  COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/lekaloConfig.cmake ${PROJECT_BINARY_DIR}/lekaloConfigVersion.cmake
  DESTINATION ${package_dir})
