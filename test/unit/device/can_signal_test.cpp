// SPDX-License-Identifier: BSD-3-Clause
// Numbers in frames of a CAN bus, worked out by hand: both byte orders, signs, scales; and their
// descriptions.
#include "datmo_fusion/device/can_signal.h"

#include <fstream>
#include <vector>

#include "device/can_samples.h"
#include <gtest/gtest.h>

#include "datmo_fusion/common/options.h"
#include "datmo_fusion/device/can_database.h"

namespace datmo::can_signal_test {
namespace {

using samples::canFrame;

CanSignal signalOf(const std::string& text) { return canSignal("speed", {0x1A0, false}, text); }

std::string errorOf(const std::function<void()>& act) {
  try {
    act();
  } catch (const OptionError& error) {
    return error.what();
  }
  return "none";
}

TEST(CanSignalTest, IntelStartsAtTheLeastSignificantBit) {
  // Bits 8 to 19: byte 1 = 0x34, low half of byte 2 = 0x2: 0x234.
  const CanFrame frame = canFrame(0x1A0, {0xFF, 0x34, 0xA2, 0xFF});
  EXPECT_EQ(signalOf("8|12@1+ (1,0)").raw(frame), 0x234U);
  // Bits 12 to 15 are the high half of byte 1.
  EXPECT_EQ(signalOf("12|4@1+ (1,0)").raw(frame), 0x3U);
  EXPECT_EQ(signalOf("0|32@1+ (1,0)").raw(frame), 0xFFA234FFU);
}

TEST(CanSignalTest, MotorolaStartsAtTheMostSignificantBitAndContinuesInTheNextByte) {
  const CanFrame frame = canFrame(0x1A0, {0x12, 0x34, 0x56, 0x78});
  // Bit 7 is the most significant one of byte 0: 0x12, 0x34.
  EXPECT_EQ(signalOf("7|16@0+ (1,0)").raw(frame), 0x1234U);
  // From bit 3 of byte 0, the low half 0x2, through the whole byte 1: 0x234.
  EXPECT_EQ(signalOf("3|12@0+ (1,0)").raw(frame), 0x234U);
  // From bit 9 of byte 1 (0x34 = 0011 0100): bits 9, 8 = 0, 0, then 010 of 0x56 = 0101 0110.
  EXPECT_EQ(signalOf("9|5@0+ (1,0)").raw(frame), 0b00010U);
  EXPECT_EQ(signalOf("7|1@0+ (1,0)").raw(frame), 0U);
  EXPECT_EQ(signalOf("4|1@0+ (1,0)").raw(frame), 1U);
}

TEST(CanSignalTest, SignsAndScalesGiveTheValue) {
  // 0xFF38 of two's complement is -200.
  const CanFrame frame = canFrame(0x1A0, {0x38, 0xFF, 0xFF, 0x38});
  EXPECT_DOUBLE_EQ(*signalOf("0|16@1- (0.01,0)").value(frame), -2.0);
  EXPECT_DOUBLE_EQ(*signalOf("23|16@0- (0.5,10)").value(frame), -90.0);
  EXPECT_DOUBLE_EQ(*signalOf("0|16@1+ (0.01,-40)").value(frame), 613.36);
  const CanFrame full = canFrame(0x1A0, {0xFE, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF});
  EXPECT_DOUBLE_EQ(*signalOf("0|64@1- (1,0)").value(full), -2.0);
  EXPECT_DOUBLE_EQ(*signalOf("0|1@1- (1,0)").value(frame), 0.0);
}

TEST(CanSignalTest, AFrameThatIsTooShortHasNoValue) {
  const CanFrame frame = canFrame(0x1A0, {0x12, 0x34});
  EXPECT_TRUE(signalOf("0|16@1+ (1,0)").raw(frame));
  EXPECT_FALSE(signalOf("1|16@1+ (1,0)").raw(frame));
  EXPECT_TRUE(signalOf("7|16@0+ (1,0)").raw(frame));
  EXPECT_FALSE(signalOf("6|16@0+ (1,0)").raw(frame));
  EXPECT_FALSE(signalOf("8|16@1+ (1,0)").value(frame));
  EXPECT_EQ(signalOf("6|16@0+ (1,0)").bytes(), 3U);
  EXPECT_EQ(signalOf("0|3@0+ (1,0)").bytes(), 2U);
}

TEST(CanSignalTest, ItsTextHasTheFormatOfADbcFile) {
  const CanSignal signal = signalOf(R"( 23|16@0- (1.5E-2,-3) [-250|250] "km/h" Vector__XXX,ABS)");
  EXPECT_EQ(signal.start, 23U);
  EXPECT_EQ(signal.length, 16U);
  EXPECT_TRUE(signal.is_big_endian);
  EXPECT_TRUE(signal.is_signed);
  EXPECT_DOUBLE_EQ(signal.factor, 0.015);
  EXPECT_DOUBLE_EQ(signal.offset, -3.0);
  EXPECT_EQ(signal.unit, "km/h");
  EXPECT_TRUE(signal.isInLimits(-250.0));
  EXPECT_FALSE(signal.isInLimits(250.1));
  EXPECT_EQ(signalOf("8|16@1+ (0.01,0) [0|250] km/h").unit, "km/h");
  EXPECT_TRUE(signalOf("8|16@1+ (0.01,0) [0|0]").isInLimits(1e9));
}

TEST(CanSignalTest, ErrorsInItAreNamed) {
  for (const char* text :
       {"", "8|16", "8|16@2+ (1,0)", "8|16@1 (1,0)", "8|0@1+ (1,0)", "8|65@1+ (1,0)",
        "505|16@1+ (1,0)", "8|16@1+ (0,0)", "8|16@1+ (1,0) [5|1]", "8|16@1+ (1.2.3.,0)",
        "8|16@1+ (1e999,0)", "8|16@1+ (1e308,0)"}) {
    const std::string error = errorOf([text] { signalOf(text); });
    EXPECT_NE(error.find("speed"), std::string::npos) << text << ": " << error;
    EXPECT_NE(error.find("expected"), std::string::npos) << text << ": " << error;
  }
}

TEST(CanSignalTest, AnIdOfMoreThan11BitsIsExtended) {
  EXPECT_FALSE(canId("x", 0x7FF).is_extended);
  EXPECT_TRUE(canId("x", 0x18FEF100).is_extended);
  EXPECT_EQ(canId("x", 0x98FEF100).number, 0x18FEF100U);
  const CanId low = canId("x", 0x80000100);
  EXPECT_TRUE(low.is_extended);
  EXPECT_EQ(low.number, 0x100U);
  EXPECT_NE(errorOf([] { canId("x", 0x20000000); }), "none");
  EXPECT_EQ(toText(CanId{0x1A0, false}), "0x1A0");
  EXPECT_EQ(toText(CanId{0x18FEF100, true}), "0x18FEF100 (29 bits)");
}

class CanDatabaseTest : public testing::Test {
 protected:
  CanDatabaseTest() {
    std::ofstream(file_) << "VERSION \"\"\n\nBU_: ABS ESP\r\n"
                            "BO_ 416 Brakes: 8 ABS\r\n"
                            " SG_ Speed : 8|16@1+ (0.01,0) [0|250] \"km/h\"  ESP\r\n"
                            " SG_ Page M : 0|4@1+ (1,0) [0|15] \"\" ESP\n"
                            " SG_ Odometer m1 : 24|16@1+ (1,0) [0|0] \"km\" ESP\n"
                            "BO_ 2566844672 Engine: 8 ABS\n"
                            " SG_ Speed : 7|16@0- (1,0) [0|0] \"rpm\" ESP\n"
                            " SG_ Torque : 32|32@1- (1,0) [0|0] \"Nm\" ESP\n"
                            "CM_ \""
                         << std::string(100000, 'x')
                         << "\";\n"
                            "SIG_VALTYPE_ 2566844672 Torque : 1;\n";
  }

  CanSignal find(const std::string& name) const { return canSignalOf("can/speed", file_, name); }
  std::string errorOfName(const std::string& name) const {
    return errorOf([&] { find(name); });
  }

  std::string file_ = testing::TempDir() + "can_database_test.dbc";
};

TEST_F(CanDatabaseTest, ASignalIsFoundByItsName) {
  const CanSignal signal = find("Brakes.Speed");
  EXPECT_EQ(signal.id.number, 416U);
  EXPECT_FALSE(signal.id.is_extended);
  EXPECT_EQ(signal.start, 8U);
  EXPECT_EQ(signal.unit, "km/h");
  const CanSignal other = find("Engine.Speed");
  EXPECT_EQ(other.id.number, 0x18FEF100U);
  EXPECT_TRUE(other.id.is_extended);
  EXPECT_TRUE(other.is_big_endian);
  EXPECT_EQ(find("Page").length, 4U);
}

TEST_F(CanDatabaseTest, UnusableSignalsAreNamed) {
  EXPECT_NE(errorOfName("Speed").find("in several messages"), std::string::npos);
  EXPECT_NE(errorOfName("Yaw").find("does not exist"), std::string::npos);
  EXPECT_NE(errorOfName("Odometer").find("multiplexed"), std::string::npos);
  EXPECT_NE(errorOfName("Torque").find("a float"), std::string::npos);
  EXPECT_NE(errorOf([] {
              canSignalOf("can/speed", "/nowhere.dbc", "Speed");
            }).find("/nowhere.dbc' cannot be read"),
            std::string::npos);
}

}  // namespace
}  // namespace datmo::can_signal_test
