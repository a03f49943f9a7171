# What `cmake --install` puts where: headers, the library (one static one per folder, or one shared one), the tools, and a package that consumers find
# with
#   find_package(palpation CONFIG REQUIRED)
#   target_link_libraries(mine PRIVATE palpation::palpation)
# The components are the Debian packages that packages.cmake makes of them.
include(CMakePackageConfigHelpers)

set(palpation_package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/palpation)
set(palpation_soname_package libpalpation${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR})
get_property(palpation_libraries GLOBAL PROPERTY palpation_libraries)  # every palpation_folder() that is a library of its own

install(TARGETS palpation ${palpation_libraries} EXPORT palpation-targets
  LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT ${palpation_soname_package} NAMELINK_COMPONENT libpalpation-dev
  ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT libpalpation-dev)
install(DIRECTORY include/palpation DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} COMPONENT libpalpation-dev FILES_MATCHING PATTERN "*.h")
install(FILES LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT license)

foreach(tool palpate palpate-draw)
  if(TARGET ${tool})
    install(TARGETS ${tool} RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT palpation)
    if(BUILD_SHARED_LIBS)
      set_target_properties(${tool} PROPERTIES INSTALL_RPATH "$ORIGIN/../${CMAKE_INSTALL_LIBDIR}")
    endif()
  endif()
endforeach()

# The driver of an arm and the simulated one: two scripts, and what they share.
if(TARGET palpate)
  install(PROGRAMS src/robot/ros/palpate-arm src/robot/ros/palpate-simulated-arm DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT palpation)
  install(DIRECTORY src/robot/ros/palpation_arm src/robot/ros/msg DESTINATION share/palpation/ros COMPONENT palpation
          PATTERN "__pycache__" EXCLUDE)
endif()

if(TARGET palpate_told)
  install(FILES ${PROJECT_BINARY_DIR}/told/palpate.1.gz DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 COMPONENT palpation)
  install(FILES ${PROJECT_BINARY_DIR}/told/palpate DESTINATION share/bash-completion/completions COMPONENT palpation)
endif()

# Only when it is asked for by name: where an interpreter looks is not below any prefix.
if(TARGET palpation_python)
  set(palpation_python_dir lib/python3/dist-packages/palpation)
  install(TARGETS palpation_python LIBRARY DESTINATION ${palpation_python_dir} COMPONENT python3-palpation EXCLUDE_FROM_ALL)
  install(FILES src/python/palpation/__init__.py src/python/palpation/__init__.pyi src/python/palpation/_vtk.py src/python/palpation/_vtk.pyi
          src/python/palpation/py.typed
          DESTINATION ${palpation_python_dir} COMPONENT python3-palpation EXCLUDE_FROM_ALL)
endif()

install(EXPORT palpation-targets NAMESPACE palpation:: DESTINATION ${palpation_package_dir} COMPONENT libpalpation-dev)
configure_package_config_file(src/cmake/palpationConfig.cmake.in palpationConfig.cmake INSTALL_DESTINATION ${palpation_package_dir})
# Before version 1 a minor version may change names: only the same one is compatible.
write_basic_package_version_file(palpationConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/palpationConfig.cmake ${CMAKE_CURRENT_BINARY_DIR}/palpationConfigVersion.cmake
        DESTINATION ${palpation_package_dir} COMPONENT libpalpation-dev)
