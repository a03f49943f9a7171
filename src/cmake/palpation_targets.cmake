# How a folder of the house becomes a target.

# What every translation unit of the project is compiled with, and nobody else's. -ffp-contract=off: the same sums on every instruction set.
add_library(palpation_flags INTERFACE)
# -Wno-restrict: GCC 12 sees overlaps in std::string's operator+ that are not there (GCC bug 105651).
target_compile_options(palpation_flags INTERFACE
  -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wno-sign-conversion $<$<CXX_COMPILER_ID:GNU>:-Wno-restrict> -ffp-contract=off)
if(PALPATION_WERROR)
  target_compile_options(palpation_flags INTERFACE -Werror)
endif()
if(PALPATION_SANITIZE)
  set(palpation_sanitizers -fsanitize=${PALPATION_SANITIZE})
  # -Wno-maybe-uninitialized: under its sanitizers GCC sees variables without values that are not there; the release build keeps the warning.
  target_compile_options(palpation_flags INTERFACE
    ${palpation_sanitizers} -fno-sanitize-recover=all -fno-omit-frame-pointer -g1
    $<$<CXX_COMPILER_ID:GNU>:-Wno-maybe-uninitialized>)
  target_compile_definitions(palpation_flags INTERFACE _GLIBCXX_ASSERTIONS)
  target_link_options(palpation_flags INTERFACE ${palpation_sanitizers})
endif()

# palpation_folder(NAME PUBLIC targets... PRIVATE third parties...): the library palpation_NAME made of src/NAME/*.cpp.
# Three third parties are more than a target: VTK means the components in palpation_vtk_components; CGAL also keeps CGAL's own checks on in
# a release build, and is headers only, so that who uses the installed library needs no CGAL, only the number libraries below it.
# Boost is headers only. CGAL's -frounding-math stays in the folders that use CGAL.
function(palpation_folder name)
  cmake_parse_arguments(arg "" "" "PUBLIC;PRIVATE" ${ARGN})
  file(GLOB sources CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/src/${name}/*.cpp)
  add_library(palpation_${name} STATIC ${sources})
  palpation_unite(palpation_${name} ${sources})
  add_library(palpation::${name} ALIAS palpation_${name})
  target_include_directories(palpation_${name} PUBLIC
    $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/include> $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
  target_include_directories(palpation_${name} PRIVATE ${PROJECT_SOURCE_DIR}/src)
  target_compile_features(palpation_${name} PUBLIC cxx_std_20)
  # Eigen's alignment is part of the interface. Left alone it follows the vector instructions and AddressSanitizer, on the heap (who frees what the
  # other allocated) and inside objects (where members lie): so both are fixed, the heap's at the widest there is.
  target_compile_definitions(palpation_${name} PUBLIC EIGEN_MAX_ALIGN_BYTES=64 EIGEN_MAX_STATIC_ALIGN_BYTES=16 PRIVATE EIGEN_DONT_PARALLELIZE)
  target_link_libraries(palpation_${name} PUBLIC ${arg_PUBLIC} PRIVATE $<BUILD_INTERFACE:palpation_flags>)
  if(PALPATION_SANITIZE)
    target_link_options(palpation_${name} INTERFACE ${palpation_sanitizers})  # whoever links sanitized objects needs the runtimes
  endif()
  foreach(party IN LISTS arg_PRIVATE)
    if(party STREQUAL "VTK")
      list(TRANSFORM palpation_vtk_components PREPEND VTK:: OUTPUT_VARIABLE vtk_targets)
      target_link_libraries(palpation_${name} PRIVATE ${vtk_targets})
    elseif(party STREQUAL "CGAL")
      target_link_libraries(palpation_${name} PRIVATE $<BUILD_INTERFACE:CGAL::CGAL> $<INSTALL_INTERFACE:mpfr> $<INSTALL_INTERFACE:gmp>)
      target_compile_definitions(palpation_${name} PRIVATE CGAL_DEBUG)
    elseif(party STREQUAL "Boost")
      target_link_libraries(palpation_${name} PRIVATE $<BUILD_INTERFACE:Boost::headers>)
    else()
      target_link_libraries(palpation_${name} PRIVATE ${party})
    endif()
  endforeach()
  set_target_properties(palpation_${name} PROPERTIES EXPORT_NAME ${name})
  set_property(GLOBAL APPEND PROPERTY palpation_libraries palpation_${name})
endfunction()
