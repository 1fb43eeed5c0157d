// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/vision/mono_classifier.h"

#include <algorithm>
#include <memory>
#include <stdexcept>

#include "vision/image_samples.h"
#include <gtest/gtest.h>
#include <opencv2/core.hpp>

#include "datmo_fusion/common/class_belief.h"

namespace datmo::mono_classifier_test {
namespace {

using test::detectionOf;
using test::FixedDetector;
using test::levelCamera;
using test::objectAt;

/// A person whose feet are 10 m ahead, and a car 20 m ahead on the left.
const ImageDetection kPerson = detectionOf(ObjectClass::kPedestrian, 485, 190, 515, 275);
const ImageDetection kCar = detectionOf(ObjectClass::kVehicle, 350, 197, 400, 237.5);

/// Its detector is right in four of five cases.
MonoClassifierOptions dnnOptions() {
  MonoClassifierOptions options;
  options.detector = ImageDetectorKind::kDnn;
  options.dnn_reliability.scores = {0.0};
  options.dnn_reliability.right = {0.8};
  return options;
}

cv::Mat grayImage() { return {400, 1000, CV_8UC1, cv::Scalar(100)}; }

MonoClassification classified(const std::vector<ImageDetection>& seen, const ObjectList& objects,
                              const MonoClassifierOptions& options = dnnOptions()) {
  MonoClassifier classifier(options, std::make_unique<FixedDetector>(seen));
  return classifier.classify(grayImage(), levelCamera(), objects);
}

TEST(MonoClassifier, ClassifiesTheScannersObject) {
  ObjectList objects;
  objects.stamp = Stamp::fromSeconds(5.0);
  objects.objects = {objectAt(-5.0, 0.0, 0.4, 0.4, 0.0), objectAt(10.2, 0.0, 0.4, 0.4, 0.0)};
  const MonoClassification result = classified({kPerson}, objects);
  EXPECT_EQ(result.in_view, 1U) << "the other is behind";
  EXPECT_TRUE(result.alone.objects.empty());
  EXPECT_EQ(result.alone.stamp, objects.stamp);
  ASSERT_EQ(result.classes.size(), 1U);
  EXPECT_EQ(result.classes[0].index, 1U);
  EXPECT_EQ(mostLikelyClass(result.classes[0].probabilities), ObjectClass::kPedestrian);
  EXPECT_NEAR(probabilityOf(ObjectClass::kPedestrian, result.classes[0].probabilities), 0.8, 1e-9);
}

TEST(MonoClassifier, ADetectionWithoutAScannersObjectIsAnObject) {
  const MonoClassification result = classified({kPerson, kCar}, ObjectList());
  EXPECT_TRUE(result.classes.empty());
  ASSERT_EQ(result.alone.objects.size(), 2U);
  EXPECT_NEAR(result.alone.objects[0].box.center.x(), 10.0, 1.0);
  EXPECT_EQ(result.alone.objects[0].sensors, std::vector<std::string>{"mono"});
  EXPECT_GT(result.alone.objects[1].box.center.y(), 3.0);
}

TEST(MonoClassifier, AnUncertainDetectionAloneIsNoObject) {
  MonoClassifierOptions options = dnnOptions();
  options.min_alone = 0.81;
  EXPECT_TRUE(classified({kPerson}, ObjectList(), options).alone.objects.empty());
}

TEST(MonoClassifier, WithoutCalibrationEveryDetectionHasItsClassAndScore) {
  MonoClassifierOptions options = dnnOptions();
  options.calibrated = false;
  options.min_alone = 0.0;
  for (const double score : {0.0, 0.1, 0.9}) {
    ImageDetection person = kPerson;
    person.score = score;
    const MonoClassification result = classified({person}, ObjectList(), options);
    ASSERT_EQ(result.alone.objects.size(), 1U) << score;
    const ClassProbabilities& all = result.alone.objects[0].class_probabilities;
    EXPECT_EQ(mostLikelyClass(all), ObjectClass::kPedestrian) << score;
    EXPECT_NEAR(probabilityOf(ObjectClass::kPedestrian, all), score, 1e-5);
  }
}

TEST(MonoClassifier, AsInTheThesisTheRectangleWithTheBestDetectionWins) {
  MonoClassifierOptions options = dnnOptions();
  options.method = MonoMethod::kThesis;
  ObjectList objects;
  objects.objects = {objectAt(10.2, 0.0, 0.4, 0.4, 0.0)};
  const MonoClassification result = classified({kPerson, kCar}, objects, options);
  EXPECT_TRUE(result.alone.objects.empty()) << "what the scanner does not see is not there";
  ASSERT_EQ(result.classes.size(), 1U);
  EXPECT_EQ(mostLikelyClass(result.classes[0].probabilities), ObjectClass::kPedestrian);
}

TEST(MonoClassifier, AsInTheThesisTheHighestScoreInTheRectanglesOfAnObjectWins) {
  MonoClassifierOptions options = dnnOptions();
  options.method = MonoMethod::kThesis;
  options.calibrated = false;
  ObjectList objects;
  objects.objects = {objectAt(10.2, 0.0, 0.4, 0.4, 0.0)};
  const ImageDetection rider = detectionOf(ObjectClass::kCyclist, 475, 190, 525, 274, 0.6);
  ImageDetection person = kPerson;
  for (const double score : {0.5, 0.7}) {
    person.score = score;
    ImageDetection narrower = person;
    narrower.box.min().x() += 5.0;
    narrower.score = 0.4;
    for (const auto& seen : {std::vector<ImageDetection>{narrower, person, rider},
                             std::vector<ImageDetection>{rider, person, narrower}}) {
      const MonoClassification result = classified(seen, objects, options);
      ASSERT_EQ(result.classes.size(), 1U);
      const ObjectClass surest = score > rider.score ? person.object_class : rider.object_class;
      EXPECT_EQ(mostLikelyClass(result.classes[0].probabilities), surest) << score;
      EXPECT_NEAR(probabilityOf(surest, result.classes[0].probabilities),
                  std::max(score, rider.score), 1e-5);
    }
  }
}

TEST(MonoClassifier, ObjectsThatAreNotValidAreLeftOut) {
  ObjectList objects;
  objects.objects = {objectAt(10.2, 0.0, 0.4, 0.4, 0.0)};
  objects.objects[0].box.length = -1.0;
  EXPECT_EQ(classified({}, objects).in_view, 0U);
}

TEST(MonoClassifier, RefusesAnImageOfAnotherSize) {
  MonoClassifier classifier(dnnOptions(),
                            std::make_unique<FixedDetector>(std::vector<ImageDetection>()));
  EXPECT_THROW(classifier.classify(cv::Mat(10, 10, CV_8UC1), levelCamera(), ObjectList()),
               std::invalid_argument);
}

TEST(MonoClassifier, ADetectorAtChanceLevelIsUninformative) {
  MonoClassifierOptions options = dnnOptions();
  options.min_alone = 0.0;
  options.dnn_reliability.scores = {0.0, 0.5};
  options.dnn_reliability.right = {0.03, 0.2};
  // The most frequent class among the errors must not be taken for the true one.
  options.dnn_reliability.mistaken = {0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0};
  ObjectList objects;
  objects.objects = {objectAt(10.2, 0.0, 0.4, 0.4, 0.0)};
  const MonoClassification result = classified({kPerson, kCar}, objects, options);
  EXPECT_TRUE(result.classes.empty());
  EXPECT_TRUE(result.alone.objects.empty());
  const MonoClassifier classifier(options,
                                  std::make_unique<FixedDetector>(std::vector<ImageDetection>()));
  EXPECT_FALSE(classifier.isInformative());
  options.dnn_reliability.right[1] = 0.9;
  EXPECT_EQ(classified({kPerson}, objects, options).classes.size(), 1U) << "of a high score";
}

TEST(MonoClassifier, OpenCVsPeopleDetectorHasNoWeight) {
  EXPECT_FALSE(MonoClassifier{MonoClassifierOptions()}.isInformative()) << "as measured";
  MonoClassifierOptions options;
  options.calibrated = false;
  EXPECT_TRUE(MonoClassifier{options}.isInformative()) << "to be measured";
}

TEST(HogDetector, SeesNobodyInEmptyImages) {
  MonoClassifierOptions options;
  options.calibrated = false;
  MonoClassifier classifier{options};
  ObjectList objects;
  objects.objects = {objectAt(8.0, 0.0, 0.5, 0.5, 0.0), objectAt(8.0, 7.9, 0.5, 0.5, 0.0)};
  for (const int gray : {0, 100, 255}) {
    const cv::Mat image(400, 1000, CV_8UC1, cv::Scalar(gray));
    const MonoClassification result = classifier.classify(image, levelCamera(), objects);
    EXPECT_EQ(result.in_view, 2U);
    EXPECT_EQ(result.detections, 0U) << gray;
  }
}

TEST(HogDetector, RefusesImagesOfOtherTypes) {
  HogDetector detector{HogDetectorOptions()};
  EXPECT_THROW(detector.detect(cv::Mat(), {}), std::invalid_argument);
  EXPECT_THROW(detector.detect(cv::Mat(10, 10, CV_16UC1), {}), std::invalid_argument);
}

}  // namespace
}  // namespace datmo::mono_classifier_test
