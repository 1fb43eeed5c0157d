// SPDX-License-Identifier: BSD-3-Clause
#include "bag_header.h"

#include <gtest/gtest.h>

namespace datmo::bag_header_test {
namespace {

/// Length (less than 256) and text of a field.
std::string field(const std::string& text) {
  return static_cast<char>(text.size()) + std::string(3, '\0') + text;
}

const std::string kCount = field("count=\x01\x02" + std::string(2, '\0'));

TEST(BagHeader, NumbersHaveTheirNameAndTheirSize) {
  const BagHeader header(field("account=abcd") + kCount + field("op=\x05"));
  EXPECT_TRUE(header.hasWholeFields());
  EXPECT_EQ(header.number<std::uint32_t>("count"), 0x0201U);
  EXPECT_EQ(header.number<std::uint8_t>("op"), 5U);
  EXPECT_FALSE(header.number<std::uint64_t>("count"));
  EXPECT_FALSE(header.number<std::uint32_t>("coun"));
  EXPECT_FALSE(BagHeader().number<std::uint32_t>("count"));
}

TEST(BagHeader, TheLastFieldOfANameCounts) {
  const BagHeader header(field("op=\x05") + field("op=\x02"));
  EXPECT_EQ(header.number<std::uint8_t>("op"), 2U);
}

TEST(BagHeader, EveryCutIsFound) {
  const std::string whole = field("op=\x02") + kCount;
  EXPECT_TRUE(BagHeader(whole).hasWholeFields());
  for (std::size_t size = field("op=\x02").size() + 1; size < whole.size(); ++size) {
    const BagHeader header(whole.substr(0, size));
    EXPECT_FALSE(header.hasWholeFields()) << size;
    EXPECT_FALSE(header.number<std::uint32_t>("count")) << size;
  }
}

TEST(BagHeader, AFieldWithoutANameIsFound) {
  EXPECT_FALSE(BagHeader(field("op=\x02") + field("count")).hasWholeFields());
  EXPECT_FALSE(BagHeader(field("")).hasWholeFields());
}

TEST(BagHeader, NoLengthLeavesIt) {
  for (int bit = 0; bit < 8; ++bit) {
    for (std::size_t byte = 0; byte < 4; ++byte) {
      std::string bytes = kCount;
      bytes[byte] = static_cast<char>(bytes[byte] ^ (1 << bit));
      EXPECT_FALSE(BagHeader(bytes).hasWholeFields()) << "bit " << bit << " of byte " << byte;
    }
  }
}

}  // namespace
}  // namespace datmo::bag_header_test
