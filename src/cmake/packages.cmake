# Debian packages: `cpack` in a build tree makes, in its folder packages,
#   palpation            the programs
#   libpalpation-dev     headers, the library, the CMake package
#   python3-palpation    the module for Debian's interpreter, where it is built
#   libpalpationM.N      the shared library, with BUILD_SHARED_LIBS
# Depends on shared libraries are found by dpkg-shlibdeps in what is packed; headers and static libraries name theirs here.
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME palpation)
set(CPACK_PACKAGE_VERSION ${PROJECT_VERSION})
set(CPACK_PACKAGE_CONTACT "The palpation project <palpation@palpation.invalid>" CACHE STRING "Maintainer, as Debian packages name one")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS_PRIVATE_DIRS ${PROJECT_BINARY_DIR})
set(CPACK_DEBIAN_PACKAGE_GENERATE_SHLIBS ON)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
set(CPACK_OUTPUT_FILE_PREFIX ${PROJECT_BINARY_DIR}/packages)
set(CPACK_VERBATIM_VARIABLES ON)

set(palpation_words "A Gaussian process over a triangle mesh models stiffness; acquisition
functions choose where a probe touches next, and the boundary of a tumour
comes with a band that holds the whole outline with a given probability.
For research on phantoms and excised tissue, not for patients.")

# palpation_package(COMPONENT SECTION what-it-holds Depends): with what Debian's policy wants in each package's folder of documents.
function(palpation_package component section summary depends)
  string(TOUPPER ${component} upper)
  foreach(setting "PACKAGE_NAME|${component}" "PACKAGE_SECTION|${section}" "PACKAGE_DEPENDS|${depends}")
    string(REPLACE "|" ";" setting "${setting}")
    list(POP_FRONT setting name)
    set(CPACK_DEBIAN_${upper}_${name} "${setting}" PARENT_SCOPE)
  endforeach()
  set(CPACK_DEBIAN_${upper}_DESCRIPTION "${palpation_words}\n.\n${summary}" PARENT_SCOPE)
  set(CPACK_COMPONENTS_ALL ${CPACK_COMPONENTS_ALL} ${component} PARENT_SCOPE)
  install(FILES ${PROJECT_SOURCE_DIR}/src/cmake/debian-copyright DESTINATION share/doc/${component} RENAME copyright
          COMPONENT ${component} EXCLUDE_FROM_ALL)
  install(FILES ${PROJECT_BINARY_DIR}/changelog.gz DESTINATION share/doc/${component} COMPONENT ${component} EXCLUDE_FROM_ALL)
endfunction()

# Debian's form of the changelog: which version, and where the words are. -n: no time in it, so that the same sources give the same bytes.
file(WRITE ${PROJECT_BINARY_DIR}/changelog
  "palpation (${PROJECT_VERSION}) unstable; urgency=medium\n\n  * Release ${PROJECT_VERSION}.\n\n -- ${CPACK_PACKAGE_CONTACT}  Mon, 23 Nov 2026 00:00:00 +0000\n")
execute_process(COMMAND gzip -9nkf ${PROJECT_BINARY_DIR}/changelog RESULT_VARIABLE palpation_no_gzip OUTPUT_QUIET ERROR_QUIET)

set(CPACK_COMPONENTS_ALL "")
if(NOT palpation_no_gzip)
  set(palpation_linked "")
  set(palpation_dev_needs "libeigen3-dev, libgmp-dev, libmpfr-dev, libnlopt-dev, libopenmesh-dev, libvtk9-dev")
  if(BUILD_SHARED_LIBS)
    set(palpation_linked "${palpation_soname_package} (= ${PROJECT_VERSION})")
    set(palpation_dev_needs "libeigen3-dev, ${palpation_linked}")
    palpation_package(${palpation_soname_package} libs "This package has the shared library." "")
    file(WRITE ${PROJECT_BINARY_DIR}/triggers "activate-noawait ldconfig\n")
    string(TOUPPER ${palpation_soname_package} upper)
    set(CPACK_DEBIAN_${upper}_PACKAGE_CONTROL_EXTRA ${PROJECT_BINARY_DIR}/triggers)
  endif()
  palpation_package(libpalpation-dev libdevel "This package has headers, the library to link and its CMake package." "${palpation_dev_needs}")
  if(PALPATION_PROGRAMS)
    set(CPACK_DEBIAN_PALPATION_PACKAGE_RECOMMENDS libgl1-mesa-dri)  # draws where there is no graphics card
    set(CPACK_DEBIAN_PALPATION_PACKAGE_SUGGESTS "python3-numpy, python3-rospy, python3-rosmaster, python3-geometry-msgs, python3-sensor-msgs, python3-netifaces")
    set(palpation_needs python3)  # palpate-arm
    if(palpation_linked)
      string(APPEND palpation_needs ", ${palpation_linked}")
    endif()
    palpation_package(palpation science "This package has the programs palpate, palpate-draw and palpate-arm." "${palpation_needs}")
  endif()
  if(TARGET palpation_python)
    set(python "python3-numpy, python3 (>= ${palpation_this_python}), python3 (<< ${palpation_next_python})")
    if(palpation_linked)
      string(APPEND python ", ${palpation_linked}")
    endif()
    palpation_package(python3-palpation python "This package has the Python module palpation." "${python}")
  endif()
endif()
include(CPack)
