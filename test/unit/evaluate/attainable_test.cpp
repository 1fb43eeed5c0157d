// SPDX-License-Identifier: BSD-3-Clause
#include "evaluate/attainable.h"

#include "made_recordings.h"
#include <gtest/gtest.h>

namespace datmo::evaluation::attainable_test {
namespace {

constexpr double kPeriod = 0.1;  // s

/// A car from 20 m ahead at `speed` (m/s), and a beam that ends on its rear at each 0.1 s.
class AttainableTest : public ::testing::Test {
 protected:
  void drive(double speed, int scans) {
    for (int i = 0; i < scans; ++i) {
      const double x = 20.0 + speed * kPeriod * i;
      const Stamp stamp = Stamp::fromSeconds(kPeriod * i);
      RecordedObject car = carAt(1, x);
      car.state.velocity = Point2(speed, 0.0);
      truth_.objects.push_back({stamp, {car}});
      Ray ray;
      ray.range = x - 2.0;
      ray.end = Point2(x - 2.0, 0.0);
      ray.hit = true;
      scans_.emplace_back();
      scans_.back().stamp = stamp;
      scans_.back().rays = {ray};
    }
    truth_.poses = standingVehicle();
  }

  std::map<std::uint32_t, AttainableMotion> motions() const {
    return attainableMotions(scans_, TrueScene(truth_, optionsForBriefObjects()), options_);
  }

  RecordedTruth truth_;
  std::vector<Scan> scans_;
  AttainableOptions options_ = {0.2, 0.8, 0.5};
};

TEST_F(AttainableTest, ThresholdIsTheOddsOverThePriorOnes) {
  EXPECT_NEAR(options_.requiredLogRatio(), std::log(4.0), 1e-12);
  options_.moving_prior = 0.2;
  EXPECT_NEAR(options_.requiredLogRatio(), std::log(16.0), 1e-12);
}

TEST_F(AttainableTest, FirstScanThatRevealsMotion) {
  // 0.5 v^2 n (n^2 - 1) dt^2 / (12 sigma^2): n = 2: 1/2 * 9 * 0.01 * 6 / 0.48 = 0.5625, 3: 2.25.
  drive(3.0, 10);
  const auto found = motions();
  ASSERT_EQ(found.count(1), 1U);
  EXPECT_EQ(found.at(1).detectable, Stamp::fromSeconds(0.2));
  EXPECT_EQ(found.at(1).seen.size(), 10U);
}

TEST_F(AttainableTest, TooFewScansRevealNothing) {
  drive(0.5, 3);
  EXPECT_FALSE(motions().at(1).detectable);
}

TEST_F(AttainableTest, WithoutABeamThereIsNothing) {
  drive(3.0, 10);
  for (Scan& scan : scans_) {
    scan.rays.clear();
  }
  EXPECT_TRUE(motions().empty());
}

TEST_F(AttainableTest, DelaysBesideTheAttainable) {
  drive(3.0, 10);
  std::vector<ObjectScore> objects(3);
  objects[0].id = 1;
  objects[0].first = Stamp::fromSeconds(0.0);
  objects[0].last = Stamp::fromSeconds(0.9);
  objects[0].delay = 0.5;
  objects[1] = objects[0];
  objects[1].delay = std::nullopt;
  objects[2].id = 2;
  const std::vector<ComparedDelay> delays = compareDelays(objects, motions(), scans_);
  ASSERT_EQ(delays.size(), 3U);
  EXPECT_NEAR(delays[0].attainable.value(), 0.2, 1e-9);
  EXPECT_NEAR(delays[0].excess.value(), 0.3, 1e-9);
  EXPECT_NEAR(delays[0].ratio.value(), 0.6 / 0.3, 1e-9);
  EXPECT_DOUBLE_EQ(delays[0].beams_per_scan, 1.0);
  EXPECT_TRUE(delays[1].attainable);
  EXPECT_FALSE(delays[1].ratio);
  EXPECT_FALSE(delays[2].attainable);
}

TEST_F(AttainableTest, EarlyReportsAreAttainedImmediately) {
  drive(3.0, 10);
  ObjectScore object;
  object.id = 1;
  object.first = Stamp::fromSeconds(0.5);
  object.last = Stamp::fromSeconds(0.9);
  object.delay = 0.0;
  const ComparedDelay delay = compareDelays({object}, motions(), scans_).front();
  EXPECT_DOUBLE_EQ(delay.attainable.value(), 0.0);
  EXPECT_DOUBLE_EQ(delay.ratio.value(), 1.0);
}

}  // namespace
}  // namespace datmo::evaluation::attainable_test
