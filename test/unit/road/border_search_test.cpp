// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/road/border_search.h"

#include <cmath>

#include <Eigen/LU>
#include <gtest/gtest.h>

#include "datmo_fusion/common/random.h"

namespace datmo::border_search_test {
namespace {

/// Hits of any age.
HitGridOptions ageless() {
  HitGridOptions options;
  options.min_age = 0.0;
  return options;
}

BorderSearchOptions thesisForm() {
  BorderSearchOptions options;
  options.heading_range = 0.0;
  options.score = BorderScore::kHits;
  options.min_hits = 300.0;
  return options;
}

/// Hits on a straight border: `begin` is where it begins and how it runs, m, map frame.
void addLine(HitGrid& hits, const Pose2& begin, double length, double sigma = 0.1,
             int hits_per_meter = 15) {
  Random random(1);
  const int count = static_cast<int>(length) * hits_per_meter;
  for (int i = 0; i < count; ++i) {
    hits.add(begin * Point2(length * i / count, random.normal(sigma)), Stamp());
  }
}

/// Signed distance of a line from a point of the map, m; positive: the point is to the left.
double offsetTo(const FoundBorder& border, const Point2& point) {
  return (border.line.inverse() * point).y();
}

class BorderSearchTest : public ::testing::Test {
 protected:
  HitGrid hits_{ageless()};
  BorderSearch search_{BorderSearchOptions()};
};

TEST_F(BorderSearchTest, WithoutHitsThereIsNoBorder) {
  EXPECT_FALSE(search_.search(hits_, Pose2(), RoadSide::kLeft));
  EXPECT_FALSE(BorderSearch(thesisForm()).search(hits_, Pose2(), RoadSide::kRight));
}

TEST_F(BorderSearchTest, FindsABorderThatIsNotParallelOnEitherSide) {
  const Pose2 from(3.0, -2.0, 0.8);
  const Pose2 left(0.0, 4.3, 0.08);
  const Pose2 right(0.0, -5.6, 0.08);
  addLine(hits_, from * left, 22.0);
  addLine(hits_, from * right, 22.0);
  for (const RoadSide side : {RoadSide::kLeft, RoadSide::kRight}) {
    const std::optional<FoundBorder> border = search_.search(hits_, from, side);
    ASSERT_TRUE(border) << nameOf(side);
    EXPECT_EQ(border->side, side);
    EXPECT_GT(border->score, 0.9);
    const Pose2 truth = from * (side == RoadSide::kLeft ? left : right);
    EXPECT_NEAR(angleBetween(border->line.heading(), truth.heading()), 0.0, 0.01);
    EXPECT_NEAR(offsetTo(*border, truth * Point2(1.0, 0.0)), 0.0, 0.06);
    EXPECT_NEAR(offsetTo(*border, truth * Point2(19.0, 0.0)), 0.0, 0.06);
    EXPECT_LT((from.inverse() * border->line.position()).cwiseAbs().x(), 1.0);
  }
}

TEST_F(BorderSearchTest, ItsCovarianceIsConsistent) {
  double sum = 0.0;
  const int trials = 100;
  Random random(2);
  for (int i = 0; i < trials; ++i) {
    hits_.reset();
    const Pose2 truth(0.0, random.uniform(3.0, 8.0), random.uniform(-0.1, 0.1));
    for (int hit = 0; hit < 300; ++hit) {
      hits_.add(truth * Point2(random.uniform(0.0, 21.0), random.normal(0.2)), Stamp());
    }
    const std::optional<FoundBorder> border = search_.search(hits_, Pose2(), RoadSide::kLeft);
    ASSERT_TRUE(border);
    const Pose2 line_in_truth = truth.inverse() * border->line;
    const double heading = line_in_truth.heading();
    const Eigen::Vector2d error(line_in_truth.y() - line_in_truth.x() * std::tan(heading), heading);
    sum += error.dot(border->covariance.inverse() * error) / 2.0;
  }
  EXPECT_GT(sum / trials, 0.1);
  EXPECT_LT(sum / trials, 2.0);
}

TEST_F(BorderSearchTest, TheNearestBorderIsTakenAndNotTheHousesBehindIt) {
  addLine(hits_, Pose2(0.0, 5.0, 0.0), 21.0, 0.1, 10);
  addLine(hits_, Pose2(0.0, 9.0, 0.0), 21.0, 0.1, 30);
  const std::optional<FoundBorder> nearest = search_.search(hits_, Pose2(), RoadSide::kLeft);
  ASSERT_TRUE(nearest);
  EXPECT_NEAR(nearest->line.y(), 5.0, 0.1);

  BorderSearchOptions options = thesisForm();
  options.take = BorderChoice::kHighest;
  const std::optional<FoundBorder> highest =
      BorderSearch(options).search(hits_, Pose2(), RoadSide::kLeft);
  ASSERT_TRUE(highest);
  EXPECT_NEAR(highest->line.y(), 9.0, 0.1);
}

TEST_F(BorderSearchTest, CarsInARowAreOneBorderAndASingleCarIsNone) {
  addLine(hits_, Pose2(0.0, 4.0, 0.0), 4.5);
  EXPECT_FALSE(search_.search(hits_, Pose2(), RoadSide::kLeft));
  for (const double x : {7.0, 14.0}) {
    addLine(hits_, Pose2(x, 4.0, 0.0), 4.5);
  }
  const std::optional<FoundBorder> border = search_.search(hits_, Pose2(), RoadSide::kLeft);
  ASSERT_TRUE(border);
  EXPECT_NEAR(border->line.y(), 4.0, 0.1);
}

TEST_F(BorderSearchTest, ALineWithObjectsBesideItIsNotPulled) {
  addLine(hits_, Pose2(0.0, 4.0, 0.0), 21.0);
  for (const double x : {3.0, 9.0, 15.0}) {  // rears of cars
    addLine(hits_, Pose2(x, 4.0, kQuarterTurn), 2.0);
  }
  const std::optional<FoundBorder> border = search_.search(hits_, Pose2(), RoadSide::kLeft);
  ASSERT_TRUE(border);
  EXPECT_NEAR(border->line.y(), 4.0, 0.12);
}

TEST_F(BorderSearchTest, TheThesissFormSumsTheHitsUnderUprightWindows) {
  // One hit counts in nine cells, all of which are in the window at 4.6 m: from 4.1 to 5.1 m.
  hits_.add({10.0, 4.65}, Stamp());
  BorderSearchOptions options = thesisForm();
  options.min_hits = 9.0;
  const std::optional<FoundBorder> border =
      BorderSearch(options).search(hits_, Pose2(), RoadSide::kLeft);
  ASSERT_TRUE(border);
  EXPECT_EQ(border->score, 9.0);
  options.min_hits = 9.5;
  EXPECT_FALSE(BorderSearch(options).search(hits_, Pose2(), RoadSide::kLeft));
}

TEST_F(BorderSearchTest, SearchesAsFarAsItsWindowsReach) {
  // The thesis's last windows: 1 + 24 * 0.9 = 22.6 m to the left, 1 + 14 * 0.9 = 13.6 m to the
  // right.
  addLine(hits_, Pose2(0.0, 22.6, 0.0), 21.0);
  addLine(hits_, Pose2(0.0, -15.5, 0.0), 21.0);
  BorderSearchOptions straight;
  straight.heading_range = 0.0;
  const BorderSearch search(straight);
  EXPECT_TRUE(search.search(hits_, Pose2(), RoadSide::kLeft));
  EXPECT_FALSE(search.search(hits_, Pose2(), RoadSide::kRight));
}

TEST(BorderSearchOptionsTest, BadOnesAreRefused) {
  EXPECT_THROW(readOptions<BorderSearchOptions>({{"score", std::string("luck")}}), OptionError);
  BorderSearchOptions options;
  options.sections = 65;
  EXPECT_THROW(BorderSearch{options}, OptionError);
}

}  // namespace
}  // namespace datmo::border_search_test
