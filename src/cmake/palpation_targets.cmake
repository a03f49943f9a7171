# How a folder of the house becomes a target.

# What every translation unit of the project is compiled with, and nobody else's. -ffp-contract=off: the same sums on every instruction set.
add_library(palpation_flags INTERFACE)
# -Wno-restrict: GCC 12 sees overlaps in std::string's operator+ that are not there (GCC bug 105651).
target_compile_options(palpation_flags INTERFACE
  -Wall -Wextra -Wpedantic -Wconversion -Wno-sign-conversion $<$<CXX_COMPILER_ID:GNU>:-Wno-restrict> -ffp-contract=off)
if(PALPATION_UNITY)
  # A name of one source may be hidden by a local one of another; and no type of a source is private to what the compiler takes for a header.
  target_compile_options(palpation_flags INTERFACE $<$<CXX_COMPILER_ID:GNU>:-Wshadow=local -Wno-subobject-linkage>)
else()
  target_compile_options(palpation_flags INTERFACE -Wshadow)
endif()
if(PALPATION_WERROR)
  target_compile_options(palpation_flags INTERFACE -Werror)
endif()
if(PALPATION_SANITIZE)
  # Left out are checks of which AddressSanitizer traps the harm, or that x86 and CGAL's lists (which cast nodes to what they are not yet) trip over for
  # nothing: they took a third of the compiling (45 against 29 s of CPU for a piece of certainty, 23 without any sanitizer).
  set(palpation_sanitizers -fsanitize=${PALPATION_SANITIZE} -fno-sanitize=null,alignment,object-size,vptr)
  # -Wno-maybe-uninitialized: under its sanitizers GCC sees variables without values that are not there; the release build keeps the warning.
  target_compile_options(palpation_flags INTERFACE
    ${palpation_sanitizers} -fno-sanitize-recover=all -fno-omit-frame-pointer -g1
    $<$<CXX_COMPILER_ID:GNU>:-Wno-maybe-uninitialized>)
  target_compile_definitions(palpation_flags INTERFACE _GLIBCXX_ASSERTIONS)
  target_link_options(palpation_flags INTERFACE ${palpation_sanitizers})
endif()

# What a user of any part of the library compiles with. Eigen's alignment is part of the interface. Left alone it follows the vector instructions and
# AddressSanitizer, on the heap (who frees what the other allocated) and inside objects (where members lie): so both are fixed, the heap's at the
# widest there is.
function(palpation_interface target scope)
  target_include_directories(${target} ${scope}
    $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/include> $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
  target_compile_features(${target} ${scope} cxx_std_20)
  target_compile_definitions(${target} ${scope} EIGEN_MAX_ALIGN_BYTES=64 EIGEN_MAX_STATIC_ALIGN_BYTES=16)
  if(PALPATION_SANITIZE)
    target_link_options(${target} INTERFACE ${palpation_sanitizers})  # whoever links sanitized objects needs the runtimes
  endif()
endfunction()

# Third parties that are more than a target: VTK means the components in palpation_vtk_components; CGAL also keeps CGAL's own checks on in a release
# build, and is headers only, so that who uses the installed library needs no CGAL, only the number libraries below it. Boost is headers only.
# CGAL's -frounding-math stays in the folders that use CGAL.
function(palpation_third_party target party)
  if(party STREQUAL "VTK")
    list(TRANSFORM palpation_vtk_components PREPEND VTK:: OUTPUT_VARIABLE vtk_targets)
    target_link_libraries(${target} PRIVATE ${vtk_targets})
  elseif(party STREQUAL "CGAL")
    target_link_libraries(${target} PRIVATE $<BUILD_INTERFACE:CGAL::CGAL> $<INSTALL_INTERFACE:mpfr> $<INSTALL_INTERFACE:gmp>)
    target_compile_definitions(${target} PRIVATE CGAL_DEBUG)
  elseif(party STREQUAL "Boost")
    target_link_libraries(${target} PRIVATE $<BUILD_INTERFACE:Boost::headers>)
  else()
    target_link_libraries(${target} PRIVATE ${party})
  endif()
endfunction()

# palpation_folder(NAME PUBLIC targets... PRIVATE third parties...): the library palpation_NAME made of src/NAME/*.cpp; with BUILD_SHARED_LIBS its
# objects, of which palpation_whole() makes the one library that palpation_NAME then stands for.
function(palpation_folder name)
  cmake_parse_arguments(arg "" "" "PUBLIC;PRIVATE" ${ARGN})
  file(GLOB sources CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/src/${name}/*.cpp)
  if(BUILD_SHARED_LIBS)
    set(target palpation_${name}_objects)
    add_library(${target} OBJECT ${sources})
    set(arg_PUBLIC Eigen3::Eigen Threads::Threads)  # what a folder needs of those below it, whose objects it is linked with later
    add_library(palpation_${name} INTERFACE)
    target_link_libraries(palpation_${name} INTERFACE palpation)
    set_property(GLOBAL APPEND PROPERTY palpation_objects ${target})
    set_property(GLOBAL APPEND PROPERTY palpation_parties ${arg_PRIVATE})
  else()
    set(target palpation_${name})
    add_library(${target} STATIC ${sources})
    set_property(GLOBAL APPEND PROPERTY palpation_libraries ${target})
    set_target_properties(${target} PROPERTIES EXPORT_NAME ${name})
  endif()
  add_library(palpation::${name} ALIAS palpation_${name})
  palpation_unite(${target} ${sources})
  palpation_interface(${target} PUBLIC)
  target_include_directories(${target} PRIVATE ${PROJECT_SOURCE_DIR}/src)
  target_compile_definitions(${target} PRIVATE EIGEN_DONT_PARALLELIZE)
  target_link_libraries(${target} PUBLIC ${arg_PUBLIC} PRIVATE $<BUILD_INTERFACE:palpation_flags>)
  foreach(party IN LISTS arg_PRIVATE)
    palpation_third_party(${target} ${party})
  endforeach()
endfunction()

# The target palpation: all folders. Shared, it is one library, whose name in programs holds the minor version: before version 1 that may change names.
function(palpation_whole)
  if(NOT BUILD_SHARED_LIBS)
    add_library(palpation INTERFACE)
    target_link_libraries(palpation INTERFACE palpation_session palpation_robot)
  else()
    get_property(objects GLOBAL PROPERTY palpation_objects)
    get_property(parties GLOBAL PROPERTY palpation_parties)
    list(REMOVE_DUPLICATES parties)
    list(TRANSFORM objects REPLACE "(.+)" "$<TARGET_OBJECTS:\\1>")
    add_library(palpation SHARED ${objects})
    palpation_interface(palpation PUBLIC)
    target_link_libraries(palpation PUBLIC Eigen3::Eigen Threads::Threads PRIVATE $<BUILD_INTERFACE:palpation_flags>)
    foreach(party IN LISTS parties)
      palpation_third_party(palpation ${party})
    endforeach()
    target_link_options(palpation PRIVATE -Wl,--no-undefined)
    set_target_properties(palpation PROPERTIES VERSION ${PROJECT_VERSION} SOVERSION ${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR})
    set_property(GLOBAL PROPERTY palpation_libraries "")
  endif()
  add_library(palpation::palpation ALIAS palpation)
endfunction()
