// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/ros/convert/scan_conversion.h"

#include <limits>

#include "message_samples.h"
#include <gtest/gtest.h>

namespace datmo::scan_conversion_test {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

/// 1 m ahead of the vehicle's origin, facing ahead.
ScannerMount bumper() {
  ScannerMount mount;
  mount.scanner_in_base = Pose2(1.0, 0.0, 0.0);
  return mount;
}

ConvertedScan convert(const sensor_msgs::LaserScan& message) {
  return toScan(message, bumper(), ScanConversionOptions());
}

void expectEnd(const Ray& ray, double x, double y) {
  EXPECT_NEAR(ray.end.x(), x, 1e-6);
  EXPECT_NEAR(ray.end.y(), y, 1e-6);
}

TEST(ScanConversion, BeamsEndWhereTheScannerPoints) {
  const Scan scan = convert(samples::laserScan()).scan;
  ASSERT_EQ(scan.rays.size(), 3U);
  expectEnd(scan.rays[0], 1.0, -2.0);
  expectEnd(scan.rays[1], 4.0, 0.0);
  expectEnd(scan.rays[2], 1.0, 4.0);
  EXPECT_NEAR(scan.rays[2].bearing, kPi / 2.0, 1e-6);
  EXPECT_EQ(scan.rays[2].beam, 2U);
  EXPECT_TRUE(scan.rays[2].hit);
  EXPECT_NEAR(scan.field.beam_spacing, kPi / 2.0, 1e-6);
  EXPECT_EQ(scan.stamp, Stamp::fromSeconds(samples::kStart));
  EXPECT_EQ(scan.rays[0].origin, Point2(1.0, 0.0));
}

/// Beams that have a ray: as the field reports them and as they are.
void expectFieldMatchesBearings(const Scan& scan) {
  for (const Ray& ray : scan.rays) {
    EXPECT_NEAR(
        angleBetween(scan.field.first_bearing + scan.field.beam_spacing * ray.beam, ray.bearing),
        0.0, 1e-6);
  }
}

TEST(ScanConversion, TheFieldCoversAllBeams) {
  ScanConversionOptions options;
  options.free_range = 15.0;
  const Scan scan = toScan(samples::laserScan({kNan, kInfinity, 4.0F}), bumper(), options).scan;
  EXPECT_EQ(scan.field.beams, 3U);
  EXPECT_EQ(scan.field.min_range, 1.0);
  EXPECT_EQ(scan.field.free_range, 15.0);
  EXPECT_EQ(scan.field.range, 20.0);
  expectFieldMatchesBearings(scan);
}

TEST(ScanConversion, ATurnedScannerTurnsItsBeams) {
  ScannerMount mount;
  mount.scanner_in_base = Pose2(0.0, 0.0, kPi / 2.0);
  const Scan scan = toScan(samples::laserScan(), mount, {}).scan;
  expectEnd(scan.rays[0], 2.0, 0.0);
  expectEnd(scan.rays[1], 0.0, 3.0);
}

TEST(ScanConversion, UpsideDownMirrorsTheBeams) {
  ScannerMount mount;
  mount.upside_down = true;
  const Scan scan = toScan(samples::laserScan(), mount, {}).scan;
  expectEnd(scan.rays[0], 0.0, 2.0);
  expectEnd(scan.rays[2], 0.0, -4.0);
  expectFieldMatchesBearings(scan);
  EXPECT_NEAR(scan.rays[0].bearing, kPi / 2.0, 1e-6);
}

TEST(ScanConversion, AScannerThatTurnsTheOtherWayRound) {
  auto message = samples::laserScan();
  std::swap(message.angle_min, message.angle_max);
  message.angle_increment = -message.angle_increment;
  const Scan scan = convert(message).scan;
  expectEnd(scan.rays[0], 1.0, 2.0);
  EXPECT_NEAR(scan.field.beam_spacing, -kPi / 2.0, 1e-6);
  expectFieldMatchesBearings(scan);
}

TEST(ScanConversion, EachBeamHasItsTimeWhicheverWayTheScannerTurns) {
  for (const bool to_the_right : {false, true}) {
    auto message = samples::laserScan({2.0F, kNan, 4.0F});
    message.time_increment = 0.01F;
    if (to_the_right) {
      std::swap(message.angle_min, message.angle_max);
      message.angle_increment = -message.angle_increment;
    }
    const auto converted = convert(message);
    EXPECT_FALSE(converted.unusable_times);
    ASSERT_EQ(converted.scan.rays.size(), 2U);
    EXPECT_EQ(converted.scan.rays[0].time, 0.0);
    EXPECT_NEAR(converted.scan.rays[1].time, 0.02, 1e-8);
  }
}

TEST(ScanConversion, BadBeamTimesDoNotCostTheScan) {
  for (const float bad : {-0.001F, 0.2F, kInfinity, kNan}) {
    auto message = samples::laserScan();
    message.time_increment = bad;
    const auto converted = convert(message);
    EXPECT_EQ(converted.beams.hits, 3U);
    EXPECT_EQ(converted.scan.rays.back().time, 0.0);
    ASSERT_TRUE(converted.unusable_times) << bad;
    EXPECT_EQ(converted.unusable_times->reason(), "bad_beam_times");
    EXPECT_NE(std::string(converted.unusable_times->what()).find(std::to_string(bad)),
              std::string::npos);
  }
}

TEST(ScanConversion, ASweepMayLastAsLongAsTheOptionSays) {
  auto message = samples::laserScan();
  message.time_increment = 0.2F;  // two steps: 0.4 s
  ScanConversionOptions options;
  options.max_sweep = 0.5;
  EXPECT_FALSE(toScan(message, bumper(), options).unusable_times);
}

TEST(ScanConversion, NoReturnIsFreeUpToTheFreeRange) {
  ScanConversionOptions options;
  options.free_range = 5.0;
  const auto converted = toScan(samples::laserScan({kInfinity, 21.0F, 3.0F}), bumper(), options);
  EXPECT_EQ(converted.beams.no_return, 2U);
  EXPECT_EQ(converted.beams.hits, 1U);
  ASSERT_EQ(converted.scan.rays.size(), 3U);
  EXPECT_FALSE(converted.scan.rays[0].hit);
  EXPECT_DOUBLE_EQ(converted.scan.rays[0].range, 5.0);
  expectEnd(converted.scan.rays[1], 6.0, 0.0);
}

TEST(ScanConversion, NothingIsFreeBeyondTheScannersReach) {
  ScanConversionOptions options;
  options.free_range = 100.0;
  const auto converted = toScan(samples::laserScan({kInfinity, 3.0F, 3.0F}), bumper(), options);
  EXPECT_DOUBLE_EQ(converted.scan.rays[0].range, 20.0);
}

TEST(ScanConversion, AFreeRangeOfZeroMakesNoRays) {
  ScanConversionOptions options;
  options.free_range = 0.0;
  const auto converted = toScan(samples::laserScan({kInfinity, 3.0F, 3.0F}), bumper(), options);
  EXPECT_EQ(converted.scan.rays.size(), 2U);
  EXPECT_EQ(converted.beams.no_return, 1U);
}

TEST(ScanConversion, InvalidBeamsHaveNoRayAndKeepTheOthersIndex) {
  auto message = samples::laserScan({kNan, -1.0F, 0.5F});
  EXPECT_EQ(convert(message).beams.dropped, 3U);
  EXPECT_TRUE(convert(message).scan.rays.empty());
  message.ranges = {-kInfinity, 0.0F, 3.0F};
  const auto converted = convert(message);
  EXPECT_EQ(converted.beams.dropped, 2U);
  ASSERT_EQ(converted.scan.rays.size(), 1U);
  EXPECT_EQ(converted.scan.rays[0].beam, 2U);
}

TEST(ScanConversion, ZeroIsNoMeasurementWhereTheScannerMeasuresFromZeroOn) {
  auto message = samples::laserScan({0.0F, 0.01F, 3.0F});
  message.range_min = 0.0F;
  const auto converted = convert(message);
  EXPECT_EQ(converted.beams.dropped, 1U);
  ASSERT_EQ(converted.scan.rays.size(), 2U);
  EXPECT_EQ(converted.scan.rays[0].beam, 1U);
}

TEST(ScanConversion, AnAbsurdRangeIsNoReturnHoweverFarTheDriverClaimsToSee) {
  auto message = samples::laserScan({std::numeric_limits<float>::max(), 1.0e6F, 3.0F});
  message.range_max = std::numeric_limits<float>::max();
  const auto converted = convert(message);
  EXPECT_EQ(converted.beams.no_return, 2U);
  EXPECT_EQ(converted.beams.hits, 1U);
  EXPECT_DOUBLE_EQ(converted.scan.rays[0].range, ScanConversionOptions().free_range);
}

TEST(ScanConversion, TheMinimumRangeIsAHitAndTheMaximumNoReturn) {
  const auto beams = convert(samples::laserScan({1.0F, 20.0F, 3.0F})).beams;
  EXPECT_EQ(beams.hits, 2U);
  EXPECT_EQ(beams.no_return, 1U);
}

struct BadScan {
  std::string reason;
  std::function<void(sensor_msgs::LaserScan&)> spoil;
};

class BadScans : public testing::TestWithParam<BadScan> {};

TEST_P(BadScans, AreRefused) {
  auto message = samples::laserScan();
  GetParam().spoil(message);
  EXPECT_EQ(samples::reasonOf([&] { convert(message); }), GetParam().reason);
}

using ScanMessage = sensor_msgs::LaserScan;
INSTANTIATE_TEST_SUITE_P(
    ScanConversion, BadScans,
    testing::Values(BadScan{"empty_scan", [](ScanMessage& m) { m.ranges.clear(); }},
                    BadScan{"wrong_size", [](ScanMessage& m) { m.ranges.resize(5); }},
                    BadScan{"wrong_size", [](ScanMessage& m) { m.ranges.resize(1); }},
                    BadScan{"wrong_size",
                            [](ScanMessage& m) {
                              m.ranges.resize(70000);
                              m.angle_increment = static_cast<float>(kPi / 69999.0);
                            }},
                    BadScan{"wrong_size", [](ScanMessage& m) { m.angle_increment = 1e-40F; }},
                    BadScan{"bad_geometry", [](ScanMessage& m) { m.angle_increment = 0.0F; }},
                    BadScan{"bad_geometry", [](ScanMessage& m) { m.angle_increment = kNan; }},
                    BadScan{"bad_geometry", [](ScanMessage& m) { m.angle_min = -kInfinity; }},
                    BadScan{"bad_geometry", [](ScanMessage& m) { m.angle_min = -1e30F; }},
                    BadScan{"bad_geometry", [](ScanMessage& m) { m.range_max = kNan; }},
                    BadScan{"bad_geometry", [](ScanMessage& m) { m.range_max = 0.5F; }},
                    BadScan{"bad_geometry", [](ScanMessage& m) { m.range_min = -1.0F; }},
                    BadScan{"wrong_size",
                            [](ScanMessage& m) { m.angle_increment = -m.angle_increment; }}));

TEST(ScanConversion, OneBeamMoreOrLessIsTheDriversHabit) {
  EXPECT_EQ(convert(samples::laserScan({2.0F, 3.0F})).scan.rays.size(), 2U);
  EXPECT_EQ(convert(samples::laserScan({2.0F, 3.0F, 4.0F, 5.0F})).scan.rays.size(), 4U);
}

sensor_msgs::MultiEchoLaserScan echoes(const std::vector<std::vector<float>>& beams) {
  const auto single = samples::laserScan();
  sensor_msgs::MultiEchoLaserScan message;
  message.header = single.header;
  message.angle_min = single.angle_min;
  message.angle_max = single.angle_max;
  message.angle_increment = single.angle_increment;
  message.range_min = single.range_min;
  message.range_max = single.range_max;
  for (const auto& beam : beams) {
    message.ranges.emplace_back();
    message.ranges.back().echoes = beam;
  }
  return message;
}

TEST(MultiEchoConversion, TheNearestValidEchoCounts) {
  const auto message = echoes({{9.0F, 4.0F}, {0.5F, 6.0F}, {kNan, kInfinity, 7.0F}});
  const auto converted = toScan(message, bumper(), {});
  ASSERT_EQ(converted.beams.hits, 3U);
  EXPECT_DOUBLE_EQ(converted.scan.rays[0].range, 4.0);
  EXPECT_DOUBLE_EQ(converted.scan.rays[1].range, 6.0);
  EXPECT_DOUBLE_EQ(converted.scan.rays[2].range, 7.0);
}

TEST(MultiEchoConversion, NoEchoIsNoReturnAndABadOneIsDropped) {
  const auto converted = toScan(echoes({{}, {kInfinity}, {kNan, 0.2F}}), bumper(), {});
  EXPECT_EQ(converted.beams.no_return, 2U);
  EXPECT_EQ(converted.beams.dropped, 1U);
}

std::vector<std::string> faultReasons(const ScannerMount& mount, const ConvertedScan& converted) {
  std::vector<std::string> reasons;
  for (const InputError& fault : faultsOf(mount, converted, degrees(5.0), "says nothing")) {
    reasons.push_back(fault.reason());
  }
  return reasons;
}

TEST(ScanConversion, AGoodScanHasNoFaults) {
  EXPECT_TRUE(faultReasons(bumper(), convert(samples::laserScan())).empty());
}

TEST(ScanConversion, FaultsThatDoNotCostTheScanAreNamed) {
  ScannerMount tilted = bumper();
  tilted.tilt = degrees(6.0);
  ConvertedScan nothing;
  nothing.beams.dropped = 3;
  nothing.unusable_times = InputError("bad_beam_times", "too long");
  EXPECT_EQ(faultReasons(tilted, nothing),
            (std::vector<std::string>{"bad_beam_times", "tilted_scanner", "no_valid_beam"}));
  EXPECT_STREQ(faultsOf(bumper(), nothing, degrees(5.0), "says nothing").back().what(),
               "scan with 3 beams, none of them valid: says nothing");
}

}  // namespace
}  // namespace datmo::scan_conversion_test
