// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace datmo {

/// Variance of a uniform distribution over an interval of length 1; for length a it is a^2 times as
/// large.
inline constexpr double kUniformVariance = 1.0 / 12.0;

}  // namespace datmo
