# Runs a program in an empty folder and compares what it prints, byte by byte, with a file. Numbers are text.
# cmake -DPROGRAM= -DARGUMENT= -DEXPECTED= -DWORK= -P compare_output.cmake
# WORK is emptied first; the program's output stays there as `printed`.
cmake_minimum_required(VERSION 3.25)

file(REMOVE_RECURSE "${WORK}")
file(MAKE_DIRECTORY "${WORK}")
set(printed "${WORK}/printed")
execute_process(COMMAND "${PROGRAM}" "${ARGUMENT}" WORKING_DIRECTORY "${WORK}" OUTPUT_FILE "${printed}" RESULT_VARIABLE result)
if(NOT result EQUAL 0)
  message(FATAL_ERROR "${PROGRAM} ended with ${result}")
endif()
if(NOT EXISTS "${EXPECTED}")
  message("If what the program printed is right: cp '${printed}' '${EXPECTED}'")
  message(FATAL_ERROR "Nothing to compare with")
endif()

execute_process(COMMAND "${CMAKE_COMMAND}" -E compare_files "${EXPECTED}" "${printed}" RESULT_VARIABLE differs OUTPUT_QUIET ERROR_QUIET)
if(NOT differs EQUAL 0)
  execute_process(COMMAND diff -u --label expected --label printed "${EXPECTED}" "${printed}" OUTPUT_VARIABLE difference ERROR_VARIABLE difference)
  message("${difference}\nIf the change is right, explain it and cp '${printed}' '${EXPECTED}'")
  message(FATAL_ERROR "The output changed")
endif()
