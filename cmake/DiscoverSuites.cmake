# cmake -D PROGRAM=... -D PREFIX=... -D PROPERTIES=... -D OUTPUT=... -P DiscoverSuites.cmake
#
# Writes a file for CTest in which every suite of the GoogleTest program PROGRAM is a test PREFIX.SUITE. A process per
# suite and not per test, as gtest_discover_tests would have it: with sanitizers a start takes longer than most tests.
execute_process(COMMAND ${PROGRAM} --gtest_list_tests OUTPUT_VARIABLE listing COMMAND_ERROR_IS_FATAL ANY)
# Suites stand at the beginning of a line and end in a dot; their tests are indented.
string(REGEX MATCHALL "\n[^ \n]+\\." suites "\n${listing}")
set(script "")
foreach(suite ${suites})
  string(REGEX REPLACE "\n(.+)\\." "\\1" suite "${suite}")
  string(APPEND script "add_test([=[${PREFIX}.${suite}]=] [=[${PROGRAM}]=] [=[--gtest_filter=${suite}.*]=])\n"
                       "set_tests_properties([=[${PREFIX}.${suite}]=] PROPERTIES ${PROPERTIES})\n")
endforeach()
file(WRITE ${OUTPUT} "${script}")
