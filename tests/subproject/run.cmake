# Configures a project that takes the library's sources in, once for static libraries and once for a shared one, and compiles its one source; the
# library itself is built elsewhere often enough.
# cmake -DSOURCE= -DPALPATION_SOURCE= -DWORK= -DCOMPILER= -DMAKE_PROGRAM= -P run.cmake
# WORK is emptied first.
cmake_minimum_required(VERSION 3.25)

file(REMOVE_RECURSE "${WORK}")
foreach(shared OFF ON)
  set(tree "${WORK}/shared-${shared}")
  foreach(step configure compile)
    if(step STREQUAL "configure")
      set(command "${CMAKE_COMMAND}" -S "${SOURCE}" -B "${tree}" -G Ninja "-DCMAKE_MAKE_PROGRAM=${MAKE_PROGRAM}" "-DCMAKE_CXX_COMPILER=${COMPILER}"
          "-DPALPATION_SOURCE=${PALPATION_SOURCE}" -DBUILD_SHARED_LIBS=${shared})
    elseif(shared)
      break()  # the same source, the same flags
    else()
      set(command "${CMAKE_COMMAND}" --build "${tree}" --target CMakeFiles/consumer.dir/main.cpp.o)
    endif()
    execute_process(COMMAND ${command} RESULT_VARIABLE result OUTPUT_VARIABLE output ERROR_VARIABLE output)
    if(NOT result EQUAL 0)
      message(FATAL_ERROR "${output}\nBUILD_SHARED_LIBS=${shared}: could not ${step}: ${result}")
    endif()
  endforeach()
endforeach()
file(REMOVE_RECURSE "${WORK}")
