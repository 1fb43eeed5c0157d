// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace datmo {

/// Variance of a value that is equally likely anywhere in an interval of length 1; that of an
/// interval of length a is a^2 times as large.
inline constexpr double kUniformVariance = 1.0 / 12.0;

}  // namespace datmo
