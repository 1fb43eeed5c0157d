// SPDX-License-Identifier: BSD-3-Clause
// Bits by the rules of X.691, derived by hand.
#include "datmo_fusion/fusion/wire/uper.h"

#include <string>

#include "fusion/wire_bits.h"
#include <gtest/gtest.h>

#include "datmo_fusion/fusion/wire/wire_error.h"

namespace datmo {
namespace {

using samples::refusalOf;
using samples::WireBits;

TEST(Uper, IntegersTakeTheBitsOfTheirRange) {
  UperWriter writer;
  std::int64_t heading = 900;  // of 0 to 3601: 12 bits, 0011 1000 0100
  std::int64_t offset = -1;    // of -2 to 1: two bits, 01
  std::int64_t only = 5;       // of 5 to 5: no bit
  writer.integer(heading, 0, 3601);
  writer.integer(offset, -2, 1);
  writer.integer(only, 5, 5);
  EXPECT_EQ(writer.bytes(), std::string("\x38\x44"));  // 0011 1000  0100 01(00)

  UperReader reader("\x38\x44");
  std::int64_t value = 0;
  reader.integer(value, 0, 3601);
  EXPECT_EQ(value, 900);
  reader.integer(value, -2, 1);
  EXPECT_EQ(value, -1);
  reader.integer(value, 5, 5);
  EXPECT_EQ(value, 5);
}

TEST(Uper, ValuesOutOfRangeAreRefused) {
  UperReader reader("\xff\xff");
  std::int64_t value = 0;
  EXPECT_EQ(refusalOf([&] { reader.integer(value, 0, 3601); }),
            "bad_message");  // 4095 in 12 bits
  UperWriter writer;
  value = 3602;
  EXPECT_EQ(refusalOf([&] { writer.integer(value, 0, 3601); }), "bad_message");
}

TEST(Uper, NothingIsReadBeyondTheEnd) {
  UperReader reader(std::string_view("\x01\x02\x03", 2));
  std::int64_t value = 0;
  reader.integer(value, 0, 4095);
  EXPECT_EQ(refusalOf([&] { reader.integer(value, 0, 31); }), "truncated_message");
  reader.integer(value, 0, 15);  // the remaining bits
  EXPECT_EQ(value, 2);
}

TEST(Uper, OpenTypesAreWholeOctetsAfterTheirLength) {
  UperWriter writer;
  writer.present(true);
  std::int64_t value = 5;
  writer.openType([&](Uper& inner) { inner.integer(value, 0, 7); });
  // 1, 0000 0001, 101 0 0000
  EXPECT_EQ(writer.bytes(), WireBits().add(1, 1).add(1, 8).add(0xA0, 8).bytes());

  // The length of 200 octets takes two octets: 10, and 14 bits.
  UperWriter longer;
  longer.openType([&](Uper& inner) {
    for (int i = 0; i < 200; ++i) {
      inner.skipInteger(0, 255);
    }
  });
  ASSERT_EQ(longer.bytes().size(), 202U);
  EXPECT_EQ(longer.bytes().substr(0, 2), std::string("\x80\xC8"));
  const std::string bytes = longer.bytes() + "\x07";
  UperReader reader(bytes);
  reader.skipOpenType();
  reader.integer(value, 0, 255);
  EXPECT_EQ(value, 7);
}

TEST(Uper, AnOpenTypeEndsAtItsLength) {
  const std::string bytes = WireBits().add(1, 8).add(0xFF, 8).add(0x11, 8).bytes();
  UperReader reader(bytes);
  std::int64_t value = 0;
  EXPECT_EQ(
      refusalOf([&] { reader.openType([&](Uper& inner) { inner.integer(value, 0, 65535); }); }),
      "truncated_message");
}

TEST(Uper, AdditionsAreSkipped) {
  // Three additions (the number less one in seven bits), the first and the third are there.
  const std::string bytes = WireBits()
                                .add(2, 7)
                                .add(0b101, 3)
                                .addOpen(WireBits().add(0xABC, 12))
                                .addOpen(WireBits().add(1, 1))
                                .add(42, 8)
                                .bytes();
  UperReader reader(bytes);
  reader.skipAdditions();
  std::int64_t value = 0;
  reader.integer(value, 0, 255);
  EXPECT_EQ(value, 42);
}

TEST(Uper, ManyAdditionsAreSkipped) {
  WireBits bits;
  bits.add(1, 1).add(70, 8);  // more than 64: with a length determinant
  for (int i = 0; i < 70; ++i) {
    bits.add(i == 69 ? 1 : 0, 1);
  }
  const std::string bytes = bits.addOpen(WireBits().add(3, 8)).add(42, 8).bytes();
  UperReader reader(bytes);
  reader.skipAdditions();
  std::int64_t value = 0;
  reader.integer(value, 0, 255);
  EXPECT_EQ(value, 42);
}

TEST(Uper, AddedChoicesAreSkipped) {
  const std::string bytes =
      WireBits().add(0, 1).add(3, 6).addOpen(WireBits().add(9, 8)).add(42, 8).bytes();
  UperReader reader(bytes);
  reader.skipAddedChoice();
  std::int64_t value = 0;
  reader.integer(value, 0, 255);
  EXPECT_EQ(value, 42);
}

TEST(Uper, SizesBeyondTheRootAreLengths) {
  const std::string bytes = WireBits().add(0, 1).add(4, 3).add(1, 1).add(9, 8).bytes();
  UperReader reader(bytes);
  EXPECT_EQ(reader.extensibleSize(0, 1, 8), 5);
  EXPECT_EQ(reader.extensibleSize(0, 1, 8), 9);
}

TEST(Uper, LengthsInFragmentsAreRefused) {
  UperReader reader("\xC1\x01\x01");
  EXPECT_EQ(refusalOf([&] { reader.skipOpenType(); }), "bad_message");
}

}  // namespace
}  // namespace datmo
