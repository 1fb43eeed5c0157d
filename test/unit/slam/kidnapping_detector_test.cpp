// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/slam/kidnapping_detector.h"

#include <gtest/gtest.h>

namespace datmo::kidnapping_detector_test {
namespace {

/// A detector, and scans of 100 beams, ten per second.
class Scans {
 public:
  /// The map contradicts 10 beams of each of the first scans, and confirms the others.
  Scans() { add(10, 90, 5); }

  void add(int contradicted, int confirmed, int scans = 1, int beams = 100) {
    for (int i = 0; i < scans; ++i) {
      stamp_ = stamp_ + 0.1;
      detector.add(stamp_, {beams, contradicted, confirmed});
    }
  }

  KidnappingDetector detector{5.0, 1.0};

 private:
  Stamp stamp_;
};

TEST(KidnappingDetectorTest, ASuddenRiseIsSuspectedAndConfirmedWhenItStays) {
  Scans scans;
  EXPECT_FALSE(scans.detector.isSuspected());
  for (int i = 0; i <= 10; ++i) {
    EXPECT_FALSE(scans.detector.isKidnapped());
    scans.add(i == 0 ? 45 : 30, i == 0 ? 55 : 70);
    EXPECT_TRUE(scans.detector.isSuspected());
  }
  EXPECT_TRUE(scans.detector.isKidnapped());
}

TEST(KidnappingDetectorTest, ASmallerRiseIsTraffic) {
  Scans scans;
  scans.add(29, 71);
  EXPECT_FALSE(scans.detector.isSuspected());
}

TEST(KidnappingDetectorTest, AGradualRiseIsTraffic) {
  Scans scans;
  for (int contradicted = 10; contradicted <= 100; contradicted += 3) {
    scans.add(contradicted, 100 - contradicted);
    EXPECT_FALSE(scans.detector.isSuspected()) << contradicted;
  }
}

TEST(KidnappingDetectorTest, ARiseAfterTrafficHasLeftIsSuspected) {
  Scans scans;
  for (const int contradicted : {38, 31, 22, 17, 7}) {
    scans.add(contradicted, 100 - contradicted);
  }
  scans.add(60, 40);  // the largest share before was 38
  EXPECT_TRUE(scans.detector.isSuspected());
}

TEST(KidnappingDetectorTest, DrivingOnIntoUnknownSpaceDoesNotEndASuspicion) {
  Scans scans;
  scans.add(50, 10);
  EXPECT_TRUE(scans.detector.isSuspected());
  for (const int contradicted : {40, 30, 20, 10, 5, 0, 0, 0, 0, 0}) {
    scans.add(contradicted, contradicted / 5);  // the other ends are in unknown space
    EXPECT_TRUE(scans.detector.isSuspected()) << contradicted;
  }
  EXPECT_TRUE(scans.detector.isKidnapped());
}

TEST(KidnappingDetectorTest, AFewBeamsOnASurfaceDoNotEndASuspicion) {
  Scans scans;
  scans.add(50, 10);
  scans.add(0, 1);
  EXPECT_TRUE(scans.detector.isSuspected());
  scans.add(10, 80);
  EXPECT_FALSE(scans.detector.isSuspected());
}

TEST(KidnappingDetectorTest, MoreBeamsOnTheSameObjectsAreNoMoreEvidence) {
  for (const int scale : {1, 10}) {
    Scans scans;
    scans.add(29 * scale, 71 * scale, 1, 100 * scale);
    EXPECT_FALSE(scans.detector.isSuspected()) << scale;
  }
}

TEST(KidnappingDetectorTest, ABumpIsForgotten) {
  Scans scans;
  for (int bump = 0; bump < 3; ++bump) {
    scans.add(90, 10, 9);
    EXPECT_TRUE(scans.detector.isSuspected());
    scans.add(14, 86);
    EXPECT_FALSE(scans.detector.isSuspected());
  }
  EXPECT_FALSE(scans.detector.isKidnapped());
}

TEST(KidnappingDetectorTest, FewBeamsAreUninformativeAndEndASuspicion) {
  Scans scans;
  scans.add(19, 0, 20, 19);
  EXPECT_FALSE(scans.detector.isSuspected());
  scans.add(90, 10);
  EXPECT_TRUE(scans.detector.isSuspected());
  scans.add(0, 19, 20, 19);
  EXPECT_FALSE(scans.detector.isSuspected());
  EXPECT_FALSE(scans.detector.isKidnapped());
}

TEST(KidnappingDetectorTest, ItComparesWithinOneMapOnly) {
  Scans scans;
  scans.add(90, 10, 11);
  scans.detector.reset();
  EXPECT_FALSE(scans.detector.isKidnapped());
  scans.add(90, 10);
  EXPECT_FALSE(scans.detector.isSuspected());
}

}  // namespace
}  // namespace datmo::kidnapping_detector_test
