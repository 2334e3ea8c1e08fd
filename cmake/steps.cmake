# Functions that declare the programs and checks of the steps.
# add_step(01_spheres): the program of a step, its checks (one executable per file tests/01_spheres/*.cpp; those named
# ..._statistics are slow) and the comparison with its reference image.
# add_checks(test_common common "labels" sources...): a doctest executable; each test case is a ctest "common: ...".
# A check that cannot run on a machine prints "[skipped]" and the reason.

# A learner's workshop/03_mirror/mirror.h replaces steps/03_mirror/mirror.h. A new file earlier on the include path
# does not trigger a rebuild on its own, so every target that includes such headers gets their names as a compile
# definition, which does. Only headers that exist in steps/ count, and each is globbed by name: CMake cannot handle
# arbitrary file names, such as a".h.
file(GLOB step_headers CONFIGURE_DEPENDS RELATIVE ${PROJECT_SOURCE_DIR}/steps steps/*/*.h)
list(TRANSFORM step_headers PREPEND workshop/ OUTPUT_VARIABLE places)
file(GLOB workshop_headers CONFIGURE_DEPENDS RELATIVE ${PROJECT_SOURCE_DIR}/workshop ${places})

# Follows the #include lines of the sources. `own` is set to the workshop headers among the included files.
function(find_includes sources own)
    set(own_headers "")
    set(met "")
    set(queue ${sources})
    while(queue)
        list(POP_FRONT queue file)
        file(STRINGS ${file} lines REGEX "^[ \t]*#[ \t]*include[ \t]*\"([0-9][0-9]_|tests/|tools/)[^]\";#$[]*\"")
        foreach(line IN LISTS lines)
            string(REGEX REPLACE "^[^\"]*\"([^\"]*)\".*$" "\\1" header "${line}")
            foreach(folder workshop/ steps/ "")
                if(NOT header IN_LIST met AND EXISTS ${PROJECT_SOURCE_DIR}/${folder}${header})
                    list(APPEND met ${header})
                    list(APPEND queue ${PROJECT_SOURCE_DIR}/${folder}${header})
                endif()
            endforeach()
        endforeach()
    endwhile()
    foreach(header IN LISTS met)
        if(header IN_LIST workshop_headers)
            list(APPEND own_headers ${header})
        endif()
    endforeach()
    set(${own} "${own_headers}" PARENT_SCOPE)
endfunction()

function(use_steps target)
    target_link_libraries(${target} PRIVATE raysteps::accel models)
    target_include_directories(${target} BEFORE PRIVATE ${PROJECT_SOURCE_DIR}/workshop ${PROJECT_SOURCE_DIR}/steps)
    get_target_property(sources ${target} SOURCES)
    list(FILTER sources EXCLUDE REGEX "<") # object files
    list(TRANSFORM sources PREPEND ${CMAKE_CURRENT_SOURCE_DIR}/ REGEX "^[^/]")
    find_includes("${sources}" own)
    if(own)
        string(REPLACE ";" ", " own "${own}")
        target_compile_definitions(${target} PRIVATE "RT_WORKSHOP=\"${own}\"")
        target_compile_options(${target} PRIVATE -Wno-unused -Wno-unused-parameter) # for unfinished functions
    endif()
endfunction()

# Declares a target whose precompiled header others reuse: parse_ahead(test_pch tests/pch.h). They must be compiled
# with the same options.
function(parse_ahead target header)
    set(source ${PROJECT_BINARY_DIR}/${target}.cpp)
    file(CONFIGURE OUTPUT ${source} CONTENT "// Only ${header} is wanted, parsed ahead.\n")
    add_library(${target} OBJECT ${source})
    target_link_libraries(${target} PRIVATE common rt::native ${ARGN})
    target_precompile_headers(${target} PRIVATE ${PROJECT_SOURCE_DIR}/${header})
endfunction()

function(add_checks target prefix labels)
    set(sources ${ARGN})
    if(NOT RAYSTEPS_TESTS OR NOT sources OR NOT TARGET common)
        return()
    endif()
    if(NOT TARGET test_main) # compiles doctest's own code once
        add_library(test_main OBJECT ${PROJECT_SOURCE_DIR}/tests/main.cpp)
        target_link_libraries(test_main PRIVATE rt::settings rt::native rt::doctest)
        target_include_directories(test_main PRIVATE ${PROJECT_SOURCE_DIR})
        parse_ahead(test_pch tests/pch.h rt::doctest)
        target_compile_options(test_pch PRIVATE ${quickly_compiled})
    endif()
    add_executable(${target} ${sources} $<TARGET_OBJECTS:test_main>)
    set_target_properties(${target} PROPERTIES UNITY_BUILD OFF) # files of checks have small helpers of the same names
    target_link_libraries(${target} PRIVATE common rt::native rt::doctest)
    use_steps(${target})
    if(NOT "statistics" IN_LIST labels) # a learner waits for the compiler; statistics take long to run, not to compile
        target_compile_options(${target} PRIVATE ${quickly_compiled})
        target_precompile_headers(${target} REUSE_FROM test_pch)
    endif()
    if(TARGET built_assets)
        add_dependencies(${target} built_assets)
    endif()
    set(timeout 60)
    if("statistics" IN_LIST labels OR RAYSTEPS_SANITIZE)
        set(timeout 300)
    endif()
    set(script ${PROJECT_BINARY_DIR}/${target}_tests.cmake)
    add_custom_command(TARGET ${target} POST_BUILD BYPRODUCTS ${script} VERBATIM
        COMMAND ${CMAKE_COMMAND} -D EXECUTABLE=$<TARGET_FILE:${target}> -D "EMULATOR=${CMAKE_CROSSCOMPILING_EMULATOR}" -D PREFIX=${prefix} -D "LABELS=${labels}"
                -D TIMEOUT=${timeout} -D OUTPUT=${script} -P ${PROJECT_SOURCE_DIR}/cmake/discover_tests.cmake)
    if(NOT EXISTS ${script}) # until it is built
        file(WRITE ${script} "add_test(\"${prefix}: ${target} is not built\" ${target})\n")
    endif()
    set_property(DIRECTORY ${PROJECT_SOURCE_DIR} APPEND PROPERTY TEST_INCLUDE_FILES ${script})
    add_dependencies(checks ${target})
endfunction()

# Declares a check that is a script for bash; it ends with 77 if it cannot run on a machine. Windows has no bash that
# knows its paths, and a foreign program is no command for one: there the check is skipped.
function(add_script_check name labels timeout script)
    if(WIN32 OR CMAKE_CROSSCOMPILING)
        add_test(NAME "${name}" COMMAND ${CMAKE_COMMAND} -E echo "[skipped] ${script} needs bash")
    else()
        add_test(NAME "${name}" COMMAND bash ${PROJECT_SOURCE_DIR}/${script} ${ARGN}
                 WORKING_DIRECTORY ${PROJECT_SOURCE_DIR})
    endif()
    set_tests_properties("${name}" PROPERTIES LABELS "${labels}" TIMEOUT ${timeout} SKIP_RETURN_CODE 77
                         SKIP_REGULAR_EXPRESSION "\\[skipped\\]")
endfunction()

# Declares the checks in tests/NAME, with further sources: the executable test_NAME, and the target checks_NAME,
# which builds all they need.
function(add_room_checks name)
    file(GLOB_RECURSE sources CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/tests/${name}/*.cpp)
    add_checks(test_${name} ${name} ${name} ${sources} ${ARGN})
    add_custom_target(checks_${name})
    if(TARGET test_${name})
        add_dependencies(checks_${name} test_${name})
    endif()
endfunction()

function(add_step name)
    file(GLOB source CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/steps/${name}/main.cpp)
    if(NOT TARGET common OR NOT source)
        return() # not written yet
    endif()
    string(SUBSTRING ${name} 0 2 number)

    # Ninja compiles targets in the order of their declaration, and a learner waits for the checks first.
    add_custom_target(checks_${name})
    # One executable per file, so that a learner waits only for the checks of the saved file.
    file(GLOB sources CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/tests/${name}/*.cpp)
    foreach(source IN LISTS sources)
        get_filename_component(stem ${source} NAME_WE)
        set(labels ${number} ${name})
        if(stem MATCHES "statistics$")
            if(RAYSTEPS_SANITIZE)
                continue() # slow, and they run the same code as the other checks
            endif()
            list(APPEND labels statistics)
        endif()
        add_checks(test_${name}_${stem} ${name} "${labels}" ${source})
        if(TARGET test_${name}_${stem})
            add_dependencies(checks_${name} test_${name}_${stem})
        endif()
    endforeach()

    if(NOT TARGET step_pch)
        parse_ahead(step_pch common/pch.h rt::inlining)
    endif()
    add_executable(${name} ${source})
    target_link_libraries(${name} PRIVATE common rt::native rt::inlining)
    target_precompile_headers(${name} REUSE_FROM step_pch)
    use_steps(${name})
    if(TARGET built_assets)
        add_dependencies(${name} built_assets)
    endif()
    add_dependencies(programs ${name})
    add_dependencies(checks_${name} ${name})

    if(RAYSTEPS_TESTS AND TARGET compare)
        add_dependencies(checks_${name} compare)
        set(test "${name}: render agrees with its reference")
        add_test(NAME "${test}" COMMAND ${CMAKE_COMMAND} -D NAME=${name} -D PROGRAM=$<TARGET_FILE:${name}>
            -D COMPARE=$<TARGET_FILE:compare> -D "EMULATOR=${CMAKE_CROSSCOMPILING_EMULATOR}"
            -D REFERENCES=${PROJECT_SOURCE_DIR}/assets/reference -D OUT=${PROJECT_BINARY_DIR}/tested
            -P ${PROJECT_SOURCE_DIR}/cmake/reference.cmake)
        # The render uses every core: PROCESSORS keeps ctest -j from running other tests beside it.
        cmake_host_system_information(RESULT cores QUERY NUMBER_OF_LOGICAL_CORES)
        set_tests_properties("${test}" PROPERTIES LABELS "${number};${name};reference"
                             SKIP_REGULAR_EXPRESSION "\\[skipped\\]" TIMEOUT 300 PROCESSORS ${cores})
    endif()
endfunction()
