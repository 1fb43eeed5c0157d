// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/sensor_model/stereo_alignment.h"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "datmo_fusion/common/angle.h"
#include "datmo_fusion/common/random.h"
#include "datmo_fusion/common/square.h"

namespace datmo::stereo_alignment_test {
namespace {

constexpr double kDisparityAtMeter = 200.0;  // px m
const Twist2 kTwist{8.0, 0.2};

/// 1 = a z + b x of a wall on the ground, as seen from the assumed position of a camera.
struct Wall {
  double a = 0.1;
  double b = 0.0;
  double tangent = 0.0;

  double inverse() const { return a + b * tangent; }

  /// Seen by a camera that is `back` (m) farther back and turned to the left by `turn` (rad).
  Wall seenFrom(double back, double turn) const {
    // z = z' cos + x' sin - back, x = x' cos - z' sin
    const double scale = 1.0 + a * back;
    return {(a * std::cos(turn) - b * std::sin(turn)) / scale,
            (a * std::sin(turn) + b * std::cos(turn)) / scale, tangent};
  }

  /// The wall moved away by this along its normal, m.
  Wall pushed(double by) const {
    const double scale = 1.0 + by * std::hypot(a, b);
    return {a / scale, b / scale, tangent};
  }
};

SurfacePair pairOf(const Wall& wall) {
  SurfacePair pair;
  pair.tangent = wall.tangent;
  pair.intercept = wall.a;
  pair.slope = wall.b;
  return pair;
}

double rate(const SurfacePair& pair, AlignmentTerm term) {
  return alignmentRates(pair, kDisparityAtMeter, kTwist)[static_cast<int>(term)];
}

TEST(StereoAlignment, RatesAreThoseOfAWallSeenFromElsewhere) {
  constexpr double kStep = 1e-6;
  for (const Wall& wall : {Wall{0.1, 0.0, 0.0}, Wall{0.1, 0.05, 0.3}, Wall{0.02, -0.2, -0.4}}) {
    const SurfacePair pair = pairOf(wall);
    const auto slope = [&](const Wall& moved) {
      return kDisparityAtMeter * (moved.inverse() - wall.inverse()) / kStep;
    };
    EXPECT_EQ(rate(pair, AlignmentTerm::kDisparity), 1.0);
    EXPECT_NEAR(rate(pair, AlignmentTerm::kSurface), slope(wall.pushed(kStep)), 1e-3);
    EXPECT_NEAR(rate(pair, AlignmentTerm::kForward), slope(wall.seenFrom(kStep, 0.0)), 1e-3);
    EXPECT_NEAR(rate(pair, AlignmentTerm::kHeading), slope(wall.seenFrom(0.0, kStep)), 1e-3);
    // Earlier, the vehicle was farther back, and turned to the right.
    EXPECT_NEAR(rate(pair, AlignmentTerm::kTime),
                slope(wall.seenFrom(kTwist.forward_speed * kStep, -kTwist.yaw_rate * kStep)), 1e-2);
  }
}

/// Walls ahead and to the side, as measured by a camera with these errors.
class Street {
 public:
  Street(const AlignmentVector& errors, const StereoAlignmentOptions& options, std::uint64_t seed)
      : errors_(errors), options_(options), random_(seed) {}

  std::vector<SurfacePair> look(int count) {
    std::vector<SurfacePair> pairs;
    for (int i = 0; i < count; ++i) {
      const double slant = degrees(60.0) * (2.0 * random_.uniform(0.0, 1.0) - 1.0);
      const double inverse = 1.0 / (5.0 + 25.0 * random_.uniform(0.0, 1.0));
      const double tangent = random_.uniform(0.0, 1.0) - 0.5;
      SurfacePair pair = pairOf({0.0, 0.0, tangent});
      pair.slope = inverse * std::sin(slant);
      pair.intercept = inverse - pair.slope * tangent;
      const AlignmentVector rates = alignmentRates(pair, kDisparityAtMeter, kTwist);
      const double body = rates[static_cast<int>(AlignmentTerm::kSurface)] * options_.body_sigma;
      pair.difference = rates.dot(errors_) + random_.normal(std::abs(body)) +
                        random_.normal(options_.disparity_sigma);
      pairs.push_back(pair);
    }
    return pairs;
  }

 private:
  AlignmentVector errors_;
  StereoAlignmentOptions options_;
  Random random_;
};

StereoAlignmentOptions independent() {
  StereoAlignmentOptions options;
  options.surface_distance = 0.0;
  return options;
}

AlignmentVector drawn(const StereoAlignmentOptions& options, Random& random) {
  AlignmentVector errors;
  const auto terms = options.terms();
  for (std::size_t i = 0; i < kAlignmentTerms; ++i) {
    errors[static_cast<int>(i)] = random.normal(terms[i]->sigma);
  }
  return errors;
}

void run(StereoAlignmentFilter& filter, Street& street, int images) {
  for (int i = 0; i < images; ++i) {
    filter.update(Stamp::fromSeconds(100.0 + 0.1 * i), street.look(10), kDisparityAtMeter, kTwist);
  }
}

/// Chi squared of five terms in 40 runs: 5, between 4.1 and 6.1 with 95 %; drift widens it.
TEST(StereoAlignment, ErrorsAreConsistentWithTheCovariance) {
  const StereoAlignmentOptions options = independent();
  constexpr int kRuns = 40;
  double nees = 0.0;
  Random random(5);
  for (int i = 0; i < kRuns; ++i) {
    const AlignmentVector errors = drawn(options, random);
    Street street(errors, options, 100 + static_cast<std::uint64_t>(i));
    StereoAlignmentFilter filter(options);
    run(filter, street, 30);
    const AlignmentVector off = filter.alignment().mean - errors;
    nees += off.dot(filter.alignment().covariance.inverse() * off) / kRuns;
    EXPECT_LT(filter.alignment().sigma(AlignmentTerm::kDisparity), 0.1);
  }
  EXPECT_GT(nees, 3.5);
  EXPECT_LT(nees, 6.1);
}

TEST(StereoAlignment, AWrongMountIsNotTakenForABiasOfDisparities) {
  const StereoAlignmentOptions options = independent();
  AlignmentVector errors = AlignmentVector::Zero();
  errors[static_cast<int>(AlignmentTerm::kHeading)] = degrees(3.0);
  Street street(errors, options, 1);
  StereoAlignmentFilter filter(options);
  run(filter, street, 100);
  EXPECT_NEAR(filter.alignment()[AlignmentTerm::kDisparity], 0.0, 0.1);
  EXPECT_NEAR(filter.alignment()[AlignmentTerm::kHeading], degrees(3.0), degrees(0.2));
  EXPECT_TRUE(filter.isFault(AlignmentTerm::kHeading));
  EXPECT_FALSE(filter.alignment().usable);
  EXPECT_FALSE(filter.isFault(AlignmentTerm::kDisparity));
  EXPECT_FALSE(filter.isFault(AlignmentTerm::kTime));
}

TEST(StereoAlignment, PointsOfOtherSurfacesAreLeftOut) {
  const StereoAlignmentOptions options = independent();
  Street street(AlignmentVector::Zero(), options, 1);
  StereoAlignmentFilter filter(options);
  for (int i = 0; i < 50; ++i) {
    std::vector<SurfacePair> pairs = street.look(10);
    pairs[0].difference -= 6.0;
    pairs[1].difference -= 6.0;
    filter.update(Stamp::fromSeconds(100.0 + 0.1 * i), pairs, kDisparityAtMeter, kTwist);
  }
  EXPECT_NEAR(filter.alignment()[AlignmentTerm::kDisparity], 0.0, 0.1);
  EXPECT_GT(filter.alignment().refused, 80U);
  EXPECT_GT(filter.alignment().surfaces, 350U);
}

/// An object in front of the vehicle is one surface, however often it is seen.
TEST(StereoAlignment, ASurfaceThatStaysInViewCountsOnce) {
  StereoAlignmentOptions options;
  StereoAlignmentFilter filter(options);
  const SurfacePair wall = pairOf({1.0 / 30.0, 0.0, 0.0});
  const int images = static_cast<int>(options.surface_distance / (8.0 * 0.1) + 0.5);
  for (int i = 0; i < images; ++i) {
    filter.update(Stamp::fromSeconds(100.0 + 0.1 * i), {wall}, kDisparityAtMeter, {8.0, 0.0});
  }
  StereoAlignmentOptions once = options;
  once.surface_distance = 0.0;
  StereoAlignmentFilter expected(once);
  expected.update(Stamp::fromSeconds(100.0), {wall}, kDisparityAtMeter, {8.0, 0.0});
  EXPECT_NEAR(filter.alignment().sigma(AlignmentTerm::kDisparity),
              expected.alignment().sigma(AlignmentTerm::kDisparity), 0.01);
  EXPECT_LT(expected.alignment().sigma(AlignmentTerm::kDisparity), 0.28);
}

TEST(StereoAlignment, InvalidOptionsAreRefused) {
  StereoAlignmentOptions options;
  options.disparity.sigma = -1.0;
  EXPECT_THROW(StereoAlignmentFilter{options}, OptionError);
}

}  // namespace
}  // namespace datmo::stereo_alignment_test
