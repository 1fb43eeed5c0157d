// SPDX-License-Identifier: BSD-3-Clause
// The protocol of SICK's scanners: telegrams out of bytes, and what a scan says.
#include "datmo_fusion/device/cola.h"

#include <cmath>

#include "device/device_reason.h"
#include "device/fake_sick.h"
#include <gtest/gtest.h>

#include "datmo_fusion/common/angle.h"

namespace datmo::cola_test {
namespace {

using samples::reasonOf;
using samples::SickTelegram;

const SickModel kModel{"LMS111", 20.0};

TEST(ColaTest, BytesBecomeTelegrams) {
  ColaReader reader;
  reader.feed("half of an old one\x02sAN Ru");
  EXPECT_FALSE(reader.next().has_value());
  reader.feed("n 1\x03\x02sEA\x03\x02");
  EXPECT_EQ(reader.next(), "sAN Run 1");
  EXPECT_EQ(reader.next(), "sEA");
  EXPECT_FALSE(reader.next().has_value());
}

TEST(ColaTest, ATelegramThatWasCutOffDoesNotCostTheNext) {
  ColaReader reader;
  reader.feed("\x02sSN LMDscandata 1 1 A0\x02sAN Run 1\x03");
  EXPECT_EQ(reader.next(), "sAN Run 1");
}

TEST(ColaTest, OtherProtocolsAreRefused) {
  ColaReader binary;
  binary.feed(std::string("\x02\x02\x02\x02\x00\x00\x00\x05", 8));
  EXPECT_EQ(reasonOf([&] { binary.next(); }), "wrong_device");
  ColaReader endless;
  endless.feed(std::string(200000, 'x'));
  EXPECT_EQ(reasonOf([&] { endless.next(); }), "bad_answer");
  ColaReader web;
  web.feed("HTTP/1.1 400\x03");
  EXPECT_EQ(reasonOf([&] { web.next(); }), "bad_answer");
}

TEST(ColaTest, NumbersAreHexadecimalOrHaveASign) {
  ColaWords words("FF +10 -10 FFF92230 3F000000 100000000 1x");
  EXPECT_EQ(words.number("it"), 255U);
  EXPECT_EQ(words.number("it"), 10U);
  EXPECT_EQ(words.signedNumber("it"), -10);
  EXPECT_EQ(words.signedNumber("it"), -450000);
  EXPECT_FLOAT_EQ(words.real("it"), 0.5F);
  EXPECT_EQ(reasonOf([&] { words.number("it"); }), "bad_answer");
  EXPECT_EQ(reasonOf([&] { words.number("it"); }), "bad_answer");
  EXPECT_EQ(reasonOf([&] { words.number("it"); }), "bad_answer");  // there is none
}

TEST(ColaTest, AScanIsReadAsTheListingHasIt) {
  const SickScan scan = sickScan(SickTelegram().text(), kModel);
  EXPECT_EQ(scan.state, SickState::kGood);
  EXPECT_EQ(scan.counter, 1U);
  EXPECT_EQ(scan.begun, 1000000U);
  EXPECT_EQ(scan.sent, 1020000U);
  EXPECT_NEAR(scan.scan.first_bearing, degrees(-135.0), 1e-9);
  EXPECT_NEAR(scan.scan.beam_spacing, degrees(0.5), 1e-9);
  EXPECT_NEAR(scan.scan.scan_time, 0.04, 1e-9);
  EXPECT_NEAR(scan.scan.beam_time, 0.04 / 720.0, 1e-9);
  EXPECT_DOUBLE_EQ(scan.scan.max_range, 20.0);
  ASSERT_EQ(scan.scan.ranges.size(), 4U);
  EXPECT_FLOAT_EQ(scan.scan.ranges[0], 1.0F);
  EXPECT_TRUE(std::isinf(scan.scan.ranges[1]));  // no echo
  EXPECT_TRUE(std::isnan(scan.scan.ranges[2]));  // a code
  EXPECT_FLOAT_EQ(scan.scan.ranges[3], 4.0F);
  EXPECT_EQ(scan.scan.intensities, (std::vector<float>{10.0F, 0.0F, 0.0F, 254.0F}));
}

TEST(ColaTest, TheFactorCountsAndRemissionMayBeMissing) {
  SickTelegram telegram;
  telegram.factor = "40000000";  // an LMS5xx beyond 65 m
  telegram.intensities.clear();
  const SickScan scan = sickScan(telegram.text(), kModel);
  EXPECT_FLOAT_EQ(scan.scan.ranges[3], 8.0F);
  EXPECT_TRUE(scan.scan.intensities.empty());
}

TEST(ColaTest, WhatTheScannerSaysOfItselfIsRead) {
  SickTelegram telegram;
  telegram.state = "0 2";
  EXPECT_EQ(sickScan(telegram.text(), kModel).state, SickState::kDirty);
  telegram.state = "0 5";
  EXPECT_EQ(sickScan(telegram.text(), kModel).state, SickState::kFault);
}

TEST(ColaTest, AScanCutAnywhereBeforeItsLastBeamIsRefused) {
  const std::string whole = SickTelegram().text();
  const std::size_t tail = std::string(" 0 0 0 0 0").size();
  for (std::size_t length = 0; length + tail < whole.size(); ++length) {
    EXPECT_EQ(reasonOf([&] { sickScan(whole.substr(0, length), kModel); }), "bad_answer")
        << whole.substr(0, length);
  }
}

TEST(ColaTest, ScansThatCannotBeAreRefused) {
  SickTelegram telegram;
  telegram.ranges = {1000};
  EXPECT_EQ(reasonOf([&] { sickScan(telegram.text(), kModel); }), "bad_answer");
  telegram.ranges.assign(1000, 1000);  // 500 degrees
  EXPECT_EQ(reasonOf([&] { sickScan(telegram.text(), kModel); }), "bad_answer");
  telegram = SickTelegram();
  telegram.begun = telegram.sent + 1;
  EXPECT_EQ(reasonOf([&] { sickScan(telegram.text(), kModel); }), "bad_answer");
  telegram = SickTelegram();
  telegram.factor = "7F800000";  // infinity
  EXPECT_EQ(reasonOf([&] { sickScan(telegram.text(), kModel); }), "bad_answer");
}

TEST(ColaTest, ModelsAreKnownByName) {
  EXPECT_DOUBLE_EQ(sickModel("sRA DeviceIdent 10 LMS10x_FieldEval 10 V1.36-21.10.2010").max_range,
                   20.0);
  EXPECT_EQ(sickModel("sRA DeviceIdent E TiM571-2050101 4 V2.5").name, "TiM571-2050101");
  EXPECT_DOUBLE_EQ(sickModel("sRA DeviceIdent 6 LMS5xx 4 V1.1").max_range, 80.0);
  for (const char* answer : {"sRA DeviceIdent 8 LMS1104C 4 V1.1", "sRA DeviceIdent 6 TiM240 4 V1.1",
                             "sRA DeviceIdent 6 NAV310 4 V1.1"}) {
    EXPECT_EQ(reasonOf([answer] { sickModel(answer); }), "wrong_device") << answer;
  }
  EXPECT_EQ(reasonOf([] { sickModel("sRA DeviceIdent FF LMS111"); }), "bad_answer");
}

}  // namespace
}  // namespace datmo::cola_test
