// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/tracking/box_size.h"

#include <cmath>

#include <gtest/gtest.h>

namespace datmo::box_size_test {
namespace {

VisibleExtent whole(double length) { return {length, 0.01, true, 0.0}; }
VisibleExtent atLeast(double length) { return {length, 0.01, false, 0.0}; }

/// The rear of an object that moves along the first axis: its width is visible, its depth not.
BoxSize afterRear(double width, const BoxSizeOptions& options, int scans = 5) {
  BoxSize size(options);
  for (int i = 0; i < scans; ++i) {
    size.update({atLeast(0.0), whole(width)}, 0.1, options);
    size.addOddsAlongFirst(2.0);
  }
  return size;
}

TEST(BoxSize, OneKindAloneIsAKalmanFilter) {
  BoxSizeOptions options;
  options.drift = 0.0;
  options.extent_std = 0.1;
  options.vehicle = {1.0, 4.0, 0.5, 4.0, 0.5};  // length and width equal: no axis to choose
  for (SizePrior* other : {&options.lorry, &options.two_wheeler, &options.person, &options.other}) {
    *other = options.vehicle;
  }
  BoxSize size(options);
  EXPECT_NEAR(size.mean().x(), 4.0, 1e-12);
  EXPECT_NEAR(size.variance().x(), 0.25, 1e-12);
  size.update({whole(4.3), atLeast(1.0)}, 0.1, options);
  const double gain = 0.25 / (0.25 + 0.01 + 0.1 * 0.1);
  EXPECT_NEAR(size.mean().x(), 4.0 + gain * 0.3, 1e-9);
  EXPECT_NEAR(size.variance().x(), (1.0 - gain) * 0.25, 1e-9);
  EXPECT_NEAR(size.mean().y(), 4.0, 1e-12) << "a bound that it keeps tells nothing";
  EXPECT_NEAR(size.variance().y(), 0.25, 1e-12);
}

TEST(BoxSize, ItGrowsToAVisiblePartThatIsLongerAndNeverShrinksByABound) {
  const BoxSizeOptions options;
  BoxSize size = afterRear(1.8, options, 50);  // so that its kind is settled
  double last = size.mean().x();
  for (int i = 0; i < 20; ++i) {
    size.update({atLeast(6.0), whole(1.8)}, 0.1, options);
    EXPECT_GE(size.mean().x(), last - 1e-9);
    last = size.mean().x();
  }
  EXPECT_GT(last, 5.7);
  EXPECT_LT(last, 6.7);
  for (int i = 0; i < 20; ++i) {
    size.update({atLeast(0.5), whole(1.8)}, 0.1, options);
  }
  EXPECT_NEAR(size.mean().x(), last, 0.01);
}

TEST(BoxSize, ALowerBoundThatIsNoiseDoesNotMakeItGrow) {
  const BoxSizeOptions options;
  BoxSize size = afterRear(1.8, options);
  const double length = size.mean().x();
  // A stereo camera at 30 m: half of the extents are longer than the car, by noise alone.
  for (int i = 0; i < 50; ++i) {
    const double noise = i % 2 == 0 ? 1.0 : -1.0;
    size.update({VisibleExtent{length + noise, 0.01, false, 1.0}, whole(1.8)}, 0.1, options);
  }
  EXPECT_NEAR(size.mean().x(), length, 0.1);
  size.update({VisibleExtent{length + 2.5, 0.01, false, 1.0}, whole(1.8)}, 0.1, options);
  EXPECT_GT(size.mean().x(), length + 0.05) << "2.5 standard deviations are no noise";
}

TEST(BoxSize, ARearImpliesTheKindAndTheKindTheLength) {
  const BoxSizeOptions options;
  const BoxSize car = afterRear(1.8, options);
  EXPECT_NEAR(car.mean().x(), options.vehicle.length, 0.5);
  EXPECT_GT(car.probabilityAlongFirst(), 0.9);
  const BoxSize lorry = afterRear(2.5, options);
  EXPECT_GT(lorry.mean().x(), 7.0);
  const BoxSize person = afterRear(0.5, options);
  EXPECT_LT(person.mean().x(), 1.5);
  EXPECT_GT(std::sqrt(car.variance().x()), 0.4) << "nobody has seen it";
  EXPECT_LT(std::sqrt(car.variance().y()), 0.1);
}

TEST(BoxSize, WithoutMotionAnExtentMayBeLengthOrWidth) {
  const BoxSizeOptions options;
  BoxSize size(options);
  size.update({atLeast(0.0), whole(1.8)}, 0.1, options);
  EXPECT_GT(size.probabilityAlongFirst(), 0.1) << "the rear of a car";
  EXPECT_LT(size.probabilityAlongFirst(), 0.9) << "or the side of a bicycle";
  BoxSize longer(options);
  longer.update({atLeast(0.0), whole(4.4)}, 0.1, options);
  EXPECT_LT(longer.probabilityAlongFirst(), 0.1) << "the side of a car";
}

TEST(BoxSize, AClassSetsTheSize) {
  const BoxSizeOptions options;
  BoxSize size(options);
  for (int i = 0; i < 5; ++i) {
    size.classify(ObjectClass::kCyclist, 0.9);
  }
  EXPECT_NEAR(std::max(size.mean().x(), size.mean().y()), 1.2, 0.1) << "along either axis";
  size.addOddsAlongFirst(10.0);
  EXPECT_NEAR(size.mean().x(), options.two_wheeler.length, 0.05);
  EXPECT_NEAR(size.mean().y(), options.two_wheeler.width, 0.05);
  const Eigen::Vector2d before = size.mean();
  size.classify(ObjectClass::kUnknown, 1.0);
  EXPECT_EQ(size.mean(), before);
}

TEST(BoxSize, AWrongClassIsCorrectedByMeasurements) {
  const BoxSizeOptions options;
  BoxSize size(options);
  size.classify(ObjectClass::kPedestrian, 1.0);
  for (int i = 0; i < 10; ++i) {
    size.update({whole(4.4), whole(1.8)}, 0.1, options);
  }
  EXPECT_NEAR(size.mean().x(), 4.4, 0.1);
  EXPECT_NEAR(size.mean().y(), 1.8, 0.1);
}

TEST(BoxSize, OneScanThatIsFarOffCountsForLittle) {
  const BoxSizeOptions options;
  BoxSize size(options);
  for (int i = 0; i < 20; ++i) {
    size.update({whole(4.4), whole(1.8)}, 0.1, options);
  }
  size.update({whole(9.0), whole(1.8)}, 0.1, options);  // two cars in one segment
  EXPECT_NEAR(size.mean().x(), 4.4, 0.2);
}

TEST(BoxSize, ScansOfOneMomentCountAsOne) {
  const BoxSizeOptions options;
  const auto after = [&](int scans, double seconds) {
    BoxSize size(options);
    size.update({whole(4.2), whole(1.75)}, 0.0, options);
    for (int i = 0; i < scans; ++i) {
      size.update({whole(4.6), whole(1.75)}, seconds / scans, options);
    }
    return size;
  };
  const BoxSize few = after(2, 0.2);
  const BoxSize many = after(20, 0.2);
  EXPECT_NEAR(many.mean().x(), few.mean().x(), 0.01);
  EXPECT_NEAR(many.variance().x(), few.variance().x(), 0.1 * few.variance().x());
  const BoxSize longer = after(20, 20.0);
  EXPECT_LT(longer.variance().x(), 0.5 * few.variance().x()) << "as many, each of its own moment";
}

TEST(BoxSize, AScanWithoutElapsedTimeAddsNothing) {
  const BoxSizeOptions options;
  BoxSize size(options);
  size.update({whole(4.2), whole(1.75)}, 0.0, options);
  const Eigen::Vector2d before = size.mean();
  size.update({whole(4.6), whole(1.9)}, 0.0, options);
  EXPECT_EQ(size.mean(), before);
}

/// Only one kind, seen from both its sides: worked out by hand.
TEST(BoxSize, TheLikelihoodsAreThoseOfTheSizes) {
  BoxSizeOptions options;
  options.lorry.share = 1e-6;
  options.wrong_size = 0.1;
  BoxSize size(options);
  const RoadUserLikelihoods unseen = size.likelihoods(options);
  EXPECT_DOUBLE_EQ(unseen.pedestrian, 1.0);
  EXPECT_DOUBLE_EQ(unseen.cyclist, 1.0);
  EXPECT_NEAR(unseen.vehicle, 1.0, 1e-9);

  constexpr double kTolerance = 1e-4;  // the other axis keeps a little
  size.addOddsAlongFirst(30.0);
  size.update({atLeast(0.0), whole(0.9)}, 0.0, options);
  const double noise = 0.01 + 0.1 * 0.1;
  const auto density = [&](const SizePrior& prior) {
    const double variance = prior.width_std * prior.width_std + noise;
    const double distance2 = (0.9 - prior.width) * (0.9 - prior.width) / variance;
    return std::exp(-0.5 * std::min(9.0, distance2)) / std::sqrt(variance);
  };
  const double best = density(options.person);
  const RoadUserLikelihoods seen = size.likelihoods(options);
  EXPECT_NEAR(seen.pedestrian, 1.0, kTolerance);
  EXPECT_NEAR(seen.cyclist, 0.9 * density(options.two_wheeler) / best + 0.1, kTolerance);
  EXPECT_NEAR(seen.vehicle, 0.9 * density(options.vehicle) / best + 0.1, kTolerance);
}

TEST(BoxSize, ClassReportsAreNotInTheLikelihoods) {
  const BoxSizeOptions options;
  BoxSize size = afterRear(1.8, options);
  const RoadUserLikelihoods before = size.likelihoods(options);
  EXPECT_EQ(before.vehicle, 1.0);
  EXPECT_LT(before.cyclist, 0.1);
  size.classify(ObjectClass::kCyclist, 0.9);
  const RoadUserLikelihoods after = size.likelihoods(options);
  EXPECT_EQ(after.cyclist, before.cyclist);
  EXPECT_EQ(after.vehicle, before.vehicle);
}

TEST(BoxSize, SwappingTheAxesTwiceChangesNothing) {
  const BoxSizeOptions options;
  BoxSize size = afterRear(1.8, options);
  const BoxSize before = size;
  size.swapAxes();
  EXPECT_NEAR(size.mean().x(), before.mean().y(), 1e-12);
  EXPECT_NEAR(size.variance().y(), before.variance().x(), 1e-12);
  EXPECT_NEAR(size.probabilityAlongFirst(), 1.0 - before.probabilityAlongFirst(), 1e-12);
  size.swapAxes();
  EXPECT_NEAR((size.mean() - before.mean()).norm(), 0.0, 1e-12);
}

}  // namespace
}  // namespace datmo::box_size_test
