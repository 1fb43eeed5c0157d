// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "chain.h"
#include <gtest/gtest.h>

#include "datmo_fusion/ros/stage/stamp_check.h"

namespace datmo {

/// The lists of a scripted scanner and stereo camera for a nodelet that fuses them, and its output.
/// In: `topics`/lidar, `topics`/stereo. Out: `topics`/fused.
template <typename Message>
class SourceLists : public Listener {
 public:
  using List = Message;

  static constexpr double kStart = 1000.0;     // s, stamp of the start of the drive
  static constexpr double kStep = 1.0 / 16.0;  // s

  SourceLists(const std::string& topics, std::string nodelet)
      : nodelet_(std::move(nodelet)),
        fused_(node_.subscribe<Message>(
            topics + "/fused", kQueue,
            [this](const MessagePtr& message) { fused.push_back(message); })),
        lidar_(node_.advertise<Message>(topics + "/lidar", kQueue)),
        stereo_(node_.advertise<Message>(topics + "/stereo", kQueue)) {}

  bool waitForNodelet() {
    setClock(-kStep);
    return waitFor([this] {
      return lidar_.getNumSubscribers() >= 1 && stereo_.getNumSubscribers() >= 1 &&
             fused_.getNumPublishers() >= 1 && !diagnosticMessage().empty();
    });
  }

  /// Sets the clock to a time of the drive (s).
  void setClock(double seconds) { Listener::setClock(ros::Time(kStart + seconds)); }

  void sendLidar(const Message& list) { lidar_.publish(list); }
  void sendStereo(const Message& list) { stereo_.publish(list); }

  /// Returns whether the newest fused list is of this time of the drive.
  bool isAt(double seconds) const {
    return !fused.empty() &&
           toStamp(fused.back()->header.stamp) == Stamp::fromSeconds(kStart + seconds);
  }

  double diagnostic(const std::string& key) const { return Listener::diagnostic(nodelet_, key); }
  std::string diagnosticMessage() const { return Listener::diagnosticMessage(nodelet_); }

  bool waitForCount(const std::string& key, double count) {
    return waitFor([&] { return diagnostic(key) == count; });
  }

  using MessagePtr = boost::shared_ptr<const Message>;
  std::vector<MessagePtr> fused;

 private:
  static constexpr std::uint32_t kQueue = 1000;

  ros::NodeHandle node_;
  std::string nodelet_;
  ros::Subscriber fused_;
  ros::Publisher lidar_;
  ros::Publisher stereo_;
};

/// Tests that run through one drive in their order. `Lists`: a SourceLists with listOf(sensor,
/// seconds), a sensor's list at a time of the drive, and startStep(seconds), which starts a step.
template <typename Lists>
class SourceListsTest : public testing::Test {
 protected:
  using Message = typename Lists::List;
  using Sensors = std::vector<std::string>;

  static constexpr double kStart = Lists::kStart;
  static constexpr double kStep = Lists::kStep;
  static constexpr double kStereoLater = 0.02;  // s

  static void SetUpTestSuite() {
    lists_ = new Lists();
    ASSERT_TRUE(lists_->waitForNodelet());
  }

  static void TearDownTestSuite() { delete lists_; }

  /// Runs one step of the drive with both sensors; waits for its fused list.
  static void step() { step(Lists::listOf("stereo", now_ + kStereoLater)); }
  static void step(const Message& stereo) {
    sendLidarStep();
    lists_->sendStereo(stereo);
    ASSERT_TRUE(lists_->waitFor([] { return lists_->isAt(now_); }))
        << now_ << " s: " << lists_->diagnosticMessage();
    now_ += kStep;
  }

  /// Runs the step without stereo.
  static void sendLidarStep() {
    lists_->startStep(now_);
    lists_->sendLidar(Lists::listOf("lidar", now_));
  }

  static void driveOn(int steps) {
    for (int i = 0; i < steps; ++i) {
      ASSERT_NO_FATAL_FAILURE(step());
    }
  }

  static const Message& last() { return *lists_->fused.back(); }

  static Lists* lists_;
  static double now_;  // s, of the drive
};

template <typename Lists>
Lists* SourceListsTest<Lists>::lists_ = nullptr;
template <typename Lists>
double SourceListsTest<Lists>::now_ = 0.0;

}  // namespace datmo
