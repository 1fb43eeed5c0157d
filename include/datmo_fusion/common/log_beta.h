// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>

namespace datmo {

/// Logarithm of the beta function; `a` and `b` greater than 0.
inline double logBeta(double a, double b) {
  // std::lgamma writes a global variable that threads share.
  const auto log_gamma = [](double value) {
    int sign = 0;
    return lgamma_r(value, &sign);
  };
  return log_gamma(a) + log_gamma(b) - log_gamma(a + b);
}

}  // namespace datmo
