// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

namespace datmo {

/// Requests to the nodelet manager /perception, by the names of nodelets without a slash.

/// Returns whether all of them are loaded.
bool areLoaded(const std::vector<std::string>& nodelets);

/// Returns whether a nodelet of this type was loaded.
bool loadNodelet(const std::string& nodelet, const std::string& type);

/// Returns whether it was loaded, and was unloaded.
bool unloadNodelet(const std::string& nodelet);

}  // namespace datmo
