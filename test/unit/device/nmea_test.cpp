// SPDX-License-Identifier: BSD-3-Clause
// NMEA 0183: sentences parsed from bytes, and their contents.
#include "datmo_fusion/device/nmea.h"

#include <cmath>

#include "device/device_reason.h"
#include "device/nmea_sentences.h"
#include <gtest/gtest.h>

#include "datmo_fusion/common/angle.h"

namespace datmo::nmea_test {
namespace {

using samples::nmeaLine;
using samples::reasonOf;

NmeaSentence sentence(const std::string& text) {
  NmeaReader reader;
  reader.feed(nmeaLine(text));
  return reader.next().value();
}

TEST(NmeaTest, BytesBecomeSentences) {
  NmeaReader reader;
  reader.feed("07.03,N*55\r\n$GPGGA,123519,4807.038,N,01131.000,E,1,08,0.9,545.4,M,46.9,M,,");
  EXPECT_FALSE(reader.next());
  reader.feed("*47\r\n");  // the textbook sentence
  const NmeaSentence gga = reader.next().value();
  EXPECT_EQ(gga.type, "GGA");
  EXPECT_EQ(gga.field(0), "123519");
  EXPECT_EQ(gga.field(12), "");
  EXPECT_EQ(gga.field(99), "");
  EXPECT_FALSE(reader.next());
}

TEST(NmeaTest, SentencesThatDoNotFitTheirChecksumAreRefusedAndTheNextOneIsNot) {
  NmeaReader reader;
  std::string broken = nmeaLine("GPGGA,123519,4807.038,N,01131.000,E,1,08,0.9,545.4,M,46.9,M,,");
  broken[20] = '9';
  reader.feed(broken + "$GPRMC,no checksum\r\n" + nmeaLine("GNVTG,0.0,T,,M,10.0,N,,K"));
  EXPECT_EQ(reasonOf([&] { reader.next(); }), "bad_sentence");
  EXPECT_EQ(reasonOf([&] { reader.next(); }), "bad_sentence");
  EXPECT_EQ(reader.next().value().type, "VTG");
}

TEST(NmeaTest, AChecksumMayBeInLowerCase) {
  NmeaReader reader;
  std::string line = nmeaLine("GPGGA,1,8");
  ASSERT_NE(line.find("*5F"), std::string::npos) << line;
  line.replace(line.find("*5F"), 3, "*5f");
  reader.feed(line);
  EXPECT_TRUE(reader.next());
}

TEST(NmeaTest, BytesOfAnotherBaudRateAreReported) {
  NmeaReader reader;
  reader.feed(std::string(300, '\xF8'));
  EXPECT_EQ(reasonOf([&] { reader.next(); }), "bad_sentence");
  EXPECT_FALSE(reader.next());
}

TEST(NmeaTest, TimesAreMillisecondsOfTheDay) {
  EXPECT_EQ(nmeaTime("000000.00"), 0U);
  EXPECT_EQ(nmeaTime("123519.25"), 45319250U);
  EXPECT_EQ(nmeaTime("235959.999"), 86399999U);
  EXPECT_FALSE(nmeaTime(""));
  for (const char* field : {"250000", "126000", "12356", "noon", "123561"}) {
    EXPECT_EQ(reasonOf([field] { nmeaTime(field); }), "bad_sentence") << field;
  }
}

TEST(NmeaTest, APositionIsReadWithItsHeightAboveTheEllipsoid) {
  const SatelliteFix fix =
      nmeaFix(sentence("GPGGA,123519,4807.038,N,01131.000,W,1,08,0.9,545.4,M,46.9,M,,"), 4.0);
  EXPECT_EQ(fix.kind, SatelliteFix::Kind::kSatellites);
  EXPECT_NEAR(fix.latitude, 48.1173, 1e-9);
  EXPECT_NEAR(fix.longitude, -11.0 - 31.0 / 60.0, 1e-9);
  EXPECT_NEAR(fix.altitude, 592.3, 1e-9);
  EXPECT_NEAR(fix.sigma, 3.6, 1e-9);
  EXPECT_EQ(fix.satellites, 8);
  for (const char* text : {"GPGGA,123519,4807.038,N,01131.000,W,1,08,0.9,545.4,M,,M,,",
                           "GPGGA,123519,4807.038,N,01131.000,W,1,08,0.9,,M,46.9,M,,"}) {
    EXPECT_TRUE(std::isnan(nmeaFix(sentence(text), 4.0).altitude)) << text;
  }
}

TEST(NmeaTest, TheQualityGivesTheAccuracyOfAPosition) {
  const auto fix = [](const std::string& quality) {
    return nmeaFix(
        sentence("GPGGA,123519,4807.038,S,01131.000,E," + quality + ",08,1.0,545.4,M,46.9,M,,"),
        4.0);
  };
  EXPECT_LT(fix("1").latitude, 0.0);
  EXPECT_EQ(fix("2").kind, SatelliteFix::Kind::kDifferential);
  EXPECT_EQ(fix("4").kind, SatelliteFix::Kind::kRealTimeKinematic);
  EXPECT_EQ(fix("5").kind, SatelliteFix::Kind::kRealTimeKinematic);
  EXPECT_LT(fix("4").sigma, fix("5").sigma);
  EXPECT_LT(fix("5").sigma, fix("2").sigma);
  EXPECT_LT(fix("2").sigma, fix("1").sigma);
  EXPECT_EQ(fix("6").kind, SatelliteFix::Kind::kNone);
}

TEST(NmeaTest, WithoutSatellitesThereIsNoPositionAndABadOneIsRefused) {
  const SatelliteFix none = nmeaFix(sentence("GPGGA,123519,,,,,0,00,,,M,,M,,"), 4.0);
  EXPECT_EQ(none.kind, SatelliteFix::Kind::kNone);
  EXPECT_TRUE(std::isnan(none.latitude));
  for (const char* text : {"GPGGA,123519,,,,,1,08,0.9,545.4,M,46.9,M,,",
                           "GPGGA,123519,9907.038,N,01131.000,E,1,08,0.9,545.4,M,46.9,M,,",
                           "GPGGA,123519,48x7.038,N,01131.000,E,1,08,0.9,545.4,M,46.9,M,,",
                           "GPGGA,123519,nan,N,01131.000,E,1,08,0.9,545.4,M,46.9,M,,"}) {
    EXPECT_EQ(reasonOf([text] { nmeaFix(sentence(text), 4.0); }), "bad_sentence") << text;
  }
}

TEST(NmeaTest, VelocitiesAreOfBothKindsOfSentences) {
  const auto rmc =
      nmeaVelocity(sentence("GPRMC,123519,A,4807.038,N,01131.000,E,022.4,084.4,230394,003.1,W"));
  ASSERT_TRUE(rmc);
  EXPECT_NEAR(rmc->speed, 22.4 * 0.514444, 1e-4);
  EXPECT_NEAR(rmc->course, degrees(84.4), 1e-9);
  const auto vtg = nmeaVelocity(sentence("GPVTG,054.7,T,034.4,M,005.5,N,010.2,K"));
  ASSERT_TRUE(vtg);
  EXPECT_NEAR(vtg->speed, 5.5 * 0.514444, 1e-4);
  EXPECT_FALSE(nmeaVelocity(sentence("GPRMC,123519,V,,,,,,,230394,,")));
  EXPECT_FALSE(nmeaVelocity(sentence("GPVTG,,T,,M,,N,,K")));
  EXPECT_FALSE(nmeaVelocity(sentence("GPVTG,,T,,M,0.00,N,0.00,K,N"))) << "its mode: not valid";
  EXPECT_EQ(reasonOf([] { nmeaVelocity(sentence("GPVTG,0,T,,M,-1,N,,K")); }), "bad_sentence");
}

}  // namespace
}  // namespace datmo::nmea_test
