// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/common/disjoint_sets.h"

#include <gtest/gtest.h>

namespace datmo::disjoint_sets_test {
namespace {

using Sets = std::vector<std::vector<std::size_t>>;

TEST(DisjointSets, EachByItselfAtFirst) {
  EXPECT_EQ(DisjointSets(3).sets(), (Sets{{0}, {1}, {2}}));
  EXPECT_TRUE(DisjointSets(0).sets().empty());
}

TEST(DisjointSets, JoinsThroughOthersWhateverTheOrder) {
  DisjointSets groups(6);
  groups.join(5, 3);
  groups.join(1, 5);
  groups.join(3, 1);
  groups.join(0, 4);
  EXPECT_EQ(groups.sets(), (Sets{{0, 4}, {1, 3, 5}, {2}}));
  EXPECT_EQ(groups.sets(3), (Sets{{1, 3, 5}})) << "of three or more";
  EXPECT_EQ(groups.find(5), 1U) << "the least of the group";
}

}  // namespace
}  // namespace datmo::disjoint_sets_test
