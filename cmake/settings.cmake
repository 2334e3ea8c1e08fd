# How our own sources are compiled: rt::settings for all of them, rt::native for what need not run elsewhere.
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
# A designated initialiser names what differs from the defaults, and leaves the rest out on purpose.
target_compile_options(rt_settings INTERFACE -Wno-missing-field-initializers)
if(CMAKE_CXX_COMPILER_ID STREQUAL GNU AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
    target_compile_options(rt_settings INTERFACE -Wno-restrict) # false alarms of GCC 12 in "text" + std::string
endif()
# Rows of eight numbers are passed in another way without AVX than with it, which matters only between files that are
# compiled differently.
target_compile_options(rt_settings INTERFACE -Wno-psabi)
if(RAYSTEPS_WERROR)
    target_compile_options(rt_settings INTERFACE -Werror)
endif()

# a * b + c is never fused behind our back, so that every compiler makes the same picture, bit by bit.
rt_compile_option(rt_settings -ffp-contract=off)
# sqrt need not set errno, and no floating-point operation traps: faster, with the same results.
rt_compile_option(rt_settings -fno-math-errno)
rt_compile_option(rt_settings -fno-trapping-math)

if(RAYSTEPS_SANITIZE)
    target_compile_options(rt_settings INTERFACE
        -fsanitize=${RAYSTEPS_SANITIZE} -fno-sanitize-recover=all -fno-omit-frame-pointer)
    target_link_options(rt_settings INTERFACE -fsanitize=${RAYSTEPS_SANITIZE})
endif()

add_library(rt_native INTERFACE)
add_library(rt::native ALIAS rt_native)
if(RAYSTEPS_NATIVE)
    rt_compile_option(rt_native -march=native)
endif()

# The programs of the steps are small functions in headers, and a path calls dozens of them. With its usual limits g++
# stops pasting them into each other half-way. And a path gains nothing from what -O3 does beyond -O2: the programs are a
# little faster without, and so is the compiler.
add_library(rt_inlining INTERFACE)
add_library(rt::inlining ALIAS rt_inlining)
if(CMAKE_CXX_COMPILER_ID STREQUAL GNU)
    rt_compile_option(rt_inlining --param=max-inline-insns-single=400)
    rt_compile_option(rt_inlining --param=inline-unit-growth=200)
    target_compile_options(rt_inlining INTERFACE $<$<CONFIG:Release>:-O2>)
endif()
