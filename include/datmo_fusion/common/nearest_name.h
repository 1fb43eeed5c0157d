// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <set>
#include <string>

namespace datmo {

/// Returns the one of `names` that `name` was probably meant to be: the one at the smallest edit
/// distance (Levenshtein 1966), the first in alphabetical order on a tie. `names` must not be
/// empty.
std::string nearestName(const std::string& name, const std::set<std::string>& names);

}  // namespace datmo
