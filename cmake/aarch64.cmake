# Toolchain file: cross compilation for Linux on aarch64 by Debian's compiler, execution by QEMU. No package of the other
# architecture is needed: the header-only libraries are those of this machine, whose headers are searched last, and
# aarch64/ builds the others from the sources that Debian has.
set(CMAKE_SYSTEM_NAME Linux)
set(CMAKE_SYSTEM_PROCESSOR aarch64)
set(CMAKE_C_COMPILER aarch64-linux-gnu-gcc)
set(CMAKE_CXX_COMPILER aarch64-linux-gnu-g++)
set(CMAKE_C_FLAGS_INIT "-idirafter /usr/include")
set(CMAKE_CXX_FLAGS_INIT "-idirafter /usr/include")
set(CMAKE_CROSSCOMPILING_EMULATOR qemu-aarch64 -L /usr/aarch64-linux-gnu)
list(PREPEND CMAKE_MODULE_PATH ${CMAKE_CURRENT_LIST_DIR}/aarch64)
# CMake would take this machine's compiler and MPI.
set(CMAKE_Fortran_COMPILER NOTFOUND)
set(CMAKE_DISABLE_FIND_PACKAGE_MPI ON)
