// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

// Results of all wide functions (common/wide.h) for random numbers, by each of the two compiled
// versions: for AVX2, and for a processor without.
namespace datmo_avx2 {
std::vector<double> wideResults(std::uint32_t seed);
}
namespace datmo_default {
std::vector<double> wideResults(std::uint32_t seed);
}
