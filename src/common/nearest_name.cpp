// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/common/nearest_name.h"

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <vector>

namespace datmo {

namespace {

/// Minimum number of letters to change, delete or insert (Levenshtein 1966).
std::size_t editDistance(const std::string& from, const std::string& to) {
  std::vector<std::size_t> row(to.size() + 1);
  std::iota(row.begin(), row.end(), 0U);
  for (std::size_t i = 0; i < from.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i + 1;
    for (std::size_t j = 0; j < to.size(); ++j) {
      const std::size_t changed = diagonal + (from[i] == to[j] ? 0U : 1U);
      diagonal = row[j + 1];
      row[j + 1] = std::min({changed, row[j] + 1, row[j + 1] + 1});
    }
  }
  return row.at(to.size());
}

}  // namespace

std::string nearestName(const std::string& name, const std::set<std::string>& names) {
  return *std::min_element(names.begin(), names.end(),
                           [&name](const std::string& a, const std::string& b) {
                             return editDistance(name, a) < editDistance(name, b);
                           });
}

}  // namespace datmo
