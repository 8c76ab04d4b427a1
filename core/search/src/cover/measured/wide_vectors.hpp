// Hot loops for processors with wider vectors.
#pragma once

#include <cstdlib>

/// Compiles the following function once more for processors with AVX2; the loader picks the version. The results are
/// equal to the bit, as no operations are fused and none reordered. It is not used where sanitizers instrument what the
/// loader calls.
#if defined(__x86_64__) && defined(__GLIBC__) && defined(__GNUC__) && !defined(__clang__) &&                           \
    !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define FOAM_FOR_WIDE_VECTORS __attribute__((target_clones("avx2", "default")))
#else
#define FOAM_FOR_WIDE_VECTORS
#endif
