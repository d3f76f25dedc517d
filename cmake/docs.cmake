# Tests of the documentation and of the language of comments.
set(check_docs python3 ${CMAKE_CURRENT_LIST_DIR}/check_docs.py)
add_test(NAME docs.links COMMAND ${check_docs} links ${PROJECT_SOURCE_DIR})
add_test(NAME docs.programs COMMAND ${check_docs} programs ${PROJECT_SOURCE_DIR})
set_tests_properties(docs.links docs.programs PROPERTIES LABELS script)

# The commands of several pages run at once, one page on each core, so no other test runs at the same time.
if(TARGET drill_layer AND NOT EVALCTS_SANITIZE AND NOT EVALCTS_COVERAGE)
  add_test(NAME docs.commands COMMAND ${check_docs} commands ${PROJECT_SOURCE_DIR} $<TARGET_FILE:evalcts> $<TARGET_FILE:drill_layer>)
  set_tests_properties(docs.commands PROPERTIES LABELS gl TIMEOUT 3600 RUN_SERIAL ON SKIP_RETURN_CODE 77)
endif()

# A test of the comments in all files that git tracks. An archive of the sources has no list of these.
find_program(EVALCTS_GIT git)
if(EVALCTS_GIT AND EXISTS ${PROJECT_SOURCE_DIR}/.git)
  add_test(NAME docs.comments COMMAND python3 ${CMAKE_CURRENT_LIST_DIR}/check_comments.py ${PROJECT_SOURCE_DIR})
  set_tests_properties(docs.comments PROPERTIES LABELS script)
endif()

# The target that makes the API reference of the C headers; a warning is an error.
file(READ ${PROJECT_SOURCE_DIR}/docs/Doxyfile doxyfile)
file(GENERATE OUTPUT ${CMAKE_CURRENT_BINARY_DIR}/api/Doxyfile
     CONTENT "${doxyfile}OUTPUT_DIRECTORY = ${CMAKE_CURRENT_BINARY_DIR}/api\n")
set(api_reference doxygen ${CMAKE_CURRENT_BINARY_DIR}/api/Doxyfile)
add_custom_target(api_reference COMMAND ${api_reference} WORKING_DIRECTORY ${PROJECT_SOURCE_DIR} VERBATIM)
