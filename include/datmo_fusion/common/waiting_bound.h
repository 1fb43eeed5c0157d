// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>

namespace datmo {

/// Of the samples of one source that wait for those of others, so that no rate fills the memory; at
/// 50 Hz those of more than a second, the longest that is waited (SourceMatcherOptions::max_wait).
inline constexpr std::size_t kMaxWaitingSamples = 64;

}  // namespace datmo
