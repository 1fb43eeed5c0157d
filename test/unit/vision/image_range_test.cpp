// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/vision/image_range.h"

#include <cmath>
#include <stdexcept>

#include "vision/image_samples.h"
#include <gtest/gtest.h>

namespace datmo::image_range_test {
namespace {

using test::detectionOf;
using test::levelCamera;

/// A person of mean height at this distance, `columns` beside the middle.
ImageDetection personAt(double distance, double columns = 0.0) {
  const double feet = 200.0 + 500.0 * test::kCameraHeight / distance;
  const double height = 500.0 * sizeOf(ObjectClass::kPedestrian).height / distance;
  return detectionOf(ObjectClass::kPedestrian, 490.0 + columns, feet - height, 510.0 + columns,
                     feet);
}

TEST(ImageRange, SizeAndGroundAgreeOnAPersonOfMeanHeight) {
  for (const double distance : {8.0, 15.0, 30.0}) {
    const auto range = rangeOf(levelCamera(), personAt(distance), ImageRangeOptions());
    ASSERT_TRUE(range);
    EXPECT_NEAR(range->range, distance, 1e-6);
    EXPECT_GT(range->sigma, 0.02 * distance);
    EXPECT_LT(range->sigma, 0.15 * distance) << "surer than by the height alone";
  }
}

TEST(ImageRange, FartherAwayIsLessCertain) {
  const ImageRangeOptions options;
  const auto near = rangeOf(levelCamera(), personAt(10.0), options);
  const auto far = rangeOf(levelCamera(), personAt(40.0), options);
  ASSERT_TRUE(near && far);
  EXPECT_GT(far->sigma, 4.0 * near->sigma) << "faster than in proportion";
}

TEST(ImageRange, AContradictionMakesItLessCertain) {
  // A child, or a person on a wall: feet at 10 m, with the height of a person at 20 m.
  ImageDetection person = personAt(10.0);
  person.box.min().y() = 0.5 * (person.box.min().y() + person.box.max().y());
  const auto range = rangeOf(levelCamera(), person, ImageRangeOptions());
  const auto plain = rangeOf(levelCamera(), personAt(10.0), ImageRangeOptions());
  ASSERT_TRUE(range && plain);
  EXPECT_GT(range->range, 10.0);
  EXPECT_LT(range->range, 20.0);
  EXPECT_GT(range->sigma, 2.0 * plain->sigma);
}

TEST(ImageRange, CutEdgesAreUninformative) {
  const MountedCamera camera = levelCamera();
  ImageDetection feet_cut = personAt(3.0);
  feet_cut.box.max().y() = camera.height;
  EXPECT_FALSE(rangeOf(camera, feet_cut, ImageRangeOptions()));
  ImageDetection head_cut = personAt(10.0);
  head_cut.box.min().y() = 0.0;
  const auto by_ground = rangeOf(camera, head_cut, ImageRangeOptions());
  ASSERT_TRUE(by_ground);
  EXPECT_NEAR(by_ground->range, 10.0, 1e-6);
}

TEST(ImageRange, NeitherEmptyNorTooFar) {
  ImageDetection empty = personAt(10.0);
  empty.box.max().x() = empty.box.min().x();
  EXPECT_FALSE(rangeOf(levelCamera(), empty, ImageRangeOptions()));
  ImageRangeOptions options;
  options.max_range = 20.0;
  EXPECT_FALSE(rangeOf(levelCamera(), personAt(25.0), options));
}

TEST(ImageRange, BesideTheMiddleItIsFartherThanItIsDeep) {
  const auto range = rangeOf(levelCamera(), personAt(20.0, 250.0), ImageRangeOptions());
  ASSERT_TRUE(range);
  EXPECT_NEAR(range->range, std::hypot(20.0, 10.0), 1e-6);
}

TEST(ImageRange, OnlyOfReportedClasses) {
  EXPECT_THROW(sizeOf(ObjectClass::kPole), std::invalid_argument);
  EXPECT_THROW(sizeOf(ObjectClass::kUnknown), std::invalid_argument);
  EXPECT_GT(sizeOf(ObjectClass::kVehicle).height_sigma, 0.3) << "cars, vans and trucks";
}

}  // namespace
}  // namespace datmo::image_range_test
