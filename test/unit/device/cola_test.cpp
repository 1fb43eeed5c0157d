// SPDX-License-Identifier: BSD-3-Clause
// The protocol of SICK's scanners in its two dialects: frames, and the fields of telegrams.
#include "datmo_fusion/device/cola.h"

#include "device/device_reason.h"
#include "device/fake_sick.h"
#include <gtest/gtest.h>

namespace datmo::cola_test {
namespace {

using samples::bytesOf;
using samples::reasonOf;

ColaTelegram text(const std::string& bytes) { return {ColaDialect::kText, bytes}; }
ColaTelegram binary(const std::string& bytes) { return {ColaDialect::kBinary, bytes}; }

/// The manual's example (LMS4000, 8023198, 12.1).
const std::string kManualsFrame = bytesOf("\x02\x02\x02\x02\0\0\0\x11sEN LMDscandata \x01\x33");

std::string nextOf(ColaReader& reader) {
  const std::optional<ColaTelegram> telegram = reader.next();
  return telegram ? telegram->bytes : "none";
}

/// Returns the reason why bytes are refused in a dialect.
std::string reasonOfBytes(ColaDialect dialect, const std::string& bytes) {
  ColaReader reader(dialect);
  reader.feed(bytes);
  return reasonOf([&] { reader.next(); });
}

TEST(ColaTest, ACommandIsFramedAsTheManualHasIt) {
  const std::vector<ColaParameter> start{{"1"}};
  EXPECT_EQ(colaFrame(colaCommand(ColaDialect::kBinary, "sEN LMDscandata", start)), kManualsFrame);
  EXPECT_EQ(colaFrame(colaCommand(ColaDialect::kText, "sEN LMDscandata", start)),
            "\x02sEN LMDscandata 1\x03");
  EXPECT_EQ(colaCommand(ColaDialect::kBinary, "sRN STlms").bytes, "sRN STlms");
  EXPECT_EQ(colaCommand(ColaDialect::kBinary, "sMN It", {{"F4724744", 4}, {"+300", 2}}).bytes,
            bytesOf("sMN It \xF4\x72\x47\x44\x01\x2C"));
}

TEST(ColaTest, BytesBecomeTelegrams) {
  ColaReader reader(ColaDialect::kText);
  reader.feed("half of an old one\x02sAN Ru");
  EXPECT_EQ(nextOf(reader), "none");
  reader.feed("n 1\x03\x02sEA\x03\x02");
  EXPECT_EQ(nextOf(reader), "sAN Run 1");
  EXPECT_EQ(nextOf(reader), "sEA");
  EXPECT_EQ(nextOf(reader), "none");
}

TEST(ColaTest, BinaryBytesBecomeTelegramsOneByOne) {
  ColaReader reader(ColaDialect::kBinary);
  for (const char byte : kManualsFrame) {
    EXPECT_EQ(nextOf(reader), "none");
    reader.feed(std::string(1, byte));
  }
  reader.feed(kManualsFrame.substr(0, 9));
  EXPECT_EQ(nextOf(reader), "sEN LMDscandata \x01");
  EXPECT_EQ(nextOf(reader), "none");
  reader.feed(kManualsFrame.substr(9));
  EXPECT_EQ(nextOf(reader), "sEN LMDscandata \x01");
}

TEST(ColaTest, ATruncatedTextTelegramDoesNotCostTheNextOne) {
  ColaReader reader(ColaDialect::kText);
  reader.feed("\x02sSN LMDscandata 1 1 A0\x02sAN Run 1\x03");
  EXPECT_EQ(nextOf(reader), "sAN Run 1");
}

TEST(ColaTest, InvalidBytesAreRefused) {
  EXPECT_EQ(reasonOfBytes(ColaDialect::kText, std::string(200000, 'x')), "bad_answer");
  EXPECT_EQ(reasonOfBytes(ColaDialect::kText, "HTTP/1.1 400\x03"), "bad_answer");
  EXPECT_EQ(reasonOfBytes(ColaDialect::kBinary, "H"), "bad_answer");
}

TEST(ColaTest, TheOtherDialectIsRecognized) {
  EXPECT_EQ(reasonOfBytes(ColaDialect::kText, kManualsFrame.substr(0, 4)), "wrong_dialect");
  EXPECT_EQ(reasonOfBytes(ColaDialect::kBinary, "\x02s"), "wrong_dialect");
}

TEST(ColaTest, AWrongChecksumIsRefusedWhereverTheErrorIs) {
  for (std::size_t at = 8; at < kManualsFrame.size(); ++at) {
    std::string bytes = kManualsFrame;
    bytes[at] = static_cast<char>(bytes[at] ^ 0x10);
    EXPECT_EQ(reasonOfBytes(ColaDialect::kBinary, bytes), "bad_answer") << at;
  }
}

TEST(ColaTest, ATruncatedBinaryTelegramBeforeAnotherIsRefused) {
  EXPECT_EQ(reasonOfBytes(ColaDialect::kBinary, kManualsFrame.substr(0, 15) + kManualsFrame),
            "bad_answer");
}

TEST(ColaTest, ALengthBeyondTheBoundIsRefusedBeforeItIsWaitedFor) {
  EXPECT_EQ(reasonOfBytes(ColaDialect::kBinary, bytesOf("\x02\x02\x02\x02\xFF\xFF\xFF\xFF")),
            "bad_answer");
  EXPECT_EQ(reasonOfBytes(ColaDialect::kBinary, bytesOf("\x02\x02\x02\x02\0\x02\0\x01")),
            "bad_answer");
  EXPECT_EQ(reasonOfBytes(ColaDialect::kBinary, bytesOf("\x02\x02\x02\x02\0\x02\0\0")), "none");
}

TEST(ColaTest, ATelegramIsMatchedByItsWholeName) {
  for (const ColaTelegram& one : {text("sSN LMDscandata 1"), binary("sSN LMDscandata \x01")}) {
    EXPECT_TRUE(one.isCalled("sSN LMDscandata"));
    EXPECT_FALSE(one.isCalled("sSN LMDscan"));
    EXPECT_FALSE(one.isCalled("sSN"));
  }
  EXPECT_FALSE(text("sSN LMDscandatamon 1").isCalled("sSN LMDscandata"));
  EXPECT_TRUE(text("sFA").isCalled("sFA"));
}

TEST(ColaTest, NumbersInTextAreHexadecimalOrHaveASign) {
  const ColaTelegram telegram = text("sRA It FF +10 -10 FFF92230 3F000000 100000000 1x");
  ColaFields fields(telegram);
  EXPECT_EQ(fields.number(1, "it"), 255U);
  EXPECT_EQ(fields.number(1, "it"), 10U);
  EXPECT_EQ(fields.signedNumber("it"), -10);
  EXPECT_EQ(fields.signedNumber("it"), -450000);
  EXPECT_FLOAT_EQ(fields.real("it"), 0.5F);
  EXPECT_EQ(reasonOf([&] { fields.number(4, "it"); }), "bad_answer");
  EXPECT_EQ(reasonOf([&] { fields.number(4, "it"); }), "bad_answer");
  EXPECT_EQ(reasonOf([&] { fields.number(4, "it"); }), "bad_answer");  // there is none
}

TEST(ColaTest, BinaryNumbersAreBigEndian) {
  const ColaTelegram telegram =
      binary(bytesOf("sRA It \xFF\x01\x02\xFF\xF9\x22\x30\x3F\0\0\0 a b\x20"));
  ColaFields fields(telegram);
  EXPECT_EQ(fields.number(1, "it"), 255U);
  EXPECT_EQ(fields.number(2, "it"), 0x102U);
  EXPECT_EQ(fields.signedNumber("it"), -450000);
  EXPECT_FLOAT_EQ(fields.real("it"), 0.5F);
  EXPECT_EQ(fields.characters(4, "it"), " a b");
  EXPECT_EQ(reasonOf([&] { fields.number(2, "it"); }), "bad_answer");
  EXPECT_EQ(fields.number(1, "it"), 0x20U);
  EXPECT_EQ(reasonOf([&] { fields.skip(1, "it"); }), "bad_answer");
}

TEST(ColaTest, MoreFieldsThanBytesAreRefused) {
  const ColaTelegram short_binary = binary("sRA It abcdef");
  const ColaFields fields(short_binary);
  EXPECT_EQ(reasonOf([&] { fields.require(3, 2, "it"); }), "none");
  EXPECT_EQ(reasonOf([&] { fields.require(4, 2, "it"); }), "bad_answer");
  const ColaTelegram short_text = text("sRA It a b");
  EXPECT_EQ(reasonOf([&] { ColaFields(short_text).require(2, 2, "it"); }), "none");
  EXPECT_EQ(reasonOf([&] { ColaFields(short_text).require(3, 2, "it"); }), "bad_answer");
}

}  // namespace
}  // namespace datmo::cola_test
