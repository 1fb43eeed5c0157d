// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace datmo {

constexpr double square(double value) { return value * value; }

}  // namespace datmo
