// SPDX-License-Identifier: BSD-3-Clause
// What waits between a device's thread and another one.
#include "datmo_fusion/device/device_news.h"

#include <gtest/gtest.h>

namespace datmo::device_news_test {
namespace {

DeviceMeasured measured(double seconds) {
  DeviceMeasured news;
  news.measurement.stamp = Stamp::fromSeconds(seconds);
  return news;
}

TEST(DeviceNewsTest, OldMeasurementsAreOvertakenAndTheRestIsKept) {
  DeviceNewsQueue queue(2);
  queue.put(DeviceConnected{"one"});
  for (const double seconds : {1.0, 2.0, 3.0}) {
    queue.put(measured(seconds));
    queue.put(DeviceWarning{DeviceError("late", "too late")});
  }
  queue.put(DeviceFault{DeviceError("gone", "it is gone")});
  const DeviceNewsQueue::Taken taken = queue.takeAll();
  EXPECT_EQ(taken.overtaken, 1U);
  ASSERT_EQ(taken.news.size(), 6U);
  EXPECT_EQ(std::get<DeviceConnected>(taken.news[0]).device, "one");
  EXPECT_EQ(std::get<DeviceMeasured>(taken.news[1]).measurement.stamp, Stamp::fromSeconds(2.0));
  EXPECT_EQ(std::get<DeviceFault>(taken.news[5]).error.reason(), "gone");
  EXPECT_TRUE(queue.takeAll().news.empty());
  EXPECT_EQ(queue.takeAll().overtaken, 1U);
}

}  // namespace
}  // namespace datmo::device_news_test
