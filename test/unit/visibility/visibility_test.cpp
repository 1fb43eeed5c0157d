// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/visibility/visibility.h"

#include <cmath>

#include <gtest/gtest.h>

namespace datmo::visibility_test {
namespace {

const VisibilityOptions kOptions;

/// 181 beams from right to left, 1 degree apart, up to 80 m, known free up to 40 m: no return.
LabeledScan emptyScan() {
  LabeledScan scan;
  scan.field = {degrees(-90.0), degrees(1.0), 181, 0.5, 40.0, 80.0};
  return scan;
}

/// Beam of emptyScan() at this bearing.
std::uint32_t beamAt(double bearing_degrees) {
  return static_cast<std::uint32_t>(std::lround(bearing_degrees + 90.0));
}

/// Beams from one bearing to another (degrees) end at this range.
void addWall(LabeledScan& scan, int first, int last, double range) {
  for (int bearing = first; bearing <= last; ++bearing) {
    ScanPoint point;
    point.beam = beamAt(bearing);
    point.range = range;
    point.bearing = degrees(bearing);
    point.position = range * Point2(std::cos(point.bearing), std::sin(point.bearing));
    scan.points.push_back(point);
  }
}

Box2 carAt(double x, double y) { return {{x, y, 0.0}, 4.0, 2.0}; }
Box2 pedestrianAt(double x, double y) { return {{x, y, 0.0}, 0.6, 0.6}; }

double seen(const LabeledScan& scan, const Box2& box, double sigma = 0.0) {
  return Visibility(scan, kOptions).detectionProbability(box, sigma);
}

TEST(Visibility, WithoutAViewItIsTheOptionsProbability) {
  EXPECT_EQ(Visibility(kOptions).detectionProbability(carAt(10.0, 0.0), 1.0),
            kOptions.unknown_probability);
  EXPECT_EQ(seen(LabeledScan(), carAt(10.0, 0.0)), kOptions.unknown_probability)
      << "a scan whose field nobody has filled in";
}

TEST(Visibility, ABeamWithoutReturnWouldHaveSeenTheObject) {
  EXPECT_NEAR(seen(emptyScan(), carAt(20.0, 0.0)), kOptions.max_probability, 1e-3);
}

TEST(Visibility, AWallBehindTheObjectDoesNotHideItAndOneInFrontDoes) {
  LabeledScan scan = emptyScan();
  addWall(scan, -90, 90, 30.0);
  EXPECT_NEAR(seen(scan, carAt(20.0, 0.0)), kOptions.max_probability, 1e-3);
  EXPECT_EQ(seen(scan, carAt(40.0, 0.0)), kOptions.min_probability);
}

TEST(Visibility, TheObjectsOwnReturnsDoNotHideIt) {
  LabeledScan scan = emptyScan();
  addWall(scan, -3, 3, 18.0);
  EXPECT_NEAR(seen(scan, carAt(20.0, 0.0)), kOptions.max_probability, 1e-3) << "on its near side";
  EXPECT_NEAR(seen(scan, carAt(20.4, 0.0)), kOptions.max_probability, 1e-3) << "a bit nearer";
  EXPECT_NEAR(seen(scan, carAt(17.0, 0.0)), kOptions.max_probability, 1e-3) << "inside it";
  EXPECT_EQ(seen(scan, carAt(21.0, 0.0)), kOptions.min_probability) << "0.99 m nearer";
}

TEST(Visibility, OutsideTheFieldOfViewAndTheReachNothingIsSeen) {
  EXPECT_EQ(seen(emptyScan(), carAt(-20.0, 0.0)), kOptions.min_probability);
  EXPECT_EQ(seen(emptyScan(), carAt(85.0, 0.0)), kOptions.min_probability);
  EXPECT_EQ(seen(emptyScan(), pedestrianAt(0.5, 0.0)), kOptions.min_probability)
      << "nearer than the least range";
}

TEST(Visibility, APedestrianBetweenTheBeamsIsSeenAsOftenAsOneMeetsIt) {
  // Facing the scanner at 40 m, its near side, 39.7 m away, is as wide as 0.866 beams.
  const double beams = 2.0 * std::atan(0.3 / 39.7) / degrees(1.0);
  ASSERT_LT(beams, 1.0);
  const double expected = kOptions.max_probability * beams * kOptions.beam_detection;
  EXPECT_NEAR(seen(emptyScan(), pedestrianAt(40.0, 0.0)), expected, 1e-6);
}

TEST(Visibility, EveryFurtherBeamCutsTheChanceOfAMiss) {
  // 2.62 beams: two, and a third one with a probability of 62 %.
  const double beams = 2.0 * std::atan(0.3 / 13.1) / degrees(1.0);
  const double miss = 1.0 - kOptions.beam_detection;
  const double expected = 1.0 - miss * miss * (1.0 - (beams - 2.0) * kOptions.beam_detection);
  EXPECT_NEAR(seen(emptyScan(), pedestrianAt(13.4, 0.0)), kOptions.max_probability * expected,
              1e-6);
}

TEST(Visibility, OnlyTheBeamsThatAreNotBlockedCount) {
  LabeledScan scan = emptyScan();
  addWall(scan, 0, 90, 5.0);
  // 3.0 beams wide, seen in eight directions; the beam ahead is blocked from half a degree to its
  // right, so that three of them are clear: 1.125 beams.
  const Box2 box{{20.0, 0.0, 0.0}, 0.1, 2.0 * 19.95 * std::tan(degrees(1.5))};
  const double miss = 1.0 - kOptions.beam_detection;
  const double expected = 1.0 - miss * (1.0 - 0.125 * kOptions.beam_detection);
  EXPECT_NEAR(seen(scan, box), kOptions.max_probability * expected, 1e-6);
}

TEST(Visibility, BeyondTheFreeRangeObjectsFade) {
  const Box2 wide{{0.0, 0.0, 0.0}, 0.1, 0.9 * degrees(1.0)};
  double last = 1.0;
  for (const double range : {30.0, 50.0, 60.0, 70.0, 79.0}) {
    Box2 box = wide;
    box.width *= range;
    box.center = Pose2(range, 0.0, 0.0);
    const double now = seen(emptyScan(), box);
    EXPECT_LT(now, last) << range;
    last = now;
  }
  Box2 box = wide;
  box.width *= 60.0;
  box.center = Pose2(60.0, 0.0, 0.0);
  EXPECT_NEAR(seen(emptyScan(), box),
              kOptions.max_probability * 0.9 * 0.5 * kOptions.beam_detection, 0.002);
}

TEST(Visibility, BlindBeamsSeeNothing) {
  LabeledScan scan = emptyScan();
  for (std::uint32_t beam = beamAt(-10); beam <= beamAt(10); ++beam) {
    scan.blind_beams.push_back(beam);
  }
  EXPECT_EQ(seen(scan, carAt(20.0, 0.0)), kOptions.min_probability);
  EXPECT_GT(seen(scan, carAt(20.0, 10.0)), 0.9);
}

TEST(Visibility, BeamsAndBlindOnesThatTheFieldDoesNotHaveAreLeftOut) {
  LabeledScan scan = emptyScan();
  scan.blind_beams = {181, 65535};
  scan.points.resize(1);
  scan.points[0].beam = 500;
  EXPECT_NEAR(seen(scan, carAt(20.0, 0.0)), kOptions.max_probability, 1e-3);
}

/// A pole at 30 degrees to the left, in a full-circle scan from a scanner that turns in this
/// direction.
LabeledScan poleToTheLeft(double spacing_degrees, double first_degrees) {
  LabeledScan scan;
  scan.field = {degrees(first_degrees), degrees(spacing_degrees), 360, 0.1, 40.0, 40.0};
  for (std::uint32_t beam = 0; beam < 360; ++beam) {
    const double bearing = degrees(first_degrees + spacing_degrees * beam);
    if (std::abs(angleBetween(bearing, degrees(30.0))) < degrees(5.5)) {
      scan.points.push_back({Point2::Zero(), 5.0, bearing, beam, PointState::kStatic});
    }
  }
  return scan;
}

TEST(Visibility, WhicheverWayTheScannerTurnsAndWhereverItBegins) {
  const auto at = [](double bearing) {
    return pedestrianAt(10.0 * std::cos(degrees(bearing)), 10.0 * std::sin(degrees(bearing)));
  };
  for (const double spacing : {1.0, -1.0}) {
    for (const double first : {-180.0, 0.0, 180.0, 29.5, 30.5, 400.0}) {
      const LabeledScan scan = poleToTheLeft(spacing, first);
      EXPECT_EQ(seen(scan, at(30.0)), kOptions.min_probability) << spacing << " from " << first;
      for (const double bearing : {0.0, 90.0, 179.9, -179.9, -30.0, -90.0}) {
        EXPECT_GT(seen(scan, at(bearing)), 0.9) << bearing << ": " << spacing << " from " << first;
      }
    }
  }
}

TEST(Visibility, TheScannersMountCounts) {
  LabeledScan scan = emptyScan();
  addWall(scan, -5, 5, 10.0);
  scan.scanner_in_base = Pose2(3.0, 1.0, kPi / 2.0);
  EXPECT_EQ(seen(scan, carAt(3.0, 21.0)), kOptions.min_probability) << "behind the wall";
  EXPECT_GT(seen(scan, carAt(20.0, 12.0)), 0.9) << "beside it";
  EXPECT_EQ(seen(scan, carAt(3.0, -21.0)), kOptions.min_probability) << "behind the scanner";
}

TEST(Visibility, TurningObjectAndScannerTogetherChangesNothing) {
  LabeledScan scan = emptyScan();
  addWall(scan, -20, 0, 12.0);
  const Box2 box{{20.0, 0.5, 0.6}, 4.0, 1.8};
  const double before = seen(scan, box, 0.7);
  for (const double turn : {0.5, 2.0, -3.0}) {
    const Pose2 moved(7.0, -3.0, turn);
    scan.scanner_in_base = moved;
    EXPECT_NEAR(seen(scan, {moved * box.center, box.length, box.width}, 0.7), before, 1e-9);
  }
}

TEST(Visibility, AnUncertainPositionIsTheMeanOverPositions) {
  LabeledScan scan = emptyScan();
  addWall(scan, -90, 0, 5.0);
  const Box2 at_the_edge = pedestrianAt(10.0, 0.0);
  const double behind = seen(scan, pedestrianAt(10.0, -5.0));
  const double free = seen(scan, pedestrianAt(10.0, 5.0));
  const double middle = seen(scan, at_the_edge, 2.0);
  EXPECT_GT(middle, behind + 0.2);
  EXPECT_LT(middle, free - 0.2);
  // Ahead (1/3), and one step of 3.46 m nearer and farther (1/6 each), it is seen as at the edge;
  // to the left fully, to the right not at all.
  const double full = seen(scan, pedestrianAt(10.0, 5.0));
  EXPECT_NEAR(middle, seen(scan, at_the_edge) * 2.0 / 3.0 + full / 6.0, 0.1);
}

TEST(Visibility, AnObjectThatMayBeInFrontOfTheWallMayBeSeen) {
  LabeledScan scan = emptyScan();
  addWall(scan, -90, 90, 18.0);
  EXPECT_EQ(seen(scan, carAt(21.0, 0.0)), kOptions.min_probability);
  EXPECT_NEAR(seen(scan, carAt(21.0, 0.0), 1.0), kOptions.max_probability / 6.0, 0.01);
}

TEST(Visibility, AroundTheScannerItIsUnknown) {
  EXPECT_EQ(seen(emptyScan(), carAt(0.5, 0.5)), kOptions.unknown_probability);
}

TEST(Visibility, StaysWithinItsBounds) {
  LabeledScan scan = emptyScan();
  addWall(scan, -40, 10, 15.0);
  const Visibility visibility(scan, kOptions);
  for (double x = -30.0; x <= 90.0; x += 7.3) {
    for (double y = -50.0; y <= 50.0; y += 6.1) {
      for (const double sigma : {0.0, 0.3, 3.0, 30.0}) {
        for (const double size : {0.0, 1.0, 15.0}) {
          const double p = visibility.detectionProbability({{x, y, x - y}, size, size}, sigma);
          EXPECT_GE(p, kOptions.min_probability);
          EXPECT_LE(p, kOptions.max_probability);
        }
      }
    }
  }
}

TEST(Visibility, AFieldOfViewWithBoxesHidesObjectsBehindThem) {
  const FieldOfView view{Pose2(1.0, 0.0, 0.0), degrees(-40.0), degrees(40.0), 50.0, 70.0};
  const Box2 van{{15.0, 0.0, 0.0}, 5.0, 2.2};
  const Visibility visibility(view, {van}, kOptions);
  const auto p = [&](const Box2& box) { return visibility.detectionProbability(box, 0.0); };
  EXPECT_GT(p(van), 0.9) << "what was seen does not hide itself";
  EXPECT_GT(p(pedestrianAt(10.0, 0.0)), 0.9) << "nearer";
  EXPECT_EQ(p(pedestrianAt(25.0, 0.0)), kOptions.min_probability) << "behind it";
  EXPECT_GT(p(pedestrianAt(25.0, 8.0)), 0.9) << "beside it";
  EXPECT_EQ(p(carAt(10.0, 15.0)), kOptions.min_probability) << "outside the field";
  EXPECT_EQ(p(carAt(80.0, 0.0)), kOptions.min_probability) << "out of reach";
  EXPECT_NEAR(p(carAt(59.1, 15.0)), 0.5 * kOptions.max_probability, 0.01) << "hard to see";
}

TEST(Visibility, AViewWithoutWidthSeesNothing) {
  const FieldOfView view{Pose2(), 1.0, -1.0, 50.0, 50.0};
  EXPECT_EQ(Visibility(view, {}, kOptions).detectionProbability(carAt(10.0, 0.0), 0.0),
            kOptions.unknown_probability);
}

TEST(Visibility, OptionsOutOfRangeAreRefused) {
  VisibilityOptions options;
  options.beam_detection = 1.5;
  EXPECT_THROW(Visibility{options}, OptionError);
}

}  // namespace
}  // namespace datmo::visibility_test
