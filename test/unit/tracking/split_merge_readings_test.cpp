// SPDX-License-Identifier: BSD-3-Clause
// Alternative readings of a cluster's objects, and their weights.
#include <cmath>

#include "association_scene.h"
#include <gtest/gtest.h>

#include "datmo_fusion/common/class_belief.h"
#include "datmo_fusion/tracking/split_merge.h"

namespace datmo::split_merge_readings_test {
namespace {

Object box(double x, double y, double length, double width) {
  Object object = objectAt(x, y);
  object.box.length = length;
  object.box.width = width;
  for (const Point2& corner : object.box.corners()) {
    object.points.push_back(corner);
  }
  return object;
}

class SplitMergeReadings : public testing::Test {
 protected:
  void follow(const Object& object, bool confirmed = true) {
    const std::uint64_t number = cluster_.trees.size() + 1;
    Leaf leaf(Leaf::Nodes{}, object, 0, number, TargetOptions());
    if (confirmed) {
      leaf.target.confirm(number, true);
    }
    cluster_.trees.push_back({{leaf}});
    cluster_.hypotheses.resize(1);
    cluster_.hypotheses[0].leaf_of_tree.push_back(0);
  }

  void read(const std::vector<Object>& objects) {
    scan_ = source_.scan(objects);
    readings_.assign(1, {});
    for (std::size_t i = 0; i < objects.size(); ++i) {
      readings_[0].push_back(i);
    }
    for (TrackTree& tree : cluster_.trees) {
      tree.leaves[0].scores = scoresOf(tree.leaves[0].target, scan_, 0.9, association_);
    }
    addSplitAndMerged(cluster_, scan_, association_, options_, readings_);
  }

  bool isCandidate(std::size_t tree, std::size_t observation) const {
    for (const Candidate& candidate : cluster_.trees[tree].leaves[0].scores.candidates) {
      if (candidate.observation == observation) {
        return true;
      }
    }
    return false;
  }

  ScanSource source_;
  AssociationOptions association_;
  SplitMergeOptions options_;
  HypothesisCluster cluster_;
  AssociationScan scan_;
  std::vector<Interpretation> readings_;
};

TEST_F(SplitMergeReadings, PartsOfATargetAsOne) {
  follow(box(0.0, 0.0, 5.0, 2.0));
  Object front = box(1.7, 0.0, 1.6, 2.0);
  front.class_probabilities = reportedClass(ObjectClass::kPedestrian, 0.9);
  front.height = 1.5;
  read({box(-1.7, 0.0, 1.6, 2.0), front});
  ASSERT_EQ(readings_.size(), 2U);
  EXPECT_EQ(readings_[1], Interpretation{2});
  const Observation& whole = scan_.observations.at(2);
  EXPECT_EQ(whole.sources, (std::vector<std::size_t>{0, 1}));
  EXPECT_TRUE(whole.needsTarget());
  EXPECT_FALSE(whole.startsTarget());
  EXPECT_TRUE(whole.object.box.center.position().isZero(1e-12));
  EXPECT_NEAR(whole.object.box.length, 5.0, 1e-12);
  EXPECT_NEAR(whole.object.box.width, 2.0, 1e-12);
  EXPECT_EQ(whole.object.points.size(), 8U);
  EXPECT_EQ(whole.object.height, 1.5);
  EXPECT_EQ(whole.object.heading_variance, kUnknownHeadingVariance) << "it has the target's own";
  EXPECT_EQ(whole.object.class_probabilities, ClassProbabilities{}) << "a part is not of the class";
  EXPECT_TRUE(isCandidate(0, 2));
  // One target instead of two objects of no target, and one more object than things within its
  // reach.
  const Box2 target = cluster_.trees[0].leaves[0].target.box();
  const double area =
      (target.length + 2.0 * options_.margin) * (target.width + 2.0 * options_.margin);
  EXPECT_NEAR(whole.log_density,
              2.0 * std::log(source_.density()) - std::log(options_.split_probability / area),
              1e-9);
}

TEST_F(SplitMergeReadings, PartsAndCoversAreRelatedWithinTheGateOrNot) {
  Target target(box(0.0, 0.0, 5.0, 2.0), 0, 1, TargetOptions());
  const std::vector<Object> objects{box(-30.0, 0.0, 1.0, 1.0), box(-2.2, 0.0, 1.0, 1.0),
                                    box(2.0, 0.0, 9.0, 2.0), box(4.0, 0.0, 1.0, 1.0)};
  const AssociationScan scan = source_.scan(objects);
  EXPECT_TRUE(relatedObjects(target, scan, options_).empty()) << "not confirmed";
  target.confirm(1, true);
  EXPECT_EQ(relatedObjects(target, scan, options_), (std::vector<std::size_t>{1, 2}));
  options_.merge_probability = 0.0;
  EXPECT_EQ(relatedObjects(target, scan, options_), std::vector<std::size_t>{1});
  options_.merge_probability = 0.1;
  options_.split_probability = 0.0;
  EXPECT_EQ(relatedObjects(target, scan, options_), std::vector<std::size_t>{2});
}

TEST_F(SplitMergeReadings, NoAlternativeReadings) {
  follow(box(0.0, 0.0, 5.0, 2.0));
  read({box(0.0, 0.0, 5.0, 2.0)});
  EXPECT_EQ(readings_.size(), 1U) << "one object";
  read({});
  EXPECT_EQ(readings_.size(), 1U);
  read({box(-1.7, 0.0, 1.6, 2.0), box(30.0, 0.0, 1.6, 2.0)});
  EXPECT_EQ(readings_.size(), 1U) << "the other one is far away";
}

TEST_F(SplitMergeReadings, OnlyConfirmedTargetsAreSplit) {
  follow(box(0.0, 0.0, 5.0, 2.0), false);
  read({box(-1.7, 0.0, 1.6, 2.0), box(1.7, 0.0, 1.6, 2.0)});
  EXPECT_EQ(readings_.size(), 1U);
}

TEST_F(SplitMergeReadings, NoneOfAProbabilityOfZero) {
  options_.split_probability = 0.0;
  options_.merge_probability = 0.0;
  follow(box(0.0, 0.0, 5.0, 2.0));
  read({box(-1.7, 0.0, 1.6, 2.0), box(1.7, 0.0, 1.6, 2.0)});
  EXPECT_EQ(readings_.size(), 1U);
}

TEST_F(SplitMergeReadings, OneObjectAsTwoTargets) {
  follow(box(0.0, -0.6, 0.5, 0.5));
  follow(box(0.0, 0.6, 0.5, 0.5));
  Object both = box(0.0, 0.0, 0.5, 1.7);
  both.points = {Point2(-0.2, -0.8), Point2(0.2, -0.5), Point2(0.1, 0.4), Point2(-0.1, 0.9)};
  both.class_probabilities = reportedClass(ObjectClass::kVehicle, 0.9);
  both.side_variance.fill(0.01);
  read({both});
  ASSERT_EQ(readings_.size(), 2U);
  EXPECT_EQ(readings_[1], (Interpretation{1, 2}));
  const Observation& right = scan_.observations.at(1);
  const Observation& left = scan_.observations.at(2);
  EXPECT_EQ(right.sources, std::vector<std::size_t>{0});
  EXPECT_EQ(left.sources, std::vector<std::size_t>{0});
  EXPECT_TRUE(right.needsTarget() && left.needsTarget());
  EXPECT_EQ(right.object.points.size(), 2U);
  EXPECT_NEAR(right.object.box.center.y(), -0.65, 1e-12);
  EXPECT_NEAR(left.object.box.center.y(), 0.65, 1e-12);
  EXPECT_NEAR(left.object.box.width, 0.5, 1e-12);
  EXPECT_EQ(right.object.class_probabilities, ClassProbabilities{});
  const auto side = [](const Observation& o, BoxSide which) {
    return o.object.side_variance[static_cast<std::size_t>(which)];
  };
  EXPECT_EQ(side(right, BoxSide::kLeft), kHiddenSide) << "there begins the other one";
  EXPECT_EQ(side(right, BoxSide::kRight), 0.01);
  EXPECT_EQ(side(left, BoxSide::kRight), kHiddenSide);
  EXPECT_EQ(side(left, BoxSide::kLeft), 0.01);
  EXPECT_TRUE(isCandidate(0, 1));
  EXPECT_FALSE(isCandidate(0, 2));
  EXPECT_TRUE(isCandidate(1, 2));
  // Both together: one object for two, anywhere within it and the margin of 0.5 m about it.
  EXPECT_NEAR(right.log_density + left.log_density,
              std::log(source_.density()) - std::log(options_.merge_probability * 1.5 * 2.7), 1e-9);
}

TEST_F(SplitMergeReadings, AnObjectWithoutPointsIsNotDivided) {
  follow(box(0.0, -0.6, 0.5, 0.5));
  follow(box(0.0, 0.6, 0.5, 0.5));
  Object both = box(0.0, 0.0, 0.5, 1.7);
  both.points.clear();
  read({both});
  EXPECT_EQ(readings_.size(), 1U);
}

TEST_F(SplitMergeReadings, SeveralAtOnceAndNoMoreThanAllowed) {
  const auto twoVans = [this] {
    cluster_ = {};
    readings_.clear();
    follow(box(0.0, 0.0, 5.0, 2.0));
    follow(box(20.0, 0.0, 5.0, 2.0));
    read({box(-1.7, 0.0, 1.6, 2.0), box(1.7, 0.0, 1.6, 2.0), box(18.3, 0.0, 1.6, 2.0),
          box(21.7, 0.0, 1.6, 2.0)});
  };
  twoVans();
  ASSERT_EQ(readings_.size(), 4U);
  EXPECT_EQ(readings_[0], (Interpretation{0, 1, 2, 3}));
  EXPECT_EQ(readings_[1], (Interpretation{2, 3, 4}));
  EXPECT_EQ(readings_[2], (Interpretation{0, 1, 5}));
  EXPECT_EQ(readings_[3], (Interpretation{4, 5}));
  for (const int max : {1, 2, 3}) {
    options_.max_interpretations = max;
    twoVans();
    EXPECT_LE(readings_.size(), static_cast<std::size_t>(max));
  }
}

}  // namespace
}  // namespace datmo::split_merge_readings_test
