// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>

namespace datmo {

/// Limit for the samples of one source that wait for those of others, so that no rate fills the
/// memory: more than a second at 50 Hz, the longest wait (SourceMatcherOptions::max_wait).
inline constexpr std::size_t kMaxWaitingSamples = 64;

}  // namespace datmo
