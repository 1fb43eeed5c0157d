// SPDX-License-Identifier: BSD-3-Clause
// Arithmetic and array look-ups on several numbers at a time, for wide registers that many
// processors have but not all: compiled for both and selected at startup. Results are identical:
// the same additions and multiplications are done on more elements at a time, and AVX2 does not
// fuse them. If the compiler could fuse them (-march with FMA, AArch64), -ffp-contract=off prevents
// it.
#pragma once

/// Put before a function that spends its time in short loops over numbers. A test that compares the
/// two versions defines it itself.
#if defined(DATMO_FUSION_WIDE)
#elif defined(__GNUC__) && !defined(__clang__) && defined(__x86_64__) && defined(__linux__) && \
    !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define DATMO_FUSION_WIDE __attribute__((target_clones("avx2", "default")))
#else
#define DATMO_FUSION_WIDE  // other processors and systems; sanitizers, which start after the choice
                           // is made
#endif

namespace datmo {

/// Doubles for element-wise arithmetic, at any address.
using TwoDoubles
    __attribute__((vector_size(2 * sizeof(double)), aligned(alignof(double)), may_alias)) = double;
using FourDoubles
    __attribute__((vector_size(4 * sizeof(double)), aligned(alignof(double)), may_alias)) = double;

/// The doubles from this one on.
inline const TwoDoubles& two(const double* values) {
  return *reinterpret_cast<const TwoDoubles*>(values);
}
inline TwoDoubles& two(double* values) { return *reinterpret_cast<TwoDoubles*>(values); }
inline const FourDoubles& four(const double* values) {
  return *reinterpret_cast<const FourDoubles*>(values);
}
inline FourDoubles& four(double* values) { return *reinterpret_cast<FourDoubles*>(values); }

}  // namespace datmo
