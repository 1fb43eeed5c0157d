// SPDX-License-Identifier: BSD-3-Clause
// How often a step of the tracker, and its association alone, allocate memory when all objects have
// tracks.

#include <cstddef>
#include <vector>

#include "allocation_count.h"
#include "association_scene.h"
#include <gtest/gtest.h>

#include "datmo_fusion/tracking/multiple_hypotheses.h"
#include "datmo_fusion/tracking/nearest_neighbor.h"

namespace datmo::tracking_memory_test {
namespace {

constexpr double kPeriod = 0.1;  // s
constexpr double kSpeed = 8.0;   // m/s
constexpr int kTargets = 50;
constexpr int kWarmUp = 40;  // scans
constexpr int kScans = 20;

/// Cyclists side by side, far enough apart that no object could belong to two of them.
std::vector<Object> cyclists(int scan) {
  std::vector<Object> objects;
  for (int i = 0; i < kTargets; ++i) {
    objects.push_back(objectAt(kSpeed * kPeriod * scan, 20.0 * i, DynamicState::kMoving));
  }
  return objects;
}

/// Per target and scan, in the steady state.
struct Counts {
  double predict;
  double associate;
};

Counts countsOf(TargetSet& targets) {
  ScanSource source;
  Counts counts{};
  for (int i = 0; i < kWarmUp + kScans; ++i) {
    AssociationScan scan = source.scan(cyclists(i));
    const std::size_t before = allocationCount();
    targets.predict(kPeriod, scan);
    const std::size_t predicted = allocationCount();
    targets.associate(scan, StepBudget());
    if (i >= kWarmUp) {
      counts.predict += static_cast<double>(predicted - before) / (kTargets * kScans);
      counts.associate += static_cast<double>(allocationCount() - predicted) / (kTargets * kScans);
    } else {
      for (const BestTarget& best : targets.best()) {
        targets.change(best.target->number(),
                       [&](Target& target) { target.confirm(target.number(), true); });
      }
    }
  }
  EXPECT_EQ(targets.best().size(), std::size_t{kTargets});
  return counts;
}

TEST(TrackingMemory, IsCounted) {
  const std::size_t before = allocationCount();
  const std::vector<int> some(100);
  EXPECT_EQ(allocationCount(), before + 1) << some.size();
}

TEST(TrackingMemory, NearestNeighborPredictsWithoutAndAssociatesWithLittle) {
  NearestNeighborTargets targets{TargetOptions(), AssociationOptions()};
  const Counts counts = countsOf(targets);
  EXPECT_EQ(counts.predict, 0.0);
  EXPECT_LT(counts.associate, 3.0) << "a group of target and object, and its assignment";
}

TEST(TrackingMemory, MultipleHypothesesPredictWithoutAndAssociateWithLittle) {
  MultipleHypotheses targets{TargetOptions(), AssociationOptions(), HypothesisOptions(),
                             SplitMergeOptions()};
  const Counts counts = countsOf(targets);
  EXPECT_EQ(counts.predict, 0.0);
  EXPECT_LT(counts.associate, 25.0) << "the hypotheses of a cluster, and their ranking";
}

/// The same of whole steps.
double countOf(TrackerAssociation association) {
  TrackerOptions options;
  options.association = association;
  Tracker tracker{options};
  std::size_t count = 0;
  for (int i = 0; i < kWarmUp + kScans; ++i) {
    const ObjectList objects{Stamp::fromSeconds(100.0 + kPeriod * i), cyclists(i), {}};
    const std::size_t before = allocationCount();
    const std::size_t tracks = tracker.process(objects, Pose2()).tracks.size();
    if (i >= kWarmUp) {
      count += allocationCount() - before;
      EXPECT_EQ(tracks, std::size_t{kTargets});
    }
  }
  return static_cast<double>(count) / (kTargets * kScans);
}

TEST(TrackingMemory, AStepWithNearestNeighbors) {
  EXPECT_LT(countOf(TrackerAssociation::kGlobalNearestNeighbor), 9.0)
      << "7.7: a copy of the object, its group and assignment, and the published track with its "
         "path";
}

TEST(TrackingMemory, AStepWithMultipleHypotheses) {
  EXPECT_LT(countOf(TrackerAssociation::kMultipleHypotheses), 31.0)
      << "26.6: the same, and the hypotheses of a cluster with their ranking";
}

}  // namespace
}  // namespace datmo::tracking_memory_test
