// SPDX-License-Identifier: BSD-3-Clause
// Contents of the telegrams of SICK scanners, in both dialects.
#include "datmo_fusion/device/sick_telegram.h"

#include <cmath>
#include <random>

#include "device/device_reason.h"
#include "device/fake_sick.h"
#include <gtest/gtest.h>

#include "datmo_fusion/common/angle.h"

namespace datmo::sick_telegram_test {
namespace {

using samples::bytesOf;
using samples::reasonOf;
using samples::SickTelegram;

const SickModel kModel{"LMS111", 20.0};

class SickTelegramTest : public testing::TestWithParam<ColaDialect> {
 protected:
  static SickScan read(const SickTelegram& telegram) {
    return sickScan(telegram.in(GetParam()), kModel);
  }

  static std::string refusalOf(const SickTelegram& telegram) {
    return reasonOf([&] { read(telegram); });
  }
};

INSTANTIATE_TEST_SUITE_P(Dialects, SickTelegramTest,
                         testing::Values(ColaDialect::kBinary, ColaDialect::kText));

TEST(SickTelegramTest, TheFakesTelegramIsTheListings) {
  SickTelegram telegram;
  telegram.ranges = {1000};
  telegram.intensities.clear();
  EXPECT_EQ(telegram.in(ColaDialect::kText).bytes,
            "sSN LMDscandata 1 1 A037B9 0 0 8 1 F4240 F9060 0 0 7 0 0 9C4 168 0 1 "
            "DIST1 3F800000 0 FFF92230 1388 1 3E8 0 0 0 0 0 0");
  EXPECT_EQ(telegram.in(ColaDialect::kBinary).bytes,
            bytesOf("sSN LMDscandata \0\x01\0\x01\0\xA0\x37\xB9\0\0\0\x08\0\x01"
                    "\0\x0F\x42\x40\0\x0F\x90\x60\0\0\x07\0\0\0\0\0\x09\xC4\0\0\x01\x68\0\0\0\x01"
                    "DIST1\x3F\x80\0\0\0\0\0\0\xFF\xF9\x22\x30\x13\x88\0\x01\x03\xE8"
                    "\0\0\0\0\0\0\0\0\0\0\0\0"));
}

TEST_P(SickTelegramTest, AScanIsReadAsTheListingHasIt) {
  const SickScan scan = read(SickTelegram());
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

TEST_P(SickTelegramTest, TheFactorCountsAndRemissionMayBeMissing) {
  SickTelegram telegram;
  telegram.factor = 0x40000000;  // an LMS5xx beyond 65 m
  telegram.intensities.clear();
  const SickScan scan = read(telegram);
  EXPECT_FLOAT_EQ(scan.scan.ranges[3], 8.0F);
  EXPECT_TRUE(scan.scan.intensities.empty());
}

TEST_P(SickTelegramTest, TheScannersStatusIsRead) {
  SickTelegram telegram;
  telegram.state = 2;
  EXPECT_EQ(read(telegram).state, SickState::kDirty);
  telegram.state = 5;
  EXPECT_EQ(read(telegram).state, SickState::kFault);
}

TEST_P(SickTelegramTest, AScanTruncatedBeforeItsLastBeamIsRefused) {
  const ColaTelegram whole = SickTelegram().in(GetParam());
  constexpr std::size_t kTail = 10;  // five zeros, of two bytes each in either dialect
  for (std::size_t length = 0; length + kTail < whole.bytes.size(); ++length) {
    const ColaTelegram part{whole.dialect, whole.bytes.substr(0, length)};
    EXPECT_EQ(reasonOf([&] { sickScan(part, kModel); }), "bad_answer") << part.bytes;
  }
}

TEST_P(SickTelegramTest, WhateverBytesAreDamagedAScanIsReadOrRefused) {
  std::mt19937 random(1);
  const std::string whole = SickTelegram().in(GetParam()).bytes;
  int refused = 0;
  for (int i = 0; i < 5000; ++i) {
    ColaTelegram damaged{GetParam(), whole};
    for (int j = 0; j < 3; ++j) {
      damaged.bytes[random() % whole.size()] = static_cast<char>(random());
    }
    const std::string reason =
        reasonOf([&] { EXPECT_LE(sickScan(damaged, kModel).scan.ranges.size(), whole.size()); });
    EXPECT_TRUE(reason == "none" || reason == "bad_answer") << reason;
    refused += reason == "none" ? 0 : 1;
  }
  EXPECT_GT(refused, 500);
}

TEST_P(SickTelegramTest, ImpossibleScansAreRefused) {
  SickTelegram telegram;
  telegram.ranges = {1000};
  EXPECT_EQ(refusalOf(telegram), "bad_answer");
  telegram.ranges.assign(1000, 1000);  // 500 degrees
  EXPECT_EQ(refusalOf(telegram), "bad_answer");
  telegram = SickTelegram();
  telegram.begun = telegram.sent + 1;
  EXPECT_EQ(refusalOf(telegram), "bad_answer");
  telegram = SickTelegram();
  telegram.factor = 0x7F800000;  // infinity
  EXPECT_EQ(refusalOf(telegram), "bad_answer");
}

TEST(SickTelegramTest, ModelsAreKnownByName) {
  const auto modelOf = [](const std::string& text) {
    return sickModel({ColaDialect::kText, text});
  };
  EXPECT_DOUBLE_EQ(modelOf("sRA DeviceIdent 10 LMS10x_FieldEval 10 V1.36-21.10.2010").max_range,
                   20.0);
  EXPECT_EQ(modelOf("sRA DeviceIdent E TiM571-2050101 4 V2.5").name, "TiM571-2050101");
  EXPECT_DOUBLE_EQ(modelOf("sRA DeviceIdent 6 LMS5xx 4 V1.1").max_range, 80.0);
  for (const char* answer : {"sRA DeviceIdent 8 LMS1104C 4 V1.1", "sRA DeviceIdent 6 TiM240 4 V1.1",
                             "sRA DeviceIdent 6 NAV310 4 V1.1"}) {
    EXPECT_EQ(reasonOf([&] { modelOf(answer); }), "wrong_device") << answer;
  }
  EXPECT_EQ(reasonOf([&] { modelOf("sRA DeviceIdent FF LMS111"); }), "bad_answer");
}

TEST(SickTelegramTest, ModelsAreKnownByNameInBinary) {
  const auto modelOf = [](const std::string& bytes) {
    return sickModel({ColaDialect::kBinary, bytes});
  };
  EXPECT_DOUBLE_EQ(modelOf(bytesOf("sRA DeviceIdent \0\x06LMS5xx\0\x04V1.1")).max_range, 80.0);
  EXPECT_EQ(reasonOf([&] { modelOf(bytesOf("sRA DeviceIdent \0\x06NAV310\0\x04V1.1")); }),
            "wrong_device");
  EXPECT_EQ(reasonOf([&] { modelOf(bytesOf("sRA DeviceIdent \xFF\xFFLMS111")); }), "bad_answer");
}

}  // namespace
}  // namespace datmo::sick_telegram_test
