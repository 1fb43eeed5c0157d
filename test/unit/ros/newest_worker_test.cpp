// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/ros/stage/newest_worker.h"

#include <future>
#include <vector>

#include <gtest/gtest.h>

namespace datmo::newest_worker_test {
namespace {

TEST(NewestWorker, WithoutAThreadEachJobIsDoneImmediately) {
  NewestWorker<int, int> worker([](int job) { return 10 * job; }, false);
  EXPECT_FALSE(worker.start(1));
  EXPECT_FALSE(worker.start(2));
  EXPECT_EQ(worker.take(), (std::vector<int>{10, 20}));
  EXPECT_TRUE(worker.take().empty());
}

TEST(NewestWorker, OfWaitingJobsTheNewestIsDoneAndItIsBusyUntilThen) {
  std::promise<void> begun;
  std::promise<void> may_end;
  auto end = may_end.get_future();
  NewestWorker<int, int> worker(
      [&](int job) {
        if (job == 1) {
          begun.set_value();
          end.wait();
        }
        return job;
      },
      true);
  EXPECT_FALSE(worker.isBusy());
  EXPECT_FALSE(worker.start(1));
  EXPECT_TRUE(worker.isBusy()) << "1 waits or runs";
  begun.get_future().wait();
  EXPECT_TRUE(worker.isBusy()) << "1 runs";
  EXPECT_FALSE(worker.start(2)) << "nothing waited";
  EXPECT_TRUE(worker.start(3)) << "2 had not begun";
  may_end.set_value();
  worker.waitUntilIdle();
  EXPECT_FALSE(worker.isBusy());
  EXPECT_EQ(worker.take(), (std::vector<int>{1, 3}));
}

TEST(NewestWorker, EndsWithAWaitingJob) {
  std::promise<void> begun;
  std::promise<void> may_end;
  auto end = may_end.get_future();
  std::vector<int> done;
  {
    NewestWorker<int, int> worker(
        [&](int job) {
          if (job == 1) {
            begun.set_value();
            end.wait();
          }
          done.push_back(job);
          return job;
        },
        true);
    worker.start(1);
    begun.get_future().wait();
    worker.start(2);
    may_end.set_value();
  }
  ASSERT_FALSE(done.empty()) << "what is being done is waited for";
  EXPECT_EQ(done.front(), 1);
}

}  // namespace
}  // namespace datmo::newest_worker_test
