// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>

namespace datmo {

inline double probabilityOf(double log_odds) { return 1.0 / (1.0 + std::exp(-log_odds)); }

/// `probability`: greater than 0 and less than 1.
inline double logOddsOf(double probability) { return std::log(probability / (1.0 - probability)); }

}  // namespace datmo
