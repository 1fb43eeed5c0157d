// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <set>
#include <string>

namespace datmo {

/// The one of `names` that `name` was probably meant to be: with the fewest letters to change,
/// leave out or put in (Levenshtein 1966), the first by alphabet among equals. `names` must not be
/// empty.
std::string nearestName(const std::string& name, const std::set<std::string>& names);

}  // namespace datmo
