// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/slam/kidnapping_detector.h"

#include <gtest/gtest.h>

namespace datmo::kidnapping_detector_test {
namespace {

/// A detector, and scans of 100 beams, ten per second.
class Scans {
 public:
  /// The map contradicts 10 beams of each of the first scans.
  Scans() { add(10, 5); }

  void add(int contradicted, int scans = 1, int beams = 100) {
    for (int i = 0; i < scans; ++i) {
      stamp_ = stamp_ + 0.1;
      detector.add(stamp_, {beams, contradicted});
    }
  }

  KidnappingDetector detector{0.2, 1.0};

 private:
  Stamp stamp_;
};

TEST(KidnappingDetectorTest, ASuddenRiseIsSuspectedAndConfirmedWhenItStays) {
  Scans scans;
  EXPECT_FALSE(scans.detector.isSuspected());
  for (int i = 0; i <= 10; ++i) {
    EXPECT_FALSE(scans.detector.isKidnapped());
    scans.add(i == 0 ? 31 : 16);  // more than 10 + 0.25 * 20
    EXPECT_TRUE(scans.detector.isSuspected());
  }
  EXPECT_TRUE(scans.detector.isKidnapped());
}

TEST(KidnappingDetectorTest, ASmallerRiseIsTraffic) {
  Scans scans;
  scans.add(29);
  EXPECT_FALSE(scans.detector.isSuspected());
}

TEST(KidnappingDetectorTest, AGradualRiseIsTraffic) {
  Scans scans;
  for (int contradicted = 10; contradicted <= 100; contradicted += 3) {
    scans.add(contradicted);
    EXPECT_FALSE(scans.detector.isSuspected()) << contradicted;
  }
}

TEST(KidnappingDetectorTest, ABumpIsForgotten) {
  Scans scans;
  for (int bump = 0; bump < 3; ++bump) {
    scans.add(90, 9);
    EXPECT_TRUE(scans.detector.isSuspected());
    scans.add(14);
    EXPECT_FALSE(scans.detector.isSuspected());
  }
  EXPECT_FALSE(scans.detector.isKidnapped());
}

TEST(KidnappingDetectorTest, FewBeamsAreUninformativeAndEndASuspicion) {
  Scans scans;
  scans.add(19, 20, 19);
  EXPECT_FALSE(scans.detector.isSuspected());
  scans.add(90);
  EXPECT_TRUE(scans.detector.isSuspected());
  scans.add(0, 20, 19);
  EXPECT_FALSE(scans.detector.isSuspected());
  EXPECT_FALSE(scans.detector.isKidnapped());
}

TEST(KidnappingDetectorTest, ItComparesWithinOneMapOnly) {
  Scans scans;
  scans.add(90, 11);
  scans.detector.reset();
  EXPECT_FALSE(scans.detector.isKidnapped());
  scans.add(90);
  EXPECT_FALSE(scans.detector.isSuspected());
}

}  // namespace
}  // namespace datmo::kidnapping_detector_test
