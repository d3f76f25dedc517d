# Tests of the documentation and of the language of comments.
set(check_docs python3 ${CMAKE_CURRENT_LIST_DIR}/check_docs.py)
add_test(NAME docs.links COMMAND ${check_docs} links ${PROJECT_SOURCE_DIR})
set_tests_properties(docs.links PROPERTIES LABELS script)

# The commands on the pages start many processes: they get the machine for themselves.
if(TARGET drill_layer AND NOT EVALCTS_SANITIZE AND NOT EVALCTS_COVERAGE)
  add_test(NAME docs.commands COMMAND ${check_docs} commands ${PROJECT_SOURCE_DIR} $<TARGET_FILE:evalcts> $<TARGET_FILE:drill_layer>)
  set_tests_properties(docs.commands PROPERTIES LABELS gl TIMEOUT 1800 RUN_SERIAL ON SKIP_RETURN_CODE 77)
endif()
