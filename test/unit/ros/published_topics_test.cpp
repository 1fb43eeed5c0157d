// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/ros/stage/published_topics.h"

#include <atomic>
#include <future>
#include <memory>
#include <thread>

#include <gtest/gtest.h>

namespace datmo::published_topics_test {
namespace {

constexpr std::chrono::milliseconds kNone(0);
constexpr std::chrono::minutes kLong(1);

const TopicTypes kScan{{"/scan", "sensor_msgs/LaserScan"}};

/// A master that answers the first query when, and with what, the test tells it, and no other one.
class Master {
 public:
  PublishedTopics::Query query() const {
    return [shared = shared_]() -> std::optional<TopicTypes> {
      return shared->queries++ == 0 ? shared->answer.get_future().get() : std::nullopt;
    };
  }

  int queries() const { return shared_->queries; }
  void answer(const TopicTypes& types) { shared_->answer.set_value(types); }

 private:
  struct Shared {
    std::atomic<int> queries{0};
    std::promise<std::optional<TopicTypes>> answer;
  };
  std::shared_ptr<Shared> shared_ = std::make_shared<Shared>();
};

TEST(PublishedTopics, TypesAreThoseOfTheAnswer) {
  PublishedTopics topics([] { return kScan; });
  EXPECT_FALSE(topics.typeOf("/scan")) << "the master was not asked";
  topics.update(kLong);
  EXPECT_EQ(topics.typeOf("/scan"), "sensor_msgs/LaserScan");
  EXPECT_EQ(topics.typeOf("/points"), "") << "not published";
}

TEST(PublishedTopics, ALateAnswerCountsAndNothingWaitsForIt) {
  Master master;
  PublishedTopics topics(master.query());
  const auto start = std::chrono::steady_clock::now();
  topics.update(kNone);
  topics.update(kLong);  // the first query still runs: nothing is started, and nothing to wait for
  EXPECT_LT(std::chrono::steady_clock::now() - start, kLong);
  EXPECT_LE(master.queries(), 1);
  EXPECT_FALSE(topics.typeOf("/scan"));
  master.answer(kScan);
  while (!topics.typeOf("/scan")) {
    std::this_thread::yield();
    topics.update(kNone);
  }
  EXPECT_EQ(topics.typeOf("/scan"), "sensor_msgs/LaserScan");
}

TEST(PublishedTopics, TheLastAnswerStaysIfThereIsNoNewOne) {
  Master master;
  PublishedTopics topics(master.query());
  master.answer(kScan);
  topics.update(kLong);
  topics.update(kLong);
  EXPECT_EQ(master.queries(), 2);
  EXPECT_EQ(topics.typeOf("/scan"), "sensor_msgs/LaserScan");
}

}  // namespace
}  // namespace datmo::published_topics_test
