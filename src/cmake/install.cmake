# What `cmake --install` puts where: headers, one static library per folder, the tools, and a package that consumers find with
#   find_package(palpation CONFIG REQUIRED)
#   target_link_libraries(mine PRIVATE palpation::palpation)
include(CMakePackageConfigHelpers)

set(palpation_package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/palpation)
get_property(palpation_libraries GLOBAL PROPERTY palpation_libraries)  # every palpation_folder()

install(TARGETS palpation ${palpation_libraries} EXPORT palpation-targets ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
install(DIRECTORY include/palpation DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} FILES_MATCHING PATTERN "*.h")
install(FILES LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR})

foreach(tool palpate palpate-draw)
  if(TARGET ${tool})
    install(TARGETS ${tool} RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
  endif()
endforeach()

install(EXPORT palpation-targets NAMESPACE palpation:: DESTINATION ${palpation_package_dir})
configure_package_config_file(src/cmake/palpationConfig.cmake.in palpationConfig.cmake INSTALL_DESTINATION ${palpation_package_dir})
# Before version 1 a minor version may change names: only the same one is compatible.
write_basic_package_version_file(palpationConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/palpationConfig.cmake ${CMAKE_CURRENT_BINARY_DIR}/palpationConfigVersion.cmake
        DESTINATION ${palpation_package_dir})
