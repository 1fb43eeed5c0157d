// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <string>

namespace datmo {

/// Factors to m, s and rad, by unit name.
using Units = std::map<std::string, double>;

/// Returns the units of a quantity: "speed", "turning" of wheels, "rate", "angle".
const Units& unitsOf(const std::string& quantity);

}  // namespace datmo
