# Builds for Windows on Linux: Debian's g++-mingw-w64-x86-64-posix, and wine64 to run what was built.
set(CMAKE_SYSTEM_NAME Windows)
set(CMAKE_SYSTEM_PROCESSOR AMD64)
set(CMAKE_CXX_COMPILER x86_64-w64-mingw32-g++-posix)
set(CMAKE_RC_COMPILER x86_64-w64-mingw32-windres)
find_program(RAYSTEPS_WINE NAMES wine64 wine PATHS /usr/lib/wine) # Debian keeps it there
if(RAYSTEPS_WINE)
    set(CMAKE_CROSSCOMPILING_EMULATOR ${RAYSTEPS_WINE})
endif()
