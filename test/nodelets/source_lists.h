// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "chain.h"

#include "datmo_fusion/ros/stage/stamp_check.h"

namespace datmo {

/// The lists of a scripted scanner and stereo camera for a nodelet that fuses them, and what it
/// makes of them. In: `topics`/lidar, `topics`/stereo. Out: `topics`/fused.
template <typename Message>
class SourceLists : public Listener {
 public:
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

  /// To a time of the drive (s).
  void setClock(double seconds) { Listener::setClock(ros::Time(kStart + seconds)); }

  void sendLidar(const Message& list) { lidar_.publish(list); }
  void sendStereo(const Message& list) { stereo_.publish(list); }

  /// Whether the newest fused list is of this time of the drive.
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

}  // namespace datmo
