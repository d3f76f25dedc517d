# The texts of --help and the manual pages.
#
# docs/help/evalcts*.txt contain the output of --help, so that the launcher can print it before the program is built. A test
# compares the texts with the program; the target help_texts rewrites them.
set(help_folder ${PROJECT_SOURCE_DIR}/docs/help)
set(write_help sh ${CMAKE_CURRENT_LIST_DIR}/write-help.sh $<TARGET_FILE:evalcts>)
add_custom_target(help_texts COMMAND ${write_help} ${help_folder} DEPENDS evalcts evalcts-lab VERBATIM)

set(help_now ${CMAKE_CURRENT_BINARY_DIR}/help)
add_test(NAME help.write COMMAND ${write_help} ${help_now})
add_test(NAME help.compare COMMAND sh -c "diff -ru --exclude='checkout*' '${help_folder}' '${help_now}' || \
{ echo 'The target help_texts rewrites docs/help.'; false; }")
set_tests_properties(help.write PROPERTIES FIXTURES_SETUP help)
set_tests_properties(help.compare PROPERTIES FIXTURES_REQUIRED help LABELS script)

# docs/known-bugs.md is written from suites/bugs; a test compares it.
set(known_bugs_page ${PROJECT_SOURCE_DIR}/docs/known-bugs.md)
add_custom_target(known_bugs COMMAND sh -c "'$<TARGET_FILE:evalcts>' bugs --known > '${known_bugs_page}'" DEPENDS evalcts VERBATIM)
add_test(NAME known_bugs.compare COMMAND sh -c "'$<TARGET_FILE:evalcts>' bugs --known | diff -u '${known_bugs_page}' - || \
{ echo 'The target known_bugs rewrites docs/known-bugs.md.'; false; }")
set_tests_properties(known_bugs.compare PROPERTIES LABELS script)

# Each command has a manual page. help2man takes the name of the page from the name of the program, so each command gets a
# script.
find_program(EVALCTS_HELP2MAN help2man)
if(NOT EVALCTS_HELP2MAN)
  message(STATUS "no help2man: there are no manual pages")
  return()
endif()
file(GLOB help_texts CONFIGURE_DEPENDS ${help_folder}/evalcts*.txt)
set(manual_folder ${CMAKE_CURRENT_BINARY_DIR}/manual)
set(manual_pages "")
foreach(text ${help_texts})
  get_filename_component(name ${text} NAME_WE)
  string(REGEX REPLACE "^evalcts-?" "" words ${name})
  string(REPLACE "-" " " words "${words}")
  file(STRINGS ${text} description LIMIT_COUNT 1)
  string(REPLACE "evalcts: " "" description "${description}")
  file(GENERATE OUTPUT ${manual_folder}/${name} CONTENT "#!/bin/sh\nexec '$<TARGET_FILE:evalcts>' ${words} \"$@\"\n"
       FILE_PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE)
  set(page ${manual_folder}/${name}.1)
  set(include ${PROJECT_SOURCE_DIR}/packaging/evalcts.h2m)
  add_custom_command(OUTPUT ${page} DEPENDS evalcts evalcts-lab ${text} ${include}
    COMMAND ${EVALCTS_HELP2MAN} --no-info --include=${include} --name=${description} "--source=evalcts ${PROJECT_VERSION}"
            --version-string=${PROJECT_VERSION} --output=${page} ${manual_folder}/${name} VERBATIM)
  list(APPEND manual_pages ${page})
endforeach()
add_custom_target(evalcts_manual ALL DEPENDS ${manual_pages})
install(FILES ${manual_pages} DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 COMPONENT evalcts)

find_program(EVALCTS_MAN man)
if(EVALCTS_MAN)
  # Tests that man prints all pages without warnings and that the page of `run` has its options.
  add_test(NAME manual WORKING_DIRECTORY ${manual_folder} COMMAND sh -c "for page in *.1; do \
LC_ALL=C ${EVALCTS_MAN} --warnings -l $page 2>>manual.log >$page.text; done; cat manual.log; test ! -s manual.log && \
grep -q 'write.-baseline' evalcts-run.1; status=$?; rm -f manual.log; exit $status")
  set_tests_properties(manual PROPERTIES LABELS script)
endif()
