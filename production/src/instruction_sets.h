// Selects the instruction sets for which the kernels are compiled. Included before the headers of Highway.
#pragma once

// Only the headers of Highway are used; its assertions would need the library.
#define HWY_IS_DEBUG_BUILD 0
// A build may leave out further ones, to save time and space.
#ifndef GLEV_OMITTED_TARGETS
#define GLEV_OMITTED_TARGETS 0
#endif
// SSSE3 and AVX3_DL add no operations that the kernels use. Vectors of scalable size cannot be elements of
// arrays.
#define HWY_DISABLED_TARGETS                                                             \
  (HWY_SSSE3 | HWY_AVX3_DL | HWY_SVE | HWY_SVE2 | HWY_SVE_256 | HWY_SVE2_128 | HWY_RVV | \
   (GLEV_OMITTED_TARGETS))

// On processors other than x86, one instruction set is compiled, that of the compiler's flags.
// TOOLCHAIN_MISS_SYS_AUXV_H tells Highway that it cannot detect any at run time. Otherwise it would add
// +crypto by a pragma, which GCC does not apply to implicit member functions of structures with vectors, so
// that they do not compile.
#if !defined(__x86_64__) && !defined(__i386__)
#define HWY_COMPILE_ONLY_STATIC 1
#define TOOLCHAIN_MISS_SYS_AUXV_H 1
#endif
