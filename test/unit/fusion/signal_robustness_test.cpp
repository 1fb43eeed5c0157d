// SPDX-License-Identifier: BSD-3-Clause
// SPATEM and MAPEM that are written and read again, truncated, changed, or random.
#include <random>
#include <string>

#include "fusion/signal_messages.h"
#include <gtest/gtest.h>

namespace datmo {
namespace {

using samples::refusalOf;

TEST(SignalMessages, EveryTruncationIsRefused) {
  const std::string spatem = samples::wireSpatem().bytes();
  for (std::size_t size = 0; size < spatem.size(); ++size) {
    EXPECT_EQ(refusalOf([&] { decodeSpatem(spatem.substr(0, size)); }), "truncated_message");
  }
  const std::string mapem = samples::wireMapem().bytes();
  for (std::size_t size = 0; size < mapem.size(); ++size) {
    EXPECT_EQ(refusalOf([&] { decodeMapem(mapem.substr(0, size)); }), "truncated_message");
  }
}

/// Returns a random message that a writer can write; each one has different bits.
Mapem randomMapem(std::mt19937& random) {
  const auto upTo = [&random](std::int64_t max) {
    return std::uniform_int_distribution<std::int64_t>(0, max)(random);
  };
  Mapem message;
  message.revision = upTo(127);
  for (std::int64_t i = 0; i <= upTo(3); ++i) {
    MapIntersection intersection;
    intersection.id.number = upTo(65535);
    intersection.latitude = upTo(1800000000) - 900000000;
    intersection.longitude = upTo(3600000000) - 1800000000;
    for (std::int64_t j = 0; j <= upTo(8); ++j) {
      MapLane lane;
      lane.id = upTo(255);
      lane.direction = upTo(3);
      lane.sharing = upTo(1023);
      lane.type = upTo(7);
      for (std::int64_t k = 0; k < 2 + upTo(30); ++k) {
        const std::int64_t half = std::int64_t{1} << (5 + upTo(10));
        lane.nodes.push_back({false, upTo(2 * half - 1) - half, upTo(2 * half - 1) - half});
      }
      intersection.lanes.push_back(lane);
    }
    message.intersections.push_back(intersection);
  }
  return message;
}

TEST(SignalMessages, WrittenMessagesAreRead) {
  std::mt19937 random(11);
  for (int i = 0; i < 300; ++i) {
    const Mapem message = randomMapem(random);
    const std::string bytes = encode(message);
    const Mapem read = decodeMapem(bytes);
    EXPECT_EQ(encode(read), bytes);
    ASSERT_EQ(read.intersections.size(), message.intersections.size());
    for (std::size_t j = 0; j < read.intersections.size(); ++j) {
      EXPECT_EQ(read.intersections[j].latitude, message.intersections[j].latitude);
      const auto& lanes = read.intersections[j].lanes;
      ASSERT_EQ(lanes.size(), message.intersections[j].lanes.size());
      for (std::size_t k = 0; k < lanes.size(); ++k) {
        const auto& nodes = message.intersections[j].lanes[k].nodes;
        ASSERT_EQ(lanes[k].nodes.size(), nodes.size());
        for (std::size_t n = 0; n < nodes.size(); ++n) {
          EXPECT_EQ(lanes[k].nodes[n].x, nodes[n].x);
          EXPECT_EQ(lanes[k].nodes[n].y, nodes[n].y);
        }
      }
    }
  }
}

TEST(SignalMessages, AnyBytesAreReadOrRefused) {
  constexpr int kMessages = 20000;
  std::mt19937 random(7);
  std::uniform_int_distribution<int> octet(0, 255);
  std::uniform_int_distribution<std::size_t> size(0, 300);
  const auto take = [](const std::string& bytes) {
    const std::string copy(bytes);  // of its own size, so that a sanitizer detects reads beyond it
    for (const auto& decode : {+[](const std::string& one) { decodeSpatem(one); },
                               +[](const std::string& one) { decodeMapem(one); }}) {
      try {
        decode(copy);
      } catch (const WireError& error) {
        EXPECT_FALSE(error.reason().empty());
      }
    }
  };
  for (int i = 0; i < kMessages; ++i) {
    std::string bytes(size(random), '\0');
    for (char& one : bytes) {
      one = static_cast<char>(octet(random));
    }
    if (bytes.size() > 1) {
      bytes[0] = 2;
      bytes[1] = i % 2 == 0 ? 4 : 5;
    }
    take(bytes);
    std::string changed = i % 2 == 0 ? samples::wireSpatem().bytes() : samples::wireMapem().bytes();
    for (int bit = 0; bit < 3; ++bit) {
      changed[6 + size(random) % (changed.size() - 6)] = static_cast<char>(octet(random));
    }
    take(changed);
  }
}

}  // namespace
}  // namespace datmo
