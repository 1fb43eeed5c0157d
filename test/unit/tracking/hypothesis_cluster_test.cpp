// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/tracking/hypothesis_cluster.h"

#include <algorithm>
#include <cmath>

#include "association_scene.h"
#include <gtest/gtest.h>

#include "datmo_fusion/tracking/hypothesis_pruning.h"

namespace datmo::hypothesis_cluster_test {
namespace {

using Nodes = std::vector<std::uint64_t>;

/// One leaf for each list of nodes, newest first.
TrackTree treeOf(std::uint64_t number, const std::vector<Nodes>& leaves) {
  TrackTree tree;
  for (const Nodes& nodes : leaves) {
    Leaf leaf(Leaf::Nodes{}, targetAt(0.0, 0.0, number));
    std::copy(nodes.begin(), nodes.end(), leaf.nodes.begin());
    tree.leaves.push_back(leaf);
  }
  return tree;
}

/// By probabilities that need not sum to 1.
GlobalHypothesis hypothesisOf(double weight, const std::vector<int>& leaf_of_tree) {
  return {std::log(weight), leaf_of_tree};
}

std::vector<std::uint64_t> numbersOf(const HypothesisCluster& cluster) {
  std::vector<std::uint64_t> numbers;
  for (const TrackTree& tree : cluster.trees) {
    numbers.push_back(tree.number());
  }
  return numbers;
}

void expectHypotheses(const HypothesisCluster& cluster, const std::vector<double>& probabilities,
                      const std::vector<std::vector<int>>& leaves) {
  ASSERT_EQ(cluster.hypotheses.size(), leaves.size());
  const std::vector<double> found = cluster.probabilities();
  for (std::size_t i = 0; i < leaves.size(); ++i) {
    EXPECT_EQ(cluster.hypotheses[i].leaf_of_tree, leaves[i]) << "hypothesis " << i;
    EXPECT_NEAR(found[i], probabilities[i], 1e-12) << "hypothesis " << i;
  }
  EXPECT_EQ(cluster.best().log_weight, 0.0);
}

TEST(HypothesisCluster, ProbabilitiesSumToOne) {
  HypothesisCluster cluster;
  cluster.hypotheses = {hypothesisOf(4.0, {}), hypothesisOf(2.0, {}), hypothesisOf(1.0, {})};
  const std::vector<double> probabilities = cluster.probabilities();
  EXPECT_NEAR(probabilities[0], 4.0 / 7.0, 1e-12);
  EXPECT_NEAR(probabilities[1], 2.0 / 7.0, 1e-12);
  EXPECT_NEAR(probabilities[2], 1.0 / 7.0, 1e-12);
}

TEST(HypothesisCluster, ASingleTargetIsCertain) {
  const HypothesisCluster cluster = singleTarget(treeOf(5, {{1}}));
  EXPECT_EQ(numbersOf(cluster), std::vector<std::uint64_t>{5});
  expectHypotheses(cluster, {1.0}, {{0}});
}

TEST(HypothesisCluster, CanonicalizeMergesEqualOnesSortsAndRemovesUnusedLeaves) {
  HypothesisCluster cluster;
  cluster.trees = {treeOf(1, {{1}, {2}, {3}}), treeOf(2, {{4}}), treeOf(3, {{5}, {6}})};
  // The second leaf of the first tree and the whole second tree are in no hypothesis.
  cluster.hypotheses = {hypothesisOf(0.3, {2, kAbsent, kAbsent}),
                        hypothesisOf(0.2, {0, kAbsent, 1}), hypothesisOf(0.15, {0, kAbsent, 1})};
  canonicalize(cluster);
  EXPECT_EQ(numbersOf(cluster), (std::vector<std::uint64_t>{1, 3}));
  expectHypotheses(cluster, {0.35 / 0.65, 0.3 / 0.65}, {{0, 0}, {1, kAbsent}});
  ASSERT_EQ(cluster.trees[0].leaves.size(), 2U);
  EXPECT_EQ(cluster.trees[0].leaves[0].nodes[0], 1U);
  EXPECT_EQ(cluster.trees[0].leaves[1].nodes[0], 3U);
  ASSERT_EQ(cluster.trees[1].leaves.size(), 1U);
  EXPECT_EQ(cluster.trees[1].leaves[0].nodes[0], 6U);
}

TEST(HypothesisCluster, MergedHasAllPairsBestFirst) {
  HypothesisCluster a;
  a.trees = {treeOf(1, {{1}, {2}})};
  a.hypotheses = {hypothesisOf(1.0, {1}), hypothesisOf(0.5, {0})};
  a.links = {{7, 1, 9}};
  HypothesisCluster b;
  b.trees = {treeOf(2, {{3}, {4}}), treeOf(3, {{5}})};
  b.hypotheses = {hypothesisOf(1.0, {0, 0}), hypothesisOf(0.1, {1, kAbsent})};
  b.links = {{8, 2, 3}};
  HypothesisCluster both = a;
  merge(b, 10, both);
  EXPECT_EQ(numbersOf(both), (std::vector<std::uint64_t>{1, 2, 3}));
  expectHypotheses(both, {1.0 / 1.65, 0.5 / 1.65, 0.1 / 1.65, 0.05 / 1.65},
                   {{1, 0, 0}, {0, 0, 0}, {1, 1, kAbsent}, {0, 1, kAbsent}});
  EXPECT_EQ(both.links.size(), 2U);

  HypothesisCluster few = a;
  merge(b, 2, few);
  expectHypotheses(few, {1.0 / 1.5, 0.5 / 1.5}, {{1, 0, 0}, {0, 0, 0}});
  EXPECT_EQ(few.trees[1].leaves.size(), 1U) << "the other one is in no pair that is left";
}

TEST(HypothesisCluster, PruningKeepsWhatAgreesWithTheBestNScansAgo) {
  HypothesisCluster cluster;
  cluster.trees = {treeOf(1, {{5, 3, 1}, {6, 3, 1}, {7, 4, 1}})};
  cluster.hypotheses = {hypothesisOf(0.5, {0}), hypothesisOf(0.3, {2}), hypothesisOf(0.2, {1})};
  HypothesisCluster two_ago = cluster;
  pruneHistory(two_ago.trees, two_ago.hypotheses, 2);
  EXPECT_EQ(two_ago.hypotheses.size(), 3U);
  HypothesisCluster one_ago = cluster;
  pruneHistory(one_ago.trees, one_ago.hypotheses, 1);
  expectHypotheses(one_ago, {0.5 / 0.7, 0.2 / 0.7}, {{0}, {1}});
  EXPECT_EQ(one_ago.trees[0].leaves[1].nodes[0], 6U);
  pruneHistory(cluster.trees, cluster.hypotheses, 0);
  expectHypotheses(cluster, {1.0}, {{0}});
  EXPECT_EQ(cluster.trees[0].leaves[0].nodes[0], 5U);
}

TEST(HypothesisCluster, TargetsThatDidNotExistThenAreNoDisagreement) {
  HypothesisCluster cluster;
  cluster.trees = {treeOf(1, {{5, 3}, {6, 3}}), treeOf(2, {{9, 0}})};
  cluster.hypotheses = {hypothesisOf(0.6, {0, kAbsent}), hypothesisOf(0.4, {1, 0})};
  pruneHistory(cluster.trees, cluster.hypotheses, 1);
  EXPECT_EQ(cluster.hypotheses.size(), 2U) << "it starts in the present scan";
  cluster.trees[1].leaves[0].nodes[1] = 8;
  pruneHistory(cluster.trees, cluster.hypotheses, 1);
  EXPECT_EQ(cluster.hypotheses.size(), 1U) << "it started one scan ago";
  EXPECT_EQ(numbersOf(cluster), std::vector<std::uint64_t>{1});
}

TEST(HypothesisCluster, RemovedLeavesMakeTheirTargetAbsentAndEqualHypothesesOne) {
  HypothesisCluster cluster;
  cluster.trees = {treeOf(1, {{1}, {2}}), treeOf(2, {{3}})};
  cluster.hypotheses = {hypothesisOf(0.5, {0, 0}), hypothesisOf(0.3, {0, kAbsent}),
                        hypothesisOf(0.2, {1, 0})};
  removeLeaves(cluster, [](const Target& target) { return target.number() == 2; });
  EXPECT_EQ(numbersOf(cluster), std::vector<std::uint64_t>{1});
  expectHypotheses(cluster, {0.8, 0.2}, {{0}, {1}});
  removeLeaves(cluster, [](const Target&) { return false; });
  expectHypotheses(cluster, {0.8, 0.2}, {{0}, {1}});
  removeLeaves(cluster, [](const Target&) { return true; });
  EXPECT_TRUE(cluster.trees.empty());
}

/// Three targets; the first two hypotheses differ in the observations of the first two, the third
/// one was observed or not in either case.
HypothesisCluster threeTargets() {
  HypothesisCluster cluster;
  cluster.trees = {treeOf(1, {{1}, {2}}), treeOf(2, {{3}, {4}}), treeOf(3, {{5}, {6}})};
  cluster.hypotheses = {hypothesisOf(0.7 * 0.6, {0, 0, 0}), hypothesisOf(0.3 * 0.6, {1, 1, 0}),
                        hypothesisOf(0.7 * 0.4, {0, 0, 1}), hypothesisOf(0.3 * 0.4, {1, 1, 1})};
  canonicalize(cluster);
  return cluster;
}

std::vector<HypothesisCluster> partsOf(const HypothesisCluster& cluster,
                                       std::uint64_t oldest_scan) {
  std::vector<HypothesisCluster> parts;
  split(cluster, oldest_scan, parts);
  return parts;
}

TEST(HypothesisCluster, SplitsIntoTargetsThatSharedNoRecentObject) {
  HypothesisCluster cluster = threeTargets();
  cluster.links = {{10, 1, 2}, {7, 2, 3}};
  const std::vector<HypothesisCluster> parts = partsOf(cluster, 8);
  ASSERT_EQ(parts.size(), 2U);
  EXPECT_EQ(numbersOf(parts[0]), (std::vector<std::uint64_t>{1, 2}));
  expectHypotheses(parts[0], {0.7, 0.3}, {{0, 0}, {1, 1}});
  EXPECT_EQ(parts[0].links.size(), 1U);
  EXPECT_EQ(numbersOf(parts[1]), std::vector<std::uint64_t>{3});
  expectHypotheses(parts[1], {0.6, 0.4}, {{0}, {1}});
  EXPECT_TRUE(parts[1].links.empty());
  EXPECT_EQ(partsOf(cluster, 7).size(), 1U) << "in the oldest scan that counts";
}

TEST(HypothesisCluster, TargetsStayLinkedThroughOneThatIsGone) {
  HypothesisCluster cluster = threeTargets();
  cluster.links = {{10, 9, 1}, {10, 9, 3}};
  const std::vector<HypothesisCluster> parts = partsOf(cluster, 8);
  ASSERT_EQ(parts.size(), 2U);
  EXPECT_EQ(numbersOf(parts[0]), (std::vector<std::uint64_t>{1, 3}));
  EXPECT_EQ(parts[0].links.size(), 2U);
  EXPECT_EQ(parts[0].hypotheses.size(), 4U);
}

TEST(HypothesisCluster, AnEmptyClusterStaysEmpty) {
  HypothesisCluster cluster;
  cluster.hypotheses = {hypothesisOf(1.0, {})};
  EXPECT_TRUE(partsOf(cluster, 0).empty());
}

}  // namespace
}  // namespace datmo::hypothesis_cluster_test
