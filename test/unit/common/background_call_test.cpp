// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/common/background_call.h"

#include <future>
#include <memory>

#include <gtest/gtest.h>

namespace datmo::background_call_test {
namespace {

constexpr std::chrono::minutes kLong(1);
constexpr std::chrono::milliseconds kNone(0);

/// The result of a call that has ended; 0 if there is none.
int resultOf(BackgroundCall<int>& call) {
  EXPECT_TRUE(call.waitFor(kLong));
  const std::optional<int> result = call.take();
  return result ? *result : 0;
}

TEST(BackgroundCall, ItsResultIsTakenOnce) {
  BackgroundCall<int> call([] { return 7; });
  EXPECT_FALSE(call.take()) << "nothing was called";
  for (int i = 0; i < 2; ++i) {
    EXPECT_TRUE(call.start());
    EXPECT_EQ(resultOf(call), 7);
    EXPECT_FALSE(call.take());
  }
}

TEST(BackgroundCall, WhileOneRunsNothingWaitsAndNoOtherIsStarted) {
  std::promise<void> may_end;
  const std::shared_future<void> end = may_end.get_future().share();
  BackgroundCall<int> call([end] {
    end.wait();
    return 7;
  });
  EXPECT_TRUE(call.start());
  EXPECT_FALSE(call.start());
  EXPECT_FALSE(call.waitFor(kNone));
  EXPECT_FALSE(call.take());
  may_end.set_value();
  EXPECT_EQ(resultOf(call), 7);
  EXPECT_FALSE(call.take()) << "it was called once";
}

TEST(BackgroundCall, ItsDestructionDoesNotWait) {
  std::promise<void> may_end;
  const std::shared_future<void> end = may_end.get_future().share();
  const auto ended = std::make_shared<std::promise<void>>();
  std::future<void> has_ended = ended->get_future();
  {
    BackgroundCall<int> call([end, ended] {
      end.wait();
      ended->set_value();
      return 7;
    });
    EXPECT_TRUE(call.start());
  }
  may_end.set_value();
  EXPECT_EQ(has_ended.wait_for(kLong), std::future_status::ready);
}

}  // namespace
}  // namespace datmo::background_call_test
