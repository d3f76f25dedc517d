# Toolchain file: compiles for Linux on aarch64 with Debian's cross compiler and runs programs under QEMU. No packages of
# that architecture are needed: header-only libraries are those of this machine, whose headers are searched last, and the
# modules in cross/ use fmt as headers only and build GoogleTest from Debian's sources.
set(CMAKE_SYSTEM_NAME Linux)
set(CMAKE_SYSTEM_PROCESSOR aarch64)
set(CMAKE_C_COMPILER aarch64-linux-gnu-gcc)
set(CMAKE_CXX_COMPILER aarch64-linux-gnu-g++)
set(CMAKE_C_FLAGS_INIT "-idirafter /usr/include")
set(CMAKE_CXX_FLAGS_INIT "-idirafter /usr/include")
set(CMAKE_CROSSCOMPILING_EMULATOR qemu-aarch64 -L /usr/aarch64-linux-gnu)
list(PREPEND CMAKE_MODULE_PATH ${CMAKE_CURRENT_LIST_DIR}/cross)
# Otherwise CMake would find the Fortran compiler of this machine.
set(CMAKE_Fortran_COMPILER NOTFOUND)
