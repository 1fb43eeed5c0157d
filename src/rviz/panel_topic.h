// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <QString>
#include <cstdint>
#include <string>

#include "display_status.h"
#include <boost/function.hpp>
#include <boost/shared_ptr.hpp>
#include <rviz/config.h>

#include <ros/message_traits.h>
#include <ros/node_handle.h>

namespace datmo {

constexpr std::uint32_t kPanelQueue = 10;

/// A panel's subscription to a topic that its configuration file names. The file may be edited by
/// hand: a name that cannot be subscribed must not end rviz.
template <typename Message>
class PanelTopic {
 public:
  using Callback = boost::function<void(const boost::shared_ptr<const Message>&)>;

  /// `key`: in the configuration file. `usual`: the topic if the file has none.
  PanelTopic(const char* key, const char* usual) : key_(key), usual_(usual), name_(usual) {}

  void load(const rviz::Config& config) { config.mapGetString(key_, &name_); }
  void save(rviz::Config config) const { config.mapSetValue(key_, name_); }

  void unsubscribe() { subscriber_.shutdown(); }

  /// Subscribes to the loaded topic only, or reports in fault() why it cannot be subscribed.
  void subscribe(ros::NodeHandle& node, const Callback& callback) {
    subscriber_.shutdown();
    refusal_.clear();
    if (name_.isEmpty()) {
      refusal_ = "no topic" + remedy();
      return;
    }
    try {
      subscriber_ = node.subscribe<Message>(name_.toStdString(), kPanelQueue, callback);
    } catch (const ros::Exception& error) {
      refusal_ = "cannot subscribe to '" + name_.toStdString() + "': " + error.what() + remedy();
    }
  }

  /// Returns why no messages can come, and what to do, in words; empty: nothing known. Queries the
  /// master if no publisher is connected.
  std::string fault() const {
    if (!refusal_.empty() || !subscriber_ || subscriber_.getNumPublishers() > 0) {
      return refusal_;
    }
    const std::string expected = ros::message_traits::datatype<Message>();
    const std::string other = otherType(subscriber_.getTopic(), expected);
    if (other.empty()) {
      return "";
    }
    return subscriber_.getTopic() + " is " + other + ": expected " + expected + remedy();
  }

 private:
  std::string remedy() const {
    return std::string("; set '") + key_ +
           "' of this panel in the rviz configuration to a topic such as " + usual_;
  }

  const char* key_;
  const char* usual_;
  QString name_;
  ros::Subscriber subscriber_;
  std::string refusal_;  ///< why it is not subscribed; empty: it is
};

}  // namespace datmo
