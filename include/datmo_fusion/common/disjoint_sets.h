// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <numeric>
#include <vector>

namespace datmo {

/// Groups of the numbers 0 to size - 1 that were joined, directly or through others (union-find).
class DisjointSets {
 public:
  explicit DisjointSets(std::size_t size) : parent_(size) {
    std::iota(parent_.begin(), parent_.end(), std::size_t{0});
  }

  /// Returns the smallest member of the group.
  std::size_t find(std::size_t member) {
    while (parent_[member] != member) {
      parent_[member] = parent_[parent_[member]];
      member = parent_[member];
    }
    return member;
  }

  void join(std::size_t a, std::size_t b) {
    a = find(a);
    b = find(b);
    if (a < b) {
      parent_[b] = a;
    } else {
      parent_[a] = b;
    }
  }

  /// Returns the members of each group of at least `min_size`, ascending; groups are ordered by
  /// their smallest member.
  std::vector<std::vector<std::size_t>> sets(std::size_t min_size = 1) {
    std::vector<std::size_t> sizes(parent_.size());  // at the index of the smallest member
    for (std::size_t member = 0; member < parent_.size(); ++member) {
      ++sizes[find(member)];
    }
    std::vector<std::vector<std::size_t>> result;
    std::vector<std::size_t> group_of(parent_.size());  // at the index of the smallest member
    for (std::size_t member = 0; member < parent_.size(); ++member) {
      const std::size_t least = find(member);
      if (sizes[least] < min_size) {
        continue;
      }
      if (least == member) {
        group_of[member] = result.size();
        result.emplace_back().reserve(sizes[member]);
      }
      result[group_of[least]].push_back(member);
    }
    return result;
  }

 private:
  std::vector<std::size_t> parent_;
};

}  // namespace datmo
