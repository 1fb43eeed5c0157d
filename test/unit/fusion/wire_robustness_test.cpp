// SPDX-License-Identifier: BSD-3-Clause
// Messages that are truncated, changed, or random.
#include <random>
#include <string>
#include <vector>

#include "fusion/wire_messages.h"
#include <gtest/gtest.h>

#include "datmo_fusion/fusion/wire/cam.h"
#include "datmo_fusion/fusion/wire/cpm.h"
#include "datmo_fusion/fusion/wire/wire_error.h"

namespace datmo {
namespace {

TEST(WireRobustness, EveryTruncationIsRefused) {
  const std::string cam = samples::wireCam().bytes();
  for (std::size_t size = 0; size < cam.size(); ++size) {
    const std::string part = cam.substr(0, size);
    EXPECT_EQ(samples::refusalOf([&] { decodeCam(part); }), "truncated_message") << size;
  }
  for (const std::string& cpm : {samples::wireCpm().bytes(), samples::wireRichCpm(false).bytes()}) {
    for (std::size_t size = 0; size < cpm.size(); ++size) {
      const std::string part = cpm.substr(0, size);
      EXPECT_EQ(samples::refusalOf([&] { decodeCpm(part, ItsDictionary::k221); }),
                "truncated_message")
          << size;
    }
  }
}

/// Whatever it is: read, or refused as a message.
void takeAnything(const std::string& bytes) {
  const std::string copy(bytes);  // of its own size, so that a sanitizer detects reads beyond it
  try {
    UperReader head(copy);
    ItsHeader header;
    walk(head, header);
    if (header.message == ItsHeader::kCam) {
      decodeCam(copy);
    } else {
      decodeCpm(copy, ItsDictionary::k221);
    }
  } catch (const WireError& error) {
    EXPECT_FALSE(error.reason().empty());
  }
}

TEST(WireRobustness, AnyBytesAreReadOrRefused) {
  constexpr int kMessages = 20000;
  std::mt19937 random(7);
  std::uniform_int_distribution<int> octet(0, 255);
  std::uniform_int_distribution<std::size_t> size(0, 200);
  const std::vector<std::string> good{samples::wireCam().bytes(),
                                      samples::wireRichCpm(false).bytes()};
  for (int i = 0; i < kMessages; ++i) {
    std::string bytes(size(random), '\0');
    for (char& one : bytes) {
      one = static_cast<char>(octet(random));
    }
    if (i % 2 == 0 && bytes.size() > 1) {
      bytes[0] = 2;
      bytes[1] = i % 4 == 0 ? 2 : 14;
    }
    takeAnything(bytes);
    std::string changed = good[static_cast<std::size_t>(i) % 2];
    for (int bit = 0; bit < 3; ++bit) {
      const std::size_t at = 6 + size(random) % (changed.size() - 6);
      changed[at] = static_cast<char>(octet(random));
    }
    takeAnything(changed);
  }
}

}  // namespace
}  // namespace datmo
