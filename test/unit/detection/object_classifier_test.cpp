// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/detection/object_classifier.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <gtest/gtest.h>

namespace datmo::object_classifier_test {
namespace {

/// Completely and accurately visible.
SeenSize seen(double height, double across, double along = 0.0) {
  SeenSize size;
  size.height = height;
  size.height_sigma = 0.1;
  size.across = across;
  size.across_sigma = 0.1;
  size.along = along;
  size.along_sigma = 0.3;
  return size;
}

double probability(const SeenSize& size, ObjectClass object_class) {
  const ObjectClassifier classifier{ObjectClassifierOptions()};
  return classifier.probabilities(size)[static_cast<std::size_t>(object_class)];
}

ObjectClass likeliest(const SeenSize& size) {
  const ClassProbabilities all = ObjectClassifier(ObjectClassifierOptions()).probabilities(size);
  return static_cast<ObjectClass>(std::max_element(all.begin(), all.end()) - all.begin());
}

TEST(ObjectClassifier, ClassifiesKindsBySize) {
  EXPECT_EQ(likeliest(seen(1.75, 0.5)), ObjectClass::kPedestrian);
  EXPECT_EQ(likeliest(seen(1.75, 1.6)), ObjectClass::kCyclist) << "from the side";
  EXPECT_EQ(likeliest(seen(1.75, 0.8, 1.4)), ObjectClass::kCyclist) << "from ahead, a little aside";
  EXPECT_EQ(likeliest(seen(1.45, 1.8)), ObjectClass::kVehicle) << "car from behind";
  EXPECT_EQ(likeliest(seen(1.5, 4.2)), ObjectClass::kVehicle) << "car from the side";
  EXPECT_EQ(likeliest(seen(3.4, 2.5)), ObjectClass::kVehicle) << "truck from ahead";
  EXPECT_EQ(likeliest(seen(4.0, 0.15)), ObjectClass::kPole);
  EXPECT_EQ(likeliest(seen(0.6, 0.9)), ObjectClass::kUnknown) << "bush";
  EXPECT_EQ(likeliest(seen(8.0, 6.0)), ObjectClass::kUnknown) << "house";
}

TEST(ObjectClassifier, ProbabilitiesSumToOneHoweverOddTheSize) {
  for (const SeenSize& size : {seen(0.3, 0.0), seen(1.7, 0.6), seen(1e3, 1e3), seen(1e6, 1e6)}) {
    const ClassProbabilities all = ObjectClassifier(ObjectClassifierOptions()).probabilities(size);
    EXPECT_NEAR(std::accumulate(all.begin(), all.end(), 0.0), 1.0, 1e-9);
  }
}

TEST(ObjectClassifier, LowProbabilityShowsUnclassifiableObjects) {
  EXPECT_LT(probability(seen(1.72, 0.6), ObjectClass::kPedestrian), 0.9)
      << "a cyclist from behind looks like that as well";
  EXPECT_GT(probability(seen(1.5, 4.2, 1.8), ObjectClass::kVehicle), 0.9);
}

TEST(ObjectClassifier, PartiallySeenObjectsMayBeLarger) {
  SeenSize half = seen(1.75, 0.6);
  const double whole_cyclist = probability(half, ObjectClass::kCyclist);
  half.wider = true;
  EXPECT_GT(probability(half, ObjectClass::kCyclist), whole_cyclist) << "more is behind a tree";
  SeenSize low = seen(2.5, 0.15);
  const double short_pole = probability(low, ObjectClass::kPole);
  low.higher = true;
  EXPECT_GT(probability(low, ObjectClass::kPole), short_pole) << "the image ends there";
}

TEST(ObjectClassifier, ReportsTheEvidenceForOneOfItsKinds) {
  const ObjectClassifier classifier{ObjectClassifierOptions()};
  const auto odds = [&](const SeenSize& size) {
    return classifier.logOddsOfKnown(classifier.probabilities(size));
  };
  EXPECT_GT(odds(seen(1.5, 1.8)), 2.0);
  EXPECT_LT(odds(seen(0.6, 3.0)), -2.0) << "hedge";
  EXPECT_TRUE(std::isfinite(odds(seen(1e6, 1e6))));
  // An observation without information leaves the odds unchanged.
  const double known = 20.0 / 22.0;
  EXPECT_NEAR(classifier.logOddsOfKnown({1.0 - known, known, 0.0, 0.0, 0.0}), 0.0, 1e-9);
}

TEST(ObjectClassifier, OnlyDoubtsTheExistenceOfAnObject) {
  const ObjectClassifier classifier{ObjectClassifierOptions()};
  Object car;
  classifier.classify(seen(1.5, 1.8), 3.0, car);
  EXPECT_EQ(car.class_probabilities, classifier.probabilities(seen(1.5, 1.8)));
  EXPECT_EQ(car.log_odds, 0.0);
  Object hedge;
  classifier.classify(seen(0.6, 3.0), 1.0, hedge);
  EXPECT_EQ(hedge.log_odds, -1.0) << "at most this doubt";
}

TEST(ObjectClassifier, FollowsItsOptions) {
  ObjectClassifierOptions options;
  options.pedestrian.share = 0.0;
  const ClassProbabilities all = ObjectClassifier(options).probabilities(seen(1.7, 0.55));
  EXPECT_EQ(all[static_cast<std::size_t>(ObjectClass::kPedestrian)], 0.0);
  options.car.width_sigma = 0.0;
  EXPECT_THROW(ObjectClassifier{options}, OptionError);
}

}  // namespace
}  // namespace datmo::object_classifier_test
