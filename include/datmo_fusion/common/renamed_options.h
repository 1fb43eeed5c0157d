// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <set>
#include <string>

namespace datmo {

/// Returns the current key, among `keys`, of an option that was renamed; none if `key` is not a
/// former key of any of them. Keys are full ones (`segmentation/longest_gap`); groups were renamed,
/// too.
std::optional<std::string> renamedOption(const std::string& key, const std::set<std::string>& keys);

}  // namespace datmo
