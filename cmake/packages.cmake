# The six header-only packages: the system's where installed, otherwise a pinned commit that is fetched.
# Each becomes a target that carries only the include path of its headers.
include(FetchContent)

# rt_package(glm HEADER glm/glm.hpp FIND glm TARGET glm::glm
#            REPOSITORY https://... COMMIT 40-digits FETCHED_INCLUDE folder-in-the-repository)
function(rt_package name)
    cmake_parse_arguments(PARSE_ARGV 1 arg "" "HEADER;SUFFIX;FIND;TARGET;REPOSITORY;COMMIT;FETCHED_INCLUDE" "")
    set(found "")
    if(NOT RAYSTEPS_FETCH)
        if(arg_FIND AND NOT CMAKE_CROSSCOMPILING)
            find_package(${arg_FIND} CONFIG QUIET)
        endif()
        if(arg_TARGET AND TARGET ${arg_TARGET})
            set(include $<TARGET_PROPERTY:${arg_TARGET},INTERFACE_INCLUDE_DIRECTORIES>)
            set(found "the system's ${${arg_FIND}_VERSION} (${${arg_FIND}_DIR})")
        else()
            find_path(${name}_INCLUDE_DIR ${arg_HEADER} PATH_SUFFIXES ${arg_SUFFIX})
            mark_as_advanced(${name}_INCLUDE_DIR)
            if(${name}_INCLUDE_DIR)
                set(include ${${name}_INCLUDE_DIR})
                if(CMAKE_CROSSCOMPILING AND include MATCHES "^/usr/(local/)?include$") # without this machine's own headers
                    string(REGEX REPLACE "/.*" "" part ${arg_HEADER})
                    file(MAKE_DIRECTORY ${PROJECT_BINARY_DIR}/packages)
                    file(CREATE_LINK ${include}/${part} ${PROJECT_BINARY_DIR}/packages/${part} SYMBOLIC)
                    set(include ${PROJECT_BINARY_DIR}/packages)
                endif()
                set(found "the system's (${include})")
            endif()
        endif()
    endif()
    if(NOT found)
        message(STATUS "Package ${name}: fetching ${arg_REPOSITORY} ${arg_COMMIT}")
        # A SOURCE_SUBDIR that does not exist makes CMake fetch the files without running their build scripts.
        FetchContent_Declare(${name} GIT_REPOSITORY ${arg_REPOSITORY} GIT_TAG ${arg_COMMIT} SOURCE_SUBDIR nowhere)
        FetchContent_MakeAvailable(${name})
        set(include ${${name}_SOURCE_DIR}/${arg_FETCHED_INCLUDE})
        set(found "fetched, ${arg_COMMIT}")
    endif()
    message(STATUS "Package ${name}: ${found}")
    add_library(rt_${name} INTERFACE)
    add_library(rt::${name} ALIAS rt_${name})
    target_include_directories(rt_${name} SYSTEM INTERFACE ${include})
    set(${name}_INCLUDE ${include} PARENT_SCOPE)
endfunction()

rt_package(glm HEADER glm/glm.hpp FIND glm TARGET glm::glm
    REPOSITORY https://github.com/g-truc/glm.git
    COMMIT 0af55ccecd98d4e5a8d1fad7de25ba429d60e863) # 1.0.1
target_compile_definitions(rt_glm INTERFACE GLM_FORCE_EXPLICIT_CTOR)

rt_package(stb HEADER stb_image.h SUFFIX stb
    REPOSITORY https://github.com/nothings/stb.git
    COMMIT 31c1ad37456438565541f4919958214b6e762fb4) # image 2.30
# Before 2.28, stb_image writes out of bounds on a crafted JPEG. libjpeg then reads JPEGs, if the system has it.
file(STRINGS ${stb_INCLUDE}/stb_image.h stb_version LIMIT_COUNT 1 REGEX "stb_image - v[0-9.]+")
string(REGEX MATCH "v([0-9.]+)" stb_version "${stb_version}")
if(CMAKE_MATCH_1 VERSION_GREATER_EQUAL 2.28)
    target_compile_definitions(rt_stb INTERFACE RT_STB_JPEG=1)
else()
    find_package(JPEG QUIET)
    if(JPEG_FOUND)
        message(STATUS "Package jpeg: the system's ${JPEG_VERSION} (${JPEG_INCLUDE_DIR})")
        target_compile_definitions(rt_stb INTERFACE RT_LIBJPEG=1)
        target_link_libraries(rt_stb INTERFACE JPEG::JPEG)
    else()
        message(STATUS "stb_image ${CMAKE_MATCH_1} does not read every JPEG safely, and there is no libjpeg: JPEG "
                       "textures are left out (on Debian: apt-get install libjpeg62-turbo-dev)")
    endif()
endif()

rt_package(tinyobj HEADER tiny_obj_loader.h FIND tinyobjloader TARGET tinyobjloader::tinyobjloader
    REPOSITORY https://github.com/tinyobjloader/tinyobjloader.git
    COMMIT 2945a967c5303b2c8c14174117c45f3302591150)

rt_package(cli11 HEADER CLI/CLI.hpp FIND CLI11 TARGET CLI11::CLI11 FETCHED_INCLUDE include
    REPOSITORY https://github.com/CLIUtils/CLI11.git
    COMMIT 6c7b07a878ad834957b98d0f9ce1dbe0cb204fc9) # 2.4.2

rt_package(json HEADER nlohmann/json.hpp FIND nlohmann_json TARGET nlohmann_json::nlohmann_json FETCHED_INCLUDE include
    REPOSITORY https://github.com/nlohmann/json.git
    COMMIT 9cca280a4d0ccf0c08f47a99aa71d1b0e52f8d03) # 3.11.3

if(RAYSTEPS_TESTS)
    rt_package(doctest HEADER doctest/doctest.h FIND doctest TARGET doctest::doctest
        REPOSITORY https://github.com/doctest/doctest.git
        COMMIT 1da23a3e8119ec5cce4f9388e91b065e20bf06f5) # 2.4.12
endif()
