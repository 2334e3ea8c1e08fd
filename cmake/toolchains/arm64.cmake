# Builds for 64-bit ARM on another Linux: Debian's g++-aarch64-linux-gnu, and qemu-user-static to run what was built.
set(CMAKE_SYSTEM_NAME Linux)
set(CMAKE_SYSTEM_PROCESSOR aarch64)
set(CMAKE_CXX_COMPILER aarch64-linux-gnu-g++)
set(CMAKE_EXE_LINKER_FLAGS_INIT -static) # needs no library of the other system
set(CMAKE_CROSSCOMPILING_EMULATOR qemu-aarch64-static)
