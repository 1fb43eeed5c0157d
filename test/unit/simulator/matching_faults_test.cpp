// SPDX-License-Identifier: BSD-3-Clause
#include "simulator/matching_faults.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

namespace datmo::simulator::matching_faults_test {
namespace {

/// Every pixel, all of one disparity.
DisparityImage evenImage(int columns, int rows, double disparity) {
  DisparityImage image;
  image.columns = columns;
  image.rows = rows;
  image.seen.assign(static_cast<std::size_t>(columns * rows), disparity);
  image.measured = image.seen;
  return image;
}

/// One row: background of 5 px, columns 50 to 59 of 15 px.
DisparityImage rowWithNearerThing() {
  DisparityImage image = evenImage(100, 1, 5.0);
  std::fill(image.seen.begin() + 50, image.seen.begin() + 60, 15.0);
  image.measured = image.seen;
  return image;
}

RandomStream stream() { return {1, "stereo"}; }

TEST(RemoveHidden, BandLeftOfTheNearerObject) {
  // The object is in columns 35 to 44 of the right image, where the background of the left image's
  // columns 40 to 49 would be. Columns 0 to 4 are left of the right image.
  DisparityImage image = rowWithNearerThing();
  removeHidden(image);
  for (std::size_t column = 0; column < 100; ++column) {
    const bool hidden = column < 5 || (column >= 40 && column < 50);
    EXPECT_EQ(image.measured[column], hidden ? kNoDisparity : image.seen[column]) << column;
  }
}

TEST(RemoveHidden, StepsCoverTheRowsBetweenThem) {
  // Every second pixel of the same row.
  DisparityImage image = evenImage(50, 1, 5.0);
  image.column_step = 2;
  std::fill(image.seen.begin() + 25, image.seen.begin() + 30, 15.0);
  image.measured = image.seen;
  removeHidden(image);
  for (std::size_t column = 3; column < 50; ++column) {
    const bool hidden = column >= 20 && column < 25;
    EXPECT_EQ(image.measured[column] == kNoDisparity, hidden) << column;
  }
}

TEST(MixEdges, OnlyBackgroundBesideTheNearerObject) {
  DisparityImage image = rowWithNearerThing();
  RandomStream random = stream();
  mixEdges(image, 2, 1.0, random);
  for (std::size_t column = 0; column < 100; ++column) {
    const bool mixed = column == 48 || column == 49 || column == 60 || column == 61;
    EXPECT_EQ(image.measured[column] != image.seen[column], mixed) << column;
    EXPECT_GE(image.measured[column], 5.0);
    EXPECT_LE(image.measured[column], 15.0);
  }
}

TEST(AddNoise, HasItsDeviationAndItsCommonPart) {
  constexpr int kSide = 200;
  constexpr double kSigma = 0.25;
  double variance = 0.0;
  double with_neighbor = 0.0;
  RandomStream random = stream();
  constexpr int kImages = 20;
  for (int i = 0; i < kImages; ++i) {
    DisparityImage image = evenImage(kSide, kSide, 20.0);
    addNoise(image, kSigma, 0.6, 16, random);
    for (int row = 0; row < kSide; ++row) {
      for (int column = 0; column + 1 < kSide; ++column) {
        const double error = image.measured[image.slot(column, row)] - 20.0;
        variance += error * error;
        with_neighbor += error * (image.measured[image.slot(column + 1, row)] - 20.0);
      }
    }
  }
  const double count = kImages * kSide * (kSide - 1.0);
  EXPECT_NEAR(std::sqrt(variance / count), kSigma, 0.01);
  EXPECT_NEAR(with_neighbor / variance, 0.6, 0.03);
}

TEST(AddNoise, LeavesHolesAlone) {
  DisparityImage image = evenImage(10, 10, kNoDisparity);
  RandomStream random = stream();
  addNoise(image, 1.0, 0.5, 4, random);
  EXPECT_EQ(image.measured, image.seen);
}

TEST(AddOutliers, ShareSizeAndLimits) {
  DisparityImage image = evenImage(400, 400, 20.0);
  RandomStream random = stream();
  addOutliers(image, 0.02, 4, 2.0, 10.0, random);
  int outliers = 0;
  for (int row = 0; row < image.rows; ++row) {
    for (int column = 0; column < image.columns; ++column) {
      const double disparity = image.measured[image.slot(column, row)];
      EXPECT_EQ(disparity, image.measured[image.slot(column / 4 * 4, row / 4 * 4)]);
      if (disparity != 20.0) {
        ++outliers;
        EXPECT_GE(disparity, 2.0);
        EXPECT_LE(disparity, 10.0);
      }
    }
  }
  EXPECT_NEAR(outliers / 160000.0, 0.02, 0.005);
}

}  // namespace
}  // namespace datmo::simulator::matching_faults_test
