// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/tracking/association_scan.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "tracking_scene.h"
#include <gtest/gtest.h>

namespace datmo::association_scan_test {
namespace {

class AssociationScanTest : public testing::Test {
 protected:
  AssociationScan take(const std::vector<Object>& objects, const Pose2& base = Pose2()) {
    return ingest(objects, base, visibility_, clutter_, options_, counts_);
  }

  Visibility visibility_{VisibilityOptions()};
  ClutterMap clutter_{ClutterMapOptions()};
  ScanIntakeOptions options_;
  ScanIntakeCounts counts_;
};

std::vector<double> positionsOf(const AssociationScan& scan) {
  std::vector<double> positions;
  for (const Observation& observation : scan.observations) {
    positions.push_back(observation.object.box.center.x());
  }
  return positions;
}

TEST_F(AssociationScanTest, ObjectsByAscendingXInTheFixedFrameWithTheirIndexInTheList) {
  const AssociationScan scan =
      take({objectAt(3.0, 0.0), objectAt(1.0, 0.0), objectAt(2.0, 0.0)}, Pose2(10.0, 5.0, 0.0));
  EXPECT_EQ(positionsOf(scan), (std::vector<double>{11.0, 12.0, 13.0}));
  EXPECT_EQ(scan.observations[0].object.box.center.y(), 5.0);
  EXPECT_EQ(scan.objects, 3U);
  EXPECT_EQ(scan.listed, (std::vector<std::size_t>{1, 2, 0}));
  EXPECT_EQ(scan.observations[2].sources, std::vector<std::size_t>{2});
  EXPECT_EQ(scan.listedSources(2), std::vector<std::size_t>{0});
  EXPECT_TRUE((scan.fixed_in_base * Point2(11.0, 5.0)).isApprox(Point2(1.0, 0.0), 1e-12));
}

TEST_F(AssociationScanTest, SourcesOfAUnionAreListedInTheOrderOfTheList) {
  AssociationScan scan = take({objectAt(3.0, 0.0), objectAt(1.0, 0.0), objectAt(2.0, 0.0)});
  scan.observations.push_back({objectAt(2.0, 0.0), {0, 2}, 0.0, ObservedTarget::kKnown});
  EXPECT_EQ(scan.listedSources(3), (std::vector<std::size_t>{0, 1}));
}

TEST_F(AssociationScanTest, AnObservationHasTheClassLikelihoodsOfItsObject) {
  Object cyclist = objectAt(1.0, 0.0);
  cyclist.class_probabilities = reportedClass(ObjectClass::kCyclist, 0.8);
  const AssociationScan scan = take({cyclist, objectAt(2.0, 0.0)});
  EXPECT_EQ(scan.observations[0].class_likelihoods, classLikelihoods(cyclist.class_probabilities));
  EXPECT_TRUE(scan.observations[0].class_likelihoods);
  EXPECT_FALSE(scan.observations[1].class_likelihoods);
}

TEST_F(AssociationScanTest, TheOrderOfTheListDoesNotMatter) {
  std::vector<Object> objects;
  std::mt19937_64 engine(1);
  std::uniform_real_distribution<double> position(-40.0, 40.0);
  for (int i = 0; i < 50; ++i) {
    objects.push_back(objectAt(i % 5, position(engine)));
  }
  options_.max_objects = 30;
  const AssociationScan first = take(objects);
  std::shuffle(objects.begin(), objects.end(), engine);
  const AssociationScan second = take(objects);
  ASSERT_EQ(first.objects, 30U);
  for (std::size_t i = 0; i < first.objects; ++i) {
    EXPECT_EQ(first.observations[i].object.box.center.position(),
              second.observations[i].object.box.center.position());
  }
}

TEST_F(AssociationScanTest, TheFarthestFromTheVehicleAreRefused) {
  options_.max_objects = 2;
  const AssociationScan scan =
      take({objectAt(9.0, 0.0), objectAt(-1.0, 0.0), objectAt(4.0, 0.0)}, Pose2(-9.0, 0.0, 0.0));
  EXPECT_EQ(positionsOf(scan), (std::vector<double>{-10.0, -5.0}));
  EXPECT_EQ(counts_.accepted, 2U);
  EXPECT_EQ(counts_.refused, 1U);
  EXPECT_EQ(counts_.rejected, 0U);
}

TEST_F(AssociationScanTest, BrokenObjectsAreCountedAndDoNotShiftTheList) {
  Object broken = objectAt(0.0, 0.0);
  broken.box.length = std::numeric_limits<double>::quiet_NaN();
  const AssociationScan scan = take({broken, objectAt(1.0, 0.0), broken});
  EXPECT_EQ(scan.listed, std::vector<std::size_t>{1});
  EXPECT_EQ(counts_.rejected, 2U);
  EXPECT_EQ(counts_.accepted, 1U);
}

TEST_F(AssociationScanTest, DensityIsThatOfNewObjectsAndOfClutterSeenFromTheVehicle) {
  ClutterMapOptions map_options;
  ClutterMap clutter(map_options);
  clutter.learn({Point2(5.0, 5.0)}, 1000.0 * map_options.learning_time);
  const Pose2 base(100.0, 0.0, 0.0);
  const AssociationScan scan = ingest({objectAt(5.0, 5.0), objectAt(35.0, 5.0)}, base, visibility_,
                                      clutter, options_, counts_);
  const double area = map_options.cell_size * map_options.cell_size;
  EXPECT_NEAR(std::exp(scan.observations[0].log_density), options_.new_density + 1.0 / area, 1e-9);
  EXPECT_NEAR(std::exp(scan.observations[1].log_density), options_.new_density, 1e-12);
}

TEST_F(AssociationScanTest, ObjectsStaticInTheMapStartNoTarget) {
  const AssociationScan scan =
      take({objectAt(1.0, 0.0, DynamicState::kStatic), objectAt(2.0, 0.0, DynamicState::kUnknown)});
  EXPECT_FALSE(scan.observations[0].startsTarget());
  EXPECT_TRUE(scan.observations[1].startsTarget());
  EXPECT_FALSE(scan.observations[0].needsTarget());
}

TEST_F(AssociationScanTest, NoInputGivesNoOutput) {
  const AssociationScan scan = take({});
  EXPECT_EQ(scan.objects, 0U);
  EXPECT_TRUE(scan.observations.empty());
  EXPECT_EQ(counts_.accepted, 0U);
}

}  // namespace
}  // namespace datmo::association_scan_test
