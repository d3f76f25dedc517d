# Toolchain file: compiles for Windows on x86-64 with Debian's cross compiler and runs programs under Wine. Header-only
# libraries are those of this machine, as for aarch64 (aarch64.cmake). Programs need no library of the compiler.
set(CMAKE_SYSTEM_NAME Windows)
set(CMAKE_SYSTEM_PROCESSOR x86_64)
set(CMAKE_C_COMPILER x86_64-w64-mingw32-gcc-posix)
set(CMAKE_CXX_COMPILER x86_64-w64-mingw32-g++-posix)
set(CMAKE_RC_COMPILER x86_64-w64-mingw32-windres)
# windows.h, which GL/gl.h includes, would define common words as macros.
set(CMAKE_C_FLAGS_INIT "-idirafter /usr/include -DWIN32_LEAN_AND_MEAN -DNOMINMAX")
set(CMAKE_CXX_FLAGS_INIT "${CMAKE_C_FLAGS_INIT}")
set(CMAKE_EXE_LINKER_FLAGS_INIT "-static")
set(CMAKE_SHARED_LINKER_FLAGS_INIT "-static")
set(CMAKE_CROSSCOMPILING_EMULATOR wine)
list(PREPEND CMAKE_MODULE_PATH ${CMAKE_CURRENT_LIST_DIR}/cross)
set(CMAKE_Fortran_COMPILER NOTFOUND)
