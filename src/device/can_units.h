// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <string>

namespace datmo {

/// By name, what one is in m, s and rad.
using Units = std::map<std::string, double>;

/// `quantity`: "speed", "turning" of wheels, "rate", "angle".
const Units& unitsOf(const std::string& quantity);

}  // namespace datmo
