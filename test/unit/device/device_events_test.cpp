// SPDX-License-Identifier: BSD-3-Clause
// The queue between a device's thread and another one.
#include "datmo_fusion/device/device_events.h"

#include <gtest/gtest.h>

namespace datmo::device_events_test {
namespace {

DeviceMeasured measured(double seconds) {
  DeviceMeasured event;
  event.measurement.stamp = Stamp::fromSeconds(seconds);
  return event;
}

TEST(DeviceEventsTest, OldMeasurementsAreDiscardedAndTheRestIsKept) {
  DeviceEventQueue queue(2);
  queue.put(DeviceConnected{"one"});
  for (const double seconds : {1.0, 2.0, 3.0}) {
    queue.put(measured(seconds));
    queue.put(DeviceWarning{DeviceError("late", "too late")});
  }
  queue.put(DeviceFault{DeviceError("gone", "it is gone")});
  const DeviceEventQueue::Taken taken = queue.takeAll();
  EXPECT_EQ(taken.discarded, 1U);
  ASSERT_EQ(taken.events.size(), 6U);
  EXPECT_EQ(std::get<DeviceConnected>(taken.events[0]).device, "one");
  EXPECT_EQ(std::get<DeviceMeasured>(taken.events[1]).measurement.stamp, Stamp::fromSeconds(2.0));
  EXPECT_EQ(std::get<DeviceFault>(taken.events[5]).error.reason(), "gone");
  EXPECT_TRUE(queue.takeAll().events.empty());
  EXPECT_EQ(queue.takeAll().discarded, 1U);
}

}  // namespace
}  // namespace datmo::device_events_test
