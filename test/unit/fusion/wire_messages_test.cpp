// SPDX-License-Identifier: BSD-3-Clause
// CAM and CPM between fields and bits; the bits are derived by hand (wire_messages.h).
#include "fusion/wire_messages.h"

#include <string>

#include <gtest/gtest.h>

#include "datmo_fusion/fusion/wire/cam.h"
#include "datmo_fusion/fusion/wire/cpm.h"
#include "datmo_fusion/fusion/wire/wire_error.h"

namespace datmo {
namespace {

using samples::refusalOf;
using samples::WireBits;

void expectPosition(const ItsPosition& position) {
  EXPECT_EQ(position.latitude, 451900000);
  EXPECT_EQ(position.longitude, 57200000);
  EXPECT_EQ(position.semi_major, 150);
  EXPECT_EQ(position.semi_minor, 100);
  EXPECT_EQ(position.major_direction, 300);
  EXPECT_EQ(position.altitude, 21250);
  EXPECT_EQ(position.altitude_confidence, 5);
}

TEST(CamBits, AreDecoded) {
  ASSERT_EQ(samples::wireCam().size(), 322U);
  const Cam cam = decodeCam(samples::wireCam().bytes());
  EXPECT_EQ(cam.header.station, 0xCAFE1234);
  EXPECT_EQ(cam.generation_time, 34567);
  EXPECT_EQ(cam.station_type, kItsPassengerCar);
  expectPosition(cam.position);
  EXPECT_TRUE(cam.is_vehicle);
  EXPECT_EQ(cam.heading.value, 900);
  EXPECT_EQ(cam.heading.confidence, 10);
  EXPECT_EQ(cam.speed.value, 2000);
  EXPECT_EQ(cam.speed.confidence, 50);
  EXPECT_EQ(cam.direction, 0);
  EXPECT_EQ(cam.length, 43);
  EXPECT_EQ(cam.width, 18);
}

TEST(CamBits, AreEncoded) {
  const std::string bytes = samples::wireCam().bytes();
  EXPECT_EQ(encode(decodeCam(bytes)), bytes);
}

TEST(CamBits, OfTheLowFrequencyContainerFollow) {
  Cam cam = decodeCam(samples::wireCam().bytes());
  cam.has_low_frequency = true;
  // The presence is bit 65 (version, kind, station, time: 64 bits, then the marker). At the end:
  // the only container of its choice, no role, lights off, a path of no points.
  WireBits end;
  end.add(0, 1).add(0, 4).add(0, 8).add(0, 6);
  const std::string written = encode(cam);
  ASSERT_EQ(written.size(), (322U + end.size() + 7U) / 8U);
  EXPECT_EQ(static_cast<unsigned char>(written[8]) >> 5U, 0b010U);
  EXPECT_EQ(decodeCam(written).width, 18);
}

TEST(CamBits, OfUnusedFieldsAreSkipped) {
  // The basic container has an addition; the vehicle's has all optional fields, whose bits follow
  // what is read.
  const std::string bytes = samples::wireCamHead(0b11, 5).bytes();
  std::string extended = bytes;
  extended[8] = static_cast<char>(static_cast<unsigned char>(extended[8]) | 0x10U);  // bit 67
  WireBits all;
  for (std::size_t i = 0; i < samples::wireCamHead(0b11, 5).size(); ++i) {
    all.add((static_cast<unsigned char>(extended[i / 8]) >> (7 - i % 8)) & 1U, 1);
  }
  all.add(0, 7).add(1, 1).addOpen(WireBits().add(0x5A, 8));  // one addition
  all.add(0, 1).add(0, 1).add(0x7F, 7).add(1800, 12).add(1 - 1, 7).add(100, 14).add(1 - 1, 7);
  all.add(1, 2).add(50 - 1, 10).add(0, 3).add(20 - 1, 6).add(160, 9).add(0, 7);
  all.add(1023, 11).add(0, 3).add(1, 1).add(0, 1).add(4, 6);  // a mode that is not known
  all.add(32766, 16).add(0, 4);
  const Cam cam = decodeCam(all.bytes());
  EXPECT_EQ(cam.heading.value, 1800);
  EXPECT_EQ(cam.direction, Cam::kBackward);
  EXPECT_EQ(cam.length, 50);
  EXPECT_EQ(cam.width, 20);
}

TEST(CamBits, OfARoadsideUnitEndAfterItsPosition) {
  EXPECT_FALSE(decodeCam(samples::wireCamHead(0, 15).add(0b0100, 4).bytes()).is_vehicle);
  // A container that is not known.
  WireBits added = samples::wireCamHead(0, 15);
  added.add(1, 1).add(0, 7).addOpen(WireBits().add(1, 8));
  EXPECT_FALSE(decodeCam(added.bytes()).is_vehicle);
}

TEST(CpmBits, AreDecoded) {
  const Cpm cpm = decodeCpm(samples::wireCpm().bytes(), ItsDictionary::k221);
  EXPECT_EQ(cpm.header.station, 77);
  EXPECT_EQ(cpm.reference_time, 699451205000);
  expectPosition(cpm.position);
  EXPECT_EQ(cpm.segments, 1);
  EXPECT_FALSE(cpm.orientation);
  ASSERT_EQ(cpm.objects.size(), 1U);
  const CpmObject& object = cpm.objects.front();
  EXPECT_EQ(object.id, 41);
  EXPECT_EQ(object.delay, -100);
  EXPECT_EQ(object.x.value, 1234);
  EXPECT_EQ(object.x.confidence, 20);
  EXPECT_EQ(object.y.value, -567);
  EXPECT_EQ(object.y.confidence, 30);
  ASSERT_TRUE(object.velocity);
  EXPECT_EQ(object.velocity->x.value, -120);
  EXPECT_EQ(object.velocity->x.confidence, 30);
  EXPECT_EQ(object.velocity->y.value, 0);
  EXPECT_EQ(object.velocity->y.confidence, 40);
  ASSERT_TRUE(object.heading);
  EXPECT_EQ(object.heading->value, 1800);
  EXPECT_EQ(object.heading->confidence, ItsAngle::kOutOfRange);
  EXPECT_EQ(object.width, 6);
  EXPECT_EQ(object.length, 5);
  EXPECT_FALSE(object.height);
  EXPECT_EQ(object.quality, 12);
  ASSERT_EQ(object.classes.size(), 1U);
  EXPECT_EQ(object.classes[0].kind, CpmClass::kVulnerable);
  EXPECT_EQ(object.classes[0].profile, CpmClass::kPedestrian);
  EXPECT_EQ(object.classes[0].confidence, 80);
}

TEST(CpmBits, AreEncoded) {
  // Except for the subclass of a pedestrian, which we do not report: 0 for 1, 8 bits before the
  // end.
  const std::string read = samples::wireCpm().bytes();
  const Cpm cpm = decodeCpm(read, ItsDictionary::k221);
  const std::string written = encode(cpm, ItsDictionary::k221);
  ASSERT_EQ(written.size(), read.size());
  int differ = 0;
  for (std::size_t i = 0; i < read.size(); ++i) {
    const auto bits = static_cast<unsigned int>(static_cast<unsigned char>(read[i]) ^
                                                static_cast<unsigned char>(written[i]));
    differ += __builtin_popcount(bits);
  }
  EXPECT_EQ(differ, 1);
}

class CpmOfDictionary : public testing::TestWithParam<ItsDictionary> {};

TEST_P(CpmOfDictionary, UnusedFieldsAreSkipped) {
  const Cpm cpm =
      decodeCpm(samples::wireRichCpm(GetParam() == ItsDictionary::k211).bytes(), GetParam());
  EXPECT_EQ(cpm.segments, 3);
  EXPECT_EQ(cpm.segment, 2);
  ASSERT_TRUE(cpm.orientation);
  EXPECT_EQ(cpm.orientation->value, 2700);
  ASSERT_EQ(cpm.objects.size(), 2U);
  const CpmObject& first = cpm.objects[0];
  ASSERT_TRUE(first.velocity);
  EXPECT_TRUE(first.velocity->is_polar);
  EXPECT_EQ(first.velocity->speed.value, 500);
  EXPECT_EQ(first.velocity->course.value, 900);
  EXPECT_EQ(first.heading->value, 450);
  EXPECT_EQ(first.height, 15);
  EXPECT_EQ(first.width, 18);
  EXPECT_EQ(first.length, 43);
  EXPECT_EQ(first.quality, 15);
  ASSERT_EQ(first.classes.size(), 6U);
  EXPECT_EQ(first.classes[0].kind, CpmClass::kVehicle);
  EXPECT_EQ(first.classes[2].profile, CpmClass::kMotorcyclist);
  EXPECT_EQ(first.classes[5].kind, CpmClass::kAdded);
  EXPECT_EQ(cpm.objects[1].id, 8);
  EXPECT_EQ(cpm.objects[1].x.value, -1);
  EXPECT_FALSE(cpm.objects[1].velocity);
}

INSTANTIATE_TEST_SUITE_P(Wire, CpmOfDictionary,
                         testing::Values(ItsDictionary::k211, ItsDictionary::k221));

TEST(WireMessages, OthersAreRefusedByKind) {
  WireBits denm;
  denm.add(2, 8).add(1, 8).add(77, 32);
  EXPECT_EQ(refusalOf([&] { decodeCam(denm.bytes()); }), "other_message");
  std::string old = samples::wireCam().bytes();
  old[0] = 1;
  EXPECT_EQ(refusalOf([&] { decodeCam(old); }), "other_version");
  // 9,000,002 e-7 deg north of 90 deg is no latitude.
  WireBits bad;
  bad.add(2, 8).add(2, 8).add(77, 32).add(0, 16).add(0, 4).add(5, 8).add(1800000002, 31).add(0, 32);
  EXPECT_EQ(refusalOf([&] { decodeCam(bad.bytes()); }), "bad_message");
}

}  // namespace
}  // namespace datmo
