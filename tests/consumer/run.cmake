# Installs a build tree into a prefix of its own, then builds and runs the consumer against it with flags that differ from the library's in
# all that could matter: the widest vector instructions of this machine, AddressSanitizer, no optimization, assertions on.
# cmake -DBUILD_TREE= -DCONFIG= -DSOURCE= -DWORK= -DCOMPILER= -DGENERATOR= -DMAKE_PROGRAM= -DLIBDIR= -DSUPPRESSIONS= -P run.cmake
# WORK is emptied first.
cmake_minimum_required(VERSION 3.25)

function(step what)
  execute_process(WORKING_DIRECTORY "${WORK}" COMMAND ${CMAKE_COMMAND} -E env --unset=DESTDIR --unset=CXXFLAGS --unset=LDFLAGS ${ARGN}
                  RESULT_VARIABLE result OUTPUT_VARIABLE output ERROR_VARIABLE output)
  if(NOT result EQUAL 0)
    message("${output}")
    message(FATAL_ERROR "The consumer test failed to ${what}: ${result}")
  endif()
  set(output "${output}" PARENT_SCOPE)
endfunction()

file(REMOVE_RECURSE "${WORK}")
file(MAKE_DIRECTORY "${WORK}")
step("install the library" "${CMAKE_COMMAND}" --install "${BUILD_TREE}" --config "${CONFIG}" --prefix "${WORK}/prefix")
step("configure" "${CMAKE_COMMAND}" -S "${SOURCE}" -B "${WORK}/build" -G "${GENERATOR}"
     "-DCMAKE_MAKE_PROGRAM=${MAKE_PROGRAM}" "-DCMAKE_CXX_COMPILER=${COMPILER}" -DCMAKE_BUILD_TYPE=Debug
     "-DCMAKE_CXX_FLAGS=-march=native -fsanitize=address -Wall -Wextra -Werror"
     "-Dpalpation_DIR=${WORK}/prefix/${LIBDIR}/cmake/palpation")
step("build" "${CMAKE_COMMAND}" --build "${WORK}/build" --config Debug)
step("run" "LSAN_OPTIONS=print_suppressions=0:suppressions='${SUPPRESSIONS}'" "${WORK}/build/consumer")

set(expected "25 x 50 mm of tissue: 1250.000 mm2\n")
if(NOT output STREQUAL expected)
  message(FATAL_ERROR "The consumer printed\n${output}instead of\n${expected}")
endif()
message("${output}")
file(REMOVE_RECURSE "${WORK}")  # the libraries are large
