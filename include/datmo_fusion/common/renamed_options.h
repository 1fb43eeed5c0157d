// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <set>
#include <string>

namespace datmo {

/// The present key of an option that was renamed, among `keys`; none if `key` is not the former key
/// of any of them. Keys are complete (`segmentation/longest_gap`); groups were renamed, too.
std::optional<std::string> renamedOption(const std::string& key, const std::set<std::string>& keys);

}  // namespace datmo
