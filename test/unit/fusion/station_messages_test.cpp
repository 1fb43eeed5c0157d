// SPDX-License-Identifier: BSD-3-Clause
// CAM and CPM converted to tracks of a station, and back.
#include "datmo_fusion/fusion/wire/station_messages.h"

#include <cmath>

#include "fusion/wire_messages.h"
#include <Eigen/Cholesky>
#include <gtest/gtest.h>

#include "datmo_fusion/common/angle.h"
#include "datmo_fusion/fusion/wire/cam.h"
#include "datmo_fusion/fusion/wire/wire_error.h"

namespace datmo {
namespace {

const StationMessageOptions kOptions;

std::string reasonOf(const std::string& bytes) {
  try {
    decodeStation(bytes, samples::kWireNoon, kOptions);
  } catch (const WireError& error) {
    return error.reason();
  }
  return "";
}

Cam camOfWire() { return decodeCam(samples::wireCam().bytes()); }

StationTrack trackOf(const Cam& cam) {
  return decodeStation(encode(cam), samples::kWireNoon, kOptions).list.tracks.at(0);
}

bool isCovariance(const Eigen::Matrix4d& covariance) {
  return Eigen::LLT<Eigen::Matrix4d>(covariance).info() == Eigen::Success;
}

TEST(StationOfCam, IsATrackOfItself) {
  const StationMessage message =
      decodeStation(samples::wireCam().bytes(), samples::kWireNoon, kOptions);
  EXPECT_EQ(message.list.station, 0xCAFE1234);
  EXPECT_EQ(message.list.part, 0U);
  EXPECT_NEAR(toDegrees(message.plane.datum().latitude), 45.19, 1e-9);
  EXPECT_NEAR(toDegrees(message.plane.datum().longitude), 5.72, 1e-9);
  EXPECT_DOUBLE_EQ(message.plane.datum().altitude, 212.5);
  ASSERT_EQ(message.list.tracks.size(), 1U);
  const StationTrack& track = message.list.tracks[0];
  EXPECT_EQ(track.id, 0U);
  // The position is that of the front's middle, and the car faces east.
  EXPECT_NEAR(track.position.x(), -2.15, 1e-9);
  EXPECT_NEAR(track.position.y(), 0.0, 1e-9);
  EXPECT_NEAR(track.velocity.x(), 20.0, 1e-9);
  EXPECT_NEAR(track.velocity.y(), 0.0, 1e-9);
  EXPECT_NEAR(track.heading, 0.0, 1e-9);
  EXPECT_NEAR(track.heading_variance, std::pow(degrees(1.0) / 1.96, 2), 1e-9);
  EXPECT_NEAR(track.length, 4.3, 1e-9);
  EXPECT_NEAR(track.width, 1.8, 1e-9);
  EXPECT_TRUE(track.moving);
  EXPECT_GT(track.class_probabilities[static_cast<std::size_t>(ObjectClass::kVehicle)], 0.9);
  EXPECT_TRUE(isCovariance(track.covariance));
  // 0.5 m/s and 1 deg hold 95 %: 1.96 sigma.
  EXPECT_NEAR(std::sqrt(track.covariance(2, 2)), 0.5 / 1.96, 1e-9);
  EXPECT_NEAR(std::sqrt(track.covariance(3, 3)), 0.5 / 1.96, 1e-9);  // no more certain than along
}

TEST(StationOfCam, LateralUncertaintyGrowsWithSpeed) {
  Cam cam = camOfWire();
  cam.speed.value = 4000;
  EXPECT_NEAR(std::sqrt(trackOf(cam).covariance(3, 3)), 40.0 * degrees(1.0) / 1.96, 1e-9);
}

TEST(StationOfCam, HasTheEllipseOf95Percent) {
  // 1.5 m and 1.0 m hold 95 %: 2.4477 sigma; the major axis is 30 deg from north to the east.
  const Eigen::Matrix2d covariance = trackOf(camOfWire()).covariance.topLeftCorner<2, 2>();
  const Eigen::Vector2d major(0.5, std::sqrt(0.75));
  const double by_heading = std::pow(2.15 * degrees(1.0) / 1.96, 2);  // of the center, to the north
  EXPECT_NEAR(major.dot(covariance * major), std::pow(1.5 / 2.4477, 2) + 0.75 * by_heading, 1e-6);
  const Eigen::Vector2d minor(major.y(), -major.x());
  EXPECT_NEAR(minor.dot(covariance * minor), std::pow(1.0 / 2.4477, 2) + 0.25 * by_heading, 1e-6);
}

TEST(StationOfCam, HasTheTimeNearestToNow) {
  // Noon is 699,451,205,000 ms on the wire, 25,992 modulo 65,536.
  const auto ageOf = [](std::int64_t generation_time) {
    Cam cam = camOfWire();
    cam.generation_time = generation_time;
    return secondsBetween(decodeStation(encode(cam), samples::kWireNoon, kOptions).list.stamp,
                          samples::kWireNoon);
  };
  EXPECT_DOUBLE_EQ(ageOf(25992), 0.0);
  EXPECT_DOUBLE_EQ(ageOf(17351), 8.641);
  EXPECT_DOUBLE_EQ(ageOf(26092), -0.1);  // its clock is ahead
  EXPECT_DOUBLE_EQ(ageOf(59528), 32.0);
  EXPECT_DOUBLE_EQ(ageOf(57992), -32.0);
}

TEST(StationOfCam, DrivesBackwardAgainstItsHeading) {
  Cam cam = camOfWire();
  cam.direction = Cam::kBackward;
  EXPECT_NEAR(trackOf(cam).velocity.x(), -20.0, 1e-9);
  EXPECT_NEAR(trackOf(cam).heading, 0.0, 1e-9);
}

TEST(StationOfCam, OfUnknownConfidenceHasTheOptions) {
  Cam cam = camOfWire();
  cam.position.semi_major = cam.position.semi_minor = ItsPosition::kNoAxis;
  cam.position.major_direction = ItsAngle::kNoValue;
  cam.speed.confidence = ItsSpeed::kNoConfidence;
  cam.heading.confidence = ItsAngle::kNoConfidence;
  const StationTrack track = trackOf(cam);
  EXPECT_NEAR(std::sqrt(track.covariance(0, 0)), kOptions.position_sigma, 1e-9);
  EXPECT_NEAR(std::sqrt(track.covariance(2, 2)), kOptions.speed_sigma, 1e-9);
  EXPECT_NEAR(std::sqrt(track.heading_variance), kOptions.heading_sigma, 1e-9);
  EXPECT_TRUE(isCovariance(track.covariance));
}

TEST(StationOfCam, WithoutSpeedOrHeadingMayGoAnywhere) {
  Cam cam = camOfWire();
  cam.speed = ItsSpeed();
  StationTrack track = trackOf(cam);
  EXPECT_EQ(track.velocity, Point2(0.0, 0.0));
  EXPECT_NEAR(std::sqrt(track.covariance(2, 2)), kOptions.unknown_speed_sigma, 1e-9);
  EXPECT_TRUE(track.moving);

  cam = camOfWire();
  cam.heading = ItsAngle();
  track = trackOf(cam);
  EXPECT_EQ(track.velocity, Point2(0.0, 0.0));
  EXPECT_NEAR(track.covariance(2, 2), 0.5 * 400.0 + std::pow(0.5 / 1.96, 2), 1e-9);
  EXPECT_DOUBLE_EQ(track.heading_variance, kUnknownHeadingVariance);
  EXPECT_TRUE(isCovariance(track.covariance));

  cam = camOfWire();
  cam.speed.confidence = ItsSpeed::kOutOfRange;  // not reliable
  EXPECT_EQ(trackOf(cam).velocity, Point2(0.0, 0.0));
}

TEST(StationOfCam, WithoutSizeHasTheUsualOne) {
  Cam cam = camOfWire();
  cam.length = Cam::kNoLength;
  cam.width = Cam::kNoWidth;
  EXPECT_DOUBLE_EQ(trackOf(cam).length, 4.5);
  EXPECT_DOUBLE_EQ(trackOf(cam).width, 1.8);
  cam.station_type = kItsPedestrian;  // whose position is its own
  EXPECT_DOUBLE_EQ(trackOf(cam).length, 0.5);
  EXPECT_EQ(trackOf(cam).position, Point2(0.0, 0.0));
}

TEST(StationOfCam, WithoutPositionIsRefused) {
  Cam cam = camOfWire();
  cam.position.latitude = ItsPosition::kNoLatitude;
  EXPECT_EQ(reasonOf(encode(cam)), "no_position");
  cam = camOfWire();
  cam.position.longitude = ItsPosition::kNoLongitude;
  EXPECT_EQ(reasonOf(encode(cam)), "no_position");
  cam = camOfWire();
  cam.position.semi_major = ItsPosition::kAxisOutOfRange;
  EXPECT_EQ(reasonOf(encode(cam)), "no_position");
  EXPECT_EQ(reasonOf(samples::wireCamHead(0, 15).add(0b0100, 4).bytes()), "no_track");
}

TEST(StationOfCpm, HasItsPerceivedObjects) {
  const StationMessage message =
      decodeStation(samples::wireCpm().bytes(), samples::kWireNoon, kOptions);
  EXPECT_EQ(message.list.stamp, samples::kWireNoon);
  EXPECT_EQ(message.list.station, 77U);
  EXPECT_EQ(message.list.part, 1U);
  EXPECT_EQ(message.left_out, 0U);
  ASSERT_EQ(message.list.tracks.size(), 1U);
  const StationTrack& track = message.list.tracks[0];
  EXPECT_EQ(track.id, 42U);
  // 12.34 m east and 5.67 m south, 100 ms ago: it has moved since then.
  EXPECT_NEAR(track.position.x(), 12.34 - 0.12, 1e-9);
  EXPECT_NEAR(track.position.y(), -5.67, 1e-9);
  EXPECT_NEAR(track.velocity.x(), -1.2, 1e-9);
  EXPECT_NEAR(track.covariance(2, 2), std::pow(0.3 / 1.96, 2), 1e-9);
  // The station's own position, the object's relative to it, and the velocity's part.
  const double position = 0.25 * std::pow(1.5 / 2.4477, 2) + 0.75 * std::pow(1.0 / 2.4477, 2);
  EXPECT_NEAR(track.covariance(0, 0),
              position + std::pow(0.2 / 1.96, 2) + 0.01 * std::pow(0.3 / 1.96, 2), 1e-6);
  EXPECT_TRUE(isCovariance(track.covariance));
  // Its heading is out of range: that of the motion.
  EXPECT_NEAR(std::abs(track.heading), kPi, 1e-9);
  EXPECT_NEAR(track.length, 0.5, 1e-9);
  EXPECT_NEAR(track.width, 0.6, 1e-9);
  EXPECT_NEAR(track.existence_probability, 0.8, 1e-9);
  EXPECT_NEAR(track.class_probabilities[static_cast<std::size_t>(ObjectClass::kPedestrian)], 0.84,
              1e-9);
}

TEST(StationOfCpm, LeavesOutObjectsWithoutIdOrPosition) {
  Cpm cpm = decodeCpm(samples::wireCpm().bytes(), ItsDictionary::k221);
  cpm.objects.resize(4, cpm.objects[0]);
  cpm.objects[1].id.reset();
  cpm.objects[2].x.value = CpmCoordinate::kMax;
  cpm.objects[3].y.confidence = CpmCoordinate::kOutOfRange;
  const StationMessage message =
      decodeStation(encode(cpm, ItsDictionary::k221), samples::kWireNoon, kOptions);
  EXPECT_EQ(message.list.tracks.size(), 1U);
  EXPECT_EQ(message.left_out, 3U);
}

TEST(StationOfCpm, OfUnknownConfidenceHasTheOptions) {
  Cpm cpm = decodeCpm(samples::wireCpm().bytes(), ItsDictionary::k221);
  CpmObject& object = cpm.objects[0];
  object.delay = 0;
  object.x.confidence = object.y.confidence = CpmCoordinate::kNoConfidence;
  object.velocity.reset();
  object.heading.reset();
  object.quality.reset();
  object.classes.clear();
  const StationTrack track =
      decodeStation(encode(cpm, ItsDictionary::k221), samples::kWireNoon, kOptions)
          .list.tracks.at(0);
  const double position = (std::pow(1.5, 2) + std::pow(1.0, 2)) / std::pow(2.4477, 2);
  EXPECT_NEAR((track.covariance.topLeftCorner<2, 2>().trace()),
              position + 2.0 * std::pow(kOptions.object_position_sigma, 2), 1e-6);
  EXPECT_NEAR(std::sqrt(track.covariance(3, 3)), kOptions.unknown_speed_sigma, 1e-9);
  EXPECT_DOUBLE_EQ(track.heading_variance, kUnknownHeadingVariance);
  EXPECT_DOUBLE_EQ(track.existence_probability, kOptions.existence);
  for (const double probability : track.class_probabilities) {
    EXPECT_DOUBLE_EQ(probability, 0.2);
  }
}

TEST(StationTimes, CountLeapSeconds) {
  // TS 102 894-2, TimestampIts: 2007-01-01 00:00:00 UTC is 94,694,401,000, with one leap second.
  Cpm cpm = decodeCpm(samples::wireCpm().bytes(), ItsDictionary::k221);
  cpm.reference_time = 94694401000;
  StationMessageOptions options;
  options.leap_seconds = 1;
  const StationMessage message =
      decodeStation(encode(cpm, ItsDictionary::k221), samples::kWireNoon, options);
  EXPECT_EQ(message.list.stamp, Stamp::fromSeconds(1167609600.0));
}

}  // namespace
}  // namespace datmo
