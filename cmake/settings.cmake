# Compiler options for our sources: rt::settings for all of them, rt::native for code that runs only on this machine.
include(CheckCXXCompilerFlag)

function(rt_compile_option target flag)
    string(MAKE_C_IDENTIFIER "accepts${flag}" accepted)
    check_cxx_compiler_flag(${flag} ${accepted})
    if(${accepted})
        target_compile_options(${target} INTERFACE ${flag})
    endif()
endfunction()

add_library(rt_settings INTERFACE)
add_library(rt::settings ALIAS rt_settings)
target_compile_options(rt_settings INTERFACE -Wall -Wextra -Wpedantic -Wshadow)
# A designated initialiser names only what differs from the defaults and omits the rest on purpose.
target_compile_options(rt_settings INTERFACE -Wno-missing-field-initializers)
if(CMAKE_CXX_COMPILER_ID STREQUAL GNU AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
    target_compile_options(rt_settings INTERFACE -Wno-restrict) # false alarms of GCC 12 for "text" + std::string
endif()
# Vectors of eight floats are passed differently with and without AVX. That matters only between files that are
# compiled with different options.
target_compile_options(rt_settings INTERFACE -Wno-psabi)
if(RAYSTEPS_WERROR)
    target_compile_options(rt_settings INTERFACE -Werror)
endif()

# a * b + c is never fused implicitly, so that every compiler renders the same image, bit by bit.
rt_compile_option(rt_settings -ffp-contract=off)
# sqrt does not set errno, and floating-point operations do not trap: faster, with the same results.
rt_compile_option(rt_settings -fno-math-errno)
rt_compile_option(rt_settings -fno-trapping-math)

# On Windows names of files are UTF-8, and programs run without the compiler's libraries beside them.
set(windows ${PROJECT_SOURCE_DIR}/cmake/windows)
if(MSVC)
    message(FATAL_ERROR "cl and clang-cl take other options; use clang++ (CXX=clang++, or the preset windows): docs/setup.md")
elseif(MINGW)
    execute_process(COMMAND ${CMAKE_RC_COMPILER} -I ${windows} ${windows}/utf8.rc ${PROJECT_BINARY_DIR}/utf8.obj
                    COMMAND_ERROR_IS_FATAL ANY)
    target_link_options(rt_settings INTERFACE -static ${PROJECT_BINARY_DIR}/utf8.obj)
elseif(WIN32)
    target_compile_definitions(rt_settings INTERFACE _CRT_SECURE_NO_WARNINGS)
    target_link_options(rt_settings INTERFACE -Wl,/manifest:embed -Wl,/manifestinput:${windows}/utf8.manifest)
endif()

if(RAYSTEPS_SANITIZE)
    target_compile_options(rt_settings INTERFACE
        -fsanitize=${RAYSTEPS_SANITIZE} -fno-sanitize-recover=all -fno-omit-frame-pointer)
    target_link_options(rt_settings INTERFACE -fsanitize=${RAYSTEPS_SANITIZE})
endif()

add_library(rt_native INTERFACE)
add_library(rt::native ALIAS rt_native)
if(RAYSTEPS_NATIVE)
    rt_compile_option(rt_native -march=native)
    if(MINGW AND CMAKE_CXX_COMPILER_ID STREQUAL GNU)
        # Its stack is aligned to 16 bytes, and GCC moves vectors of 32 as if it were aligned to 32 (GCC's bug 54412).
        rt_compile_option(rt_native -Wa,-muse-unaligned-vector-move)
    endif()
endif()

# The steps' programs consist of small functions in headers, and a path calls dozens of them. GCC's default inlining
# limits are too low for this code. -O3 brings a path nothing beyond -O2: with -O2 the programs are slightly faster,
# and so is the compiler.
add_library(rt_inlining INTERFACE)
add_library(rt::inlining ALIAS rt_inlining)
if(CMAKE_CXX_COMPILER_ID STREQUAL GNU)
    rt_compile_option(rt_inlining --param=max-inline-insns-single=400)
    rt_compile_option(rt_inlining --param=inline-unit-growth=200)
    target_compile_options(rt_inlining INTERFACE $<$<CONFIG:Release>:-O2>)
endif()
