// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>

namespace datmo {

/// Number of times that this program has called operator new, which allocation_count.cpp replaces.
/// Eigen's allocations for dynamically sized matrices are not seen.
std::size_t allocationCount();

}  // namespace datmo
