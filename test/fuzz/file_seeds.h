// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

namespace datmo::fuzz {

struct FileSeed {
  std::string name;
  unsigned decoder = 0;  ///< index of what reads it, as in fuzz_files.cpp
  std::string bytes;
};

/// A valid file of each kind. Written to a temporary folder on the way.
std::vector<FileSeed> fileSeeds();

}  // namespace datmo::fuzz
