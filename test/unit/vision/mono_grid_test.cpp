// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/vision/mono_grid.h"

#include <cmath>
#include <cstdint>
#include <limits>
#include <stdexcept>

#include "image_samples.h"
#include <gtest/gtest.h>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

namespace datmo::mono_grid_test {
namespace {

constexpr double kStart = 100.0;     // s
constexpr double kFreeRange = 30.0;  // m
constexpr int kBeams = 91;           // every 2 degrees, from right to left
constexpr double kSpacing = degrees(2.0);
constexpr double kScannerHeight = 0.4;  // m
constexpr std::uint8_t kRoad = 110;
constexpr std::uint8_t kSky = 220;
constexpr std::uint8_t kDark = 20;
constexpr int kHorizon = 200;  // px, of test::levelCamera

int rowAt(double distance) { return static_cast<int>(kHorizon + 750.0 / distance); }

/// An object on the road, `distance` ahead, over all the image's width.
void stand(cv::Mat& image, double distance, double height, std::uint8_t gray) {
  const int foot = rowAt(distance);
  const int top = foot - static_cast<int>(500.0 * height / distance);
  image.rowRange(top, foot).setTo(gray);
}

cv::Mat emptyRoad() {
  cv::Mat image(400, 1000, CV_8UC1, cv::Scalar(kSky));
  image.rowRange(kHorizon, 400).setTo(kRoad);
  return image;
}

/// A wall across the road, `distance` ahead; none: infinite.
Scan scanOf(double distance = std::numeric_limits<double>::infinity()) {
  Scan scan;
  scan.stamp = Stamp::fromSeconds(kStart);
  scan.field = {-0.5 * kSpacing * (kBeams - 1), kSpacing, kBeams, 0.1, kFreeRange, 50.0, 0.0};
  for (std::uint32_t beam = 0; beam < kBeams; ++beam) {
    const double bearing = scan.field.first_bearing + beam * kSpacing;
    const double range = distance / std::cos(bearing);
    const bool hit = range < kFreeRange;
    const double shown = hit ? range : kFreeRange;
    const Point2 end = shown * Point2(std::cos(bearing), std::sin(bearing));
    scan.rays.push_back({Point2::Zero(), end, shown, bearing, beam, hit, 0.0});
  }
  return scan;
}

/// A post `distance` straight ahead, in one beam.
Scan scanOfPost(double distance) {
  Scan scan = scanOf();
  Ray& ray = scan.rays.at(kBeams / 2);
  ray.end = Point2(distance, 0.0);
  ray.range = distance;
  ray.hit = true;
  return scan;
}

/// What images of a level camera and scans report about cells straight ahead.
class MonoGridTest : public testing::Test {
 protected:
  void look(const cv::Mat& image, const Scan& scan) {
    result_ = model_.grid(image, test::levelCamera(), scan, kScannerHeight);
  }

  Percent at(double x, double y = 0.15) const {
    return result_.grid.at(result_.grid.window().cellAt({x, y}));
  }

  static MonoGridOptions thesisOptions() {
    MonoGridOptions options;
    options.method = MonoGridMethod::kThesis;
    options.color.components = 1;
    return options;
  }

  MonoGridModel model_{MonoGridOptions()};
  MonoGridResult result_;
};

TEST_F(MonoGridTest, AnEmptyRoadIsFreeUpToTheFreeRange) {
  look(emptyRoad(), scanOf());
  EXPECT_EQ(result_.grid.stamp(), Stamp::fromSeconds(kStart));
  EXPECT_GT(result_.learned, 1000U);
  EXPECT_TRUE(isFree(at(6.0)));
  EXPECT_TRUE(isFree(at(20.0, 3.0)));
  EXPECT_EQ(at(27.0), kUnknownPercent);
  EXPECT_EQ(at(2.0), kUnknownPercent) << "below the image";
  EXPECT_EQ(at(-10.0), kUnknownPercent);
  EXPECT_EQ(at(5.0, 10.0), kUnknownPercent) << "beside the image";
  EXPECT_EQ(result_.occupied, 0U);
}

TEST_F(MonoGridTest, ObjectsSeenByBothAreOccupied) {
  cv::Mat image = emptyRoad();
  stand(image, 12.0, 2.0, kDark);
  look(image, scanOf(12.0));
  EXPECT_TRUE(isFree(at(10.0)));
  EXPECT_TRUE(isOccupied(at(12.1)));
  EXPECT_EQ(at(15.0), kUnknownPercent);
}

TEST_F(MonoGridTest, AnEchoOfTheRoadsColorIsUndecided) {
  look(emptyRoad(), scanOf(12.0));
  EXPECT_TRUE(isFree(at(10.0)));
  EXPECT_EQ(at(12.1), kUndecidedPercent);
  EXPECT_EQ(at(15.0), kUnknownPercent) << "bounded by the scan's depth";
}

TEST_F(MonoGridTest, BeyondAnEchoTheRoadIsFreeWhereTheScannerSeesPastIt) {
  MountedCamera camera = test::levelCamera();
  camera.in_base.translation().y() = 1.0;  // its line over the post's cell reaches (16, -1)
  const Scan scan = scanOfPost(8.0);
  result_ = model_.grid(emptyRoad(), camera, scan, kScannerHeight);
  EXPECT_TRUE(isFree(at(16.0, -1.0)));
  cv::Mat image = emptyRoad();
  image.rowRange(0, rowAt(8.0)).setTo(kDark);
  result_ = model_.grid(image, camera, scan, kScannerHeight);
  EXPECT_TRUE(isOccupied(at(8.0, 0.0)));
  EXPECT_EQ(at(16.0, -1.0), kUndecidedPercent) << "the post hides it from the camera";
}

TEST_F(MonoGridTest, AnEchoThatALinePassesDoesNotTellWhereAnObstacleBehindItBegins) {
  MountedCamera camera = test::levelCamera();
  camera.in_base.translation().y() = 1.0;
  const Scan scan = scanOfPost(8.0);
  model_.grid(emptyRoad(), camera, scan, kScannerHeight);
  cv::Mat image = emptyRoad();
  stand(image, 16.0, 2.0, kDark);
  result_ = model_.grid(image, camera, scan, kScannerHeight);
  EXPECT_TRUE(isFree(at(12.0, -0.5)));
  EXPECT_EQ(at(15.3, -0.9), kUndecidedPercent) << "the camera may be pitched";
}

TEST_F(MonoGridTest, EachPixelOfACellCountsByItsLikelihood) {
  look(emptyRoad(), scanOf());
  cv::Mat image = emptyRoad();
  for (int column = 0; column < image.cols; ++column) {
    if (column % 5 < 3) {  // rare in the road, most of the cell
      image.col(column).rowRange(kHorizon, image.rows).setTo(kRoad + 9);
    }
  }
  look(image, scanOf());
  EXPECT_TRUE(isFree(at(8.0)));
}

TEST_F(MonoGridTest, LearnsEachCellOnceNearOrFar) {
  MonoGridOptions options;
  options.effective_range = options.learning_range;
  model_ = MonoGridModel(options);
  look(emptyRoad(), scanOf());
  constexpr std::size_t kSamplesOfCell = 5;
  EXPECT_LE(result_.learned, kSamplesOfCell * result_.free);
}

TEST_F(MonoGridTest, PaintOnTheRoadIsFree) {
  look(emptyRoad(), scanOf());
  cv::Mat image = emptyRoad();
  image.rowRange(rowAt(10.4), rowAt(10.0)).setTo(kSky);
  look(image, scanOf());
  EXPECT_TRUE(isFree(at(9.0)));
  EXPECT_TRUE(isFree(at(10.2)));
  EXPECT_TRUE(isFree(at(12.0)));
}

TEST_F(MonoGridTest, ObjectsUnseenByTheScannerAreUndecidedLikeTheRoadBeforeThem) {
  look(emptyRoad(), scanOf());
  cv::Mat image = emptyRoad();
  stand(image, 12.0, 1.5, kDark);
  look(image, scanOf());
  EXPECT_TRUE(isFree(at(9.0)));
  EXPECT_EQ(at(11.6), kUndecidedPercent) << "the camera may be pitched";
  EXPECT_EQ(at(12.5), kUndecidedPercent);
  EXPECT_EQ(at(20.0), kUndecidedPercent);
  EXPECT_EQ(result_.occupied, 0U);
}

TEST_F(MonoGridTest, ObjectsThatHideTheRoadAndEndAreUndecided) {
  look(emptyRoad(), scanOf());
  cv::Mat image = emptyRoad();
  stand(image, 8.0, 0.6, kDark);
  look(image, scanOf());
  EXPECT_EQ(at(9.5), kUndecidedPercent);
  EXPECT_TRUE(isFree(at(16.0))) << "the road is seen over it";
}

TEST_F(MonoGridTest, ColorsDistinguishWhatGrayDoesNot) {
  cv::Mat color;
  cv::cvtColor(emptyRoad(), color, cv::COLOR_GRAY2BGR);
  look(color, scanOf());
  EXPECT_TRUE(isFree(at(12.1)));
  color.rowRange(rowAt(12.0) - 60, rowAt(12.0)).setTo(cv::Scalar(20, kRoad, 200));
  look(color, scanOf(12.0));
  EXPECT_TRUE(isOccupied(at(12.1)));
}

TEST_F(MonoGridTest, TheThesisDecidesForWholeLines) {
  model_ = MonoGridModel(thesisOptions());
  cv::Mat image = emptyRoad();
  stand(image, 12.0, 2.0, kDark);
  look(image, scanOf(12.0));
  for (const double distance : {5.0, 12.1, 40.0}) {
    EXPECT_TRUE(isOccupied(at(distance))) << distance;
  }
  look(emptyRoad(), scanOf(12.0));
  for (const double distance : {5.0, 12.1, 40.0}) {
    EXPECT_TRUE(isFree(at(distance))) << distance;
  }
  EXPECT_EQ(at(5.0, 10.0), kUnknownPercent) << "outside of the camera's view";
}

TEST_F(MonoGridTest, ACameraThatSeesNoRoadIsUninformative) {
  MountedCamera camera = test::levelCamera();
  camera.in_base.translation().z() = -0.1;
  const MonoGridResult below = model_.grid(emptyRoad(), camera, scanOf(), kScannerHeight);
  EXPECT_EQ(below.free + below.occupied, 0U);
  camera = test::levelCamera();
  camera.in_base.linear() << 1.0, 0.0, 0.0, 0.0, -1.0, 0.0, 0.0, 0.0, -1.0;  // straight down
  const MonoGridResult down = model_.grid(emptyRoad(), camera, scanOf(), kScannerHeight);
  EXPECT_EQ(down.free + down.occupied, 0U);
}

TEST_F(MonoGridTest, WithoutBeamsNothingIsLearned) {
  Scan blind = scanOf();
  blind.rays.clear();
  look(emptyRoad(), blind);
  EXPECT_EQ(result_.learned, 0U);
  EXPECT_EQ(result_.free, 0U);
  look(emptyRoad(), scanOf());
  look(emptyRoad(), blind);
  EXPECT_TRUE(isFree(at(10.0))) << "what was learned serves on";
}

TEST_F(MonoGridTest, AnImageOfAnotherSizeIsRefused) {
  const cv::Mat other(200, 1000, CV_8UC1, cv::Scalar(kRoad));
  EXPECT_THROW(look(other, scanOf()), std::invalid_argument);
  EXPECT_THROW(look(cv::Mat(), scanOf()), std::invalid_argument);
}

}  // namespace
}  // namespace datmo::mono_grid_test
