// SPDX-License-Identifier: BSD-3-Clause
#include "wide_results.h"
#include <gtest/gtest.h>

namespace datmo::wide_functions_test {
namespace {

/// Equal to the last bit, as wide.h says, and not only up to rounding: the same additions and
/// multiplications are done.
TEST(WideFunctions, ResultsDoNotDependOnTheProcessor) {
#if defined(__clang__)
  GTEST_SKIP() << "wide.h has no clones for Clang: there is one of each function alone";
#elif defined(__x86_64__)
  if (!__builtin_cpu_supports("avx2")) {
    GTEST_SKIP() << "this processor has no AVX2: what one with it does cannot be compared";
  }
  for (std::uint32_t seed = 1; seed <= 200; ++seed) {
    const std::vector<double> wide = datmo_avx2::wideResults(seed);
    ASSERT_GT(wide.size(), 500U);
    ASSERT_EQ(wide, datmo_default::wideResults(seed)) << "seed " << seed;
  }
#else
  GTEST_SKIP() << "no x86 processor: there is one of each function alone";
#endif
}

}  // namespace
}  // namespace datmo::wide_functions_test
