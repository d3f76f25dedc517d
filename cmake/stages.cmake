# The stages of `./evalcts test --all` that are more than a build and its tests. Each is one test, labelled with the name of
# its stage. `ctest --preset STAGE` selects it; without a preset ctest omits it, because it has a configuration of its own.
# CMakePresets.json says which build each stage needs; `cmake --workflow --preset STAGE` configures, builds and tests.
#   evalcts_stage(NAME SECONDS COMMAND [ARGUMENT]...)
# adds such a test with a time limit. Arguments must not contain semicolons, which would split them.
function(evalcts_stage name seconds)
  add_test(NAME stage.${name} CONFIGURATIONS Stage WORKING_DIRECTORY ${PROJECT_SOURCE_DIR} COMMAND ${ARGN})
  set_tests_properties(stage.${name} PROPERTIES LABELS ${name} TIMEOUT ${seconds})
endfunction()

# The target of the build presets of stages that need no build.
add_custom_target(evalcts_nothing)

# Checks whose result depends on the version of their tool: formatting, the spelling of all files that git tracks, and the warnings
# of the API reference. codespell takes the ignored words for mistakes: names, and a command that a test misspells.
evalcts_stage(lint-format 600 sh -c [=[find . \( -path './build*' -o -path './reports/out' -o -path './.*' \) -prune -o -type f \
  \( -name '*.cpp' -o -name '*.h' -o -name '*.hpp' -o -name '*.c' \) -print0 | xargs -0 clang-format-14 --dry-run --Werror]=])
evalcts_stage(lint-spelling 600 bash -o pipefail -c "git -c safe.directory='*' ls-files -z \
'*.md' '*.txt' '*.cpp' '*.h' '*.hpp' '*.c' '*.py' '*.cmake' '*.sh' '*.js' '*.h2m' '*requirements.json' evalcts \
| xargs -0 -r codespell --quiet-level 3 --ignore-words-list zink,kinf,kown,kno,fo,alltogether,upto,explian")
evalcts_stage(lint-api 600 ${api_reference})
set_tests_properties(stage.lint-format stage.lint-spelling stage.lint-api PROPERTIES LABELS lint)

# clang-tidy on every C and C++ file, in groups, because most of the time goes into headers. The sources of the evaluator library
# are read once, not as the later version that a test compiles.
evalcts_stage(tidy 21600 run-clang-tidy-14 -quiet -checks=-bugprone-suspicious-include -p ${CMAKE_BINARY_DIR}
  "^(?!.*later).*\\.(c|cpp|cxx)$")

# Repeated runs, shuffled runs and each test alone give the same verdicts and signatures, and so do warm, shuffled and fresh
# workers behind each legal variation.
evalcts_stage(stability 21600 python3 harness/tests/stability.py $<TARGET_FILE:evalcts>)

# Thorough depth gives no unexpected results. OSMesa runs in eight shards, because it takes more than an hour.
set(thorough run --depth thorough --strict --no-bugs --timeout 600)
foreach(implementation production reference)
  evalcts_stage(thorough-${implementation} 21600 $<TARGET_FILE:evalcts> ${thorough} --implementation ${implementation}
    --output ${CMAKE_BINARY_DIR}/thorough/${implementation})
  set_tests_properties(stage.thorough-${implementation} PROPERTIES LABELS thorough)
endforeach()
if(EVALCTS_OSMESA)
  foreach(part RANGE 1 8)
    evalcts_stage(thorough-osmesa-${part} 21600 $<TARGET_FILE:evalcts> ${thorough} --implementation osmesa --shard ${part}/8
      --output ${CMAKE_BINARY_DIR}/thorough/osmesa-${part})
    set_tests_properties(stage.thorough-osmesa-${part} PROPERTIES LABELS thorough)
  endforeach()
endif()

# Every injected fault is detected by a test of each requirement that it violates, and every requirement that tests decide
# is violated by a fault.
evalcts_stage(faults 21600 $<TARGET_FILE:evalcts> faults --complete --output ${CMAKE_BINARY_DIR}/faults)

# No test fails on conforming libraries that differ from the available ones, and typical faults in these are detected.
evalcts_stage(legal 21600 $<TARGET_FILE:evalcts> faults --legal --output ${CMAKE_BINARY_DIR}/legal)

# The workers for Windows, under Wine, and for aarch64, under QEMU.
evalcts_stage(wine 7200 bash harness/tests/wine.sh $<TARGET_FILE:evalcts>)
evalcts_stage(aarch64-suite 7200 bash harness/tests/aarch64_suite.sh $<TARGET_FILE:evalcts>)

# The pages in the distribution's browser. Selenium is a package of the distribution's Python, and the first Python on the
# PATH may be another one.
if(TARGET evalcts_reports_write_pages)
  evalcts_stage(browser 3600 /usr/bin/python3 reports/tests/browser_test.py $<TARGET_FILE:evalcts_reports_write_pages>
    --screenshots ${CMAKE_BINARY_DIR}/browser)
endif()

# The packages are installed and used in the smallest system that has apt; without root the stage ends after making them.
evalcts_stage(package 7200 sh -c [=[if [ $(id -u) != 0 ]
then echo 'only root can make a clean root: the packages were built but not tested'
else exec harness/packages/check.sh build/packages
fi]=])

# The parsers read mutated files for a minute, or for $EVALCTS_FUZZ_SECONDS.
if(TARGET parsers_fuzzer)
  evalcts_stage(fuzz 86400 harness/tests/parsers_fuzzer.sh $<TARGET_FILE:parsers_fuzzer> ${CMAKE_BINARY_DIR})
endif()

# Both commands of the README in a clean root of a Debian release. ctest does not return the exit code of a test, so the
# launcher reads it from build/STAGE.status: it is 77 if the root could not be made.
set(stages debian-12 debian-13 debian-unstable)
set(suites bookworm trixie sid)
foreach(stage suite IN ZIP_LISTS stages suites)
  evalcts_stage(${stage} 43200 sh -c "packaging/clean-root.sh ${suite} >build/${stage}.log 2>&1
status=$?
echo $status >build/${stage}.status
[ $status = 0 ] || tail -n 40 build/${stage}.log | sed 's/^/  /'
exit $status")
  set_tests_properties(stage.${stage} PROPERTIES SKIP_RETURN_CODE 77)
endforeach()

# The preset aarch64 also runs the tests of the library under the emulator. The cortex-a53 is an ARMv8.0 processor.
if(CMAKE_CROSSCOMPILING)
  foreach(processor max cortex-a53)
    evalcts_stage(aarch64-${processor} 21600 env QEMU_CPU=${processor} bash harness/tests/digest.sh
      ${CMAKE_CROSSCOMPILING_EMULATOR} $<TARGET_FILE:glevaluator_rounding>)
  endforeach()
endif()

# The preset coverage reports which lines of the project's own code the tests reach. It ignores the tests themselves and the
# injected faults, which run in the stage faults only. ctest runs these commands before and after the tests.
if(EVALCTS_COVERAGE)
  file(CONFIGURE OUTPUT ${CMAKE_BINARY_DIR}/CTestCustom.cmake @ONLY CONTENT [=[
set(CTEST_CUSTOM_PRE_TEST "find @CMAKE_BINARY_DIR@ -name *.gcda -delete")
set(CTEST_CUSTOM_POST_TEST "sh -c \"cd '@PROJECT_SOURCE_DIR@' && gcovr --root . --object-directory '@CMAKE_BINARY_DIR@' \
--exclude '.*/tests/' --exclude '.*/benchmarks/' --exclude '.*/examples/' --exclude '.*/faults/' --exclude '.*/mutations/' --exclude build/ \
--exclude-unreachable-branches --sort-percentage --print-summary\"")
]=])
endif()
