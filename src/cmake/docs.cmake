# `cmake --build BUILD --target docs` makes the pages of the library's headers, in BUILD/docs/html.
find_program(PALPATION_DOXYGEN NAMES doxygen)
configure_file(src/cmake/Doxyfile.in ${PROJECT_BINARY_DIR}/Doxyfile @ONLY)
if(PALPATION_DOXYGEN)
  add_custom_target(docs COMMAND ${PALPATION_DOXYGEN} ${PROJECT_BINARY_DIR}/Doxyfile WORKING_DIRECTORY ${PROJECT_BINARY_DIR} VERBATIM)
endif()
