# Lists the test cases of a doctest executable and writes a file that declares them to ctest; runs after each build.
# cmake -D EXECUTABLE=... -D EMULATOR=wine64 -D PREFIX=03_mirror -D "LABELS=03;03_mirror" -D TIMEOUT=60 -D OUTPUT=...
#       -P discover_tests.cmake
# (doctest's own doctest_discover_tests loses all labels but one, and the space after the prefix.)
execute_process(COMMAND ${EMULATOR} ${EXECUTABLE} --list-test-cases OUTPUT_VARIABLE lines RESULT_VARIABLE code)
if(NOT code EQUAL 0)
    message(FATAL_ERROR "${EXECUTABLE} does not list its test cases: ${code}\n${lines}")
endif()

string(REPLACE "\r" "" lines "${lines}")

set(script "")
set(command "")
foreach(word IN LISTS EMULATOR EXECUTABLE)
    string(APPEND command " [==[${word}]==]")
endforeach()
while(lines MATCHES "^([^\n]*)\n(.*)$") # not a CMake list: a name may contain brackets
    set(name "${CMAKE_MATCH_1}")
    set(lines "${CMAKE_MATCH_2}")
    if(name STREQUAL "" OR name MATCHES "^====|^\\[doctest\\]")
        continue()
    endif()
    string(REPLACE "," "\\," filter "${name}") # a bare comma separates two filters
    string(APPEND script
        "add_test([==[${PREFIX}: ${name}]==] ${command} [==[--test-case=${filter}]==])\n"
        "set_tests_properties([==[${PREFIX}: ${name}]==] PROPERTIES LABELS \"${LABELS}\" TIMEOUT ${TIMEOUT}\n"
        "    SKIP_REGULAR_EXPRESSION [==[\\[skipped\\]]==])\n")
endwhile()
file(WRITE ${OUTPUT} "${script}")
