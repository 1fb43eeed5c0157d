// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <exception>
#include <functional>
#include <memory>
#include <string>
#include <utility>

#include <boost/make_shared.hpp>

#include <ros/message_event.h>
#include <ros/message_traits.h>
#include <ros/node_handle.h>
#include <ros/subscription_callback_helper.h>

#include "datmo_fusion/ros/bounded_stream.h"
#include "datmo_fusion/ros/decode_errors.h"
#include "datmo_fusion/ros/stage/arrival_check.h"
#include "datmo_fusion/ros/stage/guard.h"
#include "datmo_fusion/ros/stage/stage_monitor.h"

namespace datmo {

/// Decodes received messages with a BoundedStream, where roscpp takes memory for as many elements
/// as a corrupt length states. Messages of the same process are not decoded at all.
///
/// It may outlive its subscription: others of the process decode with it, in threads of their own.
template <typename Message>
class BoundedDecoder
    : public ros::SubscriptionCallbackHelperT<const ros::MessageEvent<const Message>&> {
 public:
  using Base = ros::SubscriptionCallbackHelperT<const ros::MessageEvent<const Message>&>;

  /// `topic`: resolved.
  BoundedDecoder(std::string topic, const typename Base::Callback& callback)
      : Base(callback), topic_{std::move(topic), ros::message_traits::datatype<Message>()} {}

  /// Returns null for corrupt bytes, for which roscpp calls no callback, and reports to
  /// DecodeErrors.
  ros::VoidConstPtr deserialize(
      const ros::SubscriptionCallbackHelperDeserializeParams& params) override {
    const auto message = boost::make_shared<Message>();
    try {
      BoundedStream stream(params.buffer, params.length);
      stream.next(*message);
      return message;
    } catch (const std::exception& error) {
      // The header comes first, so its number is known unless that is what is cut off.
      DecodeErrors::report(topic_, {publisherIn(params), sequenceOf(*message), error.what()});
      return {};
    }
  }

 private:
  /// As ros::MessageEvent names it. Only reads the header, which threads share.
  static std::string publisherIn(const ros::SubscriptionCallbackHelperDeserializeParams& params) {
    if (params.connection_header == nullptr) {
      return "unknown_publisher";
    }
    const auto found = params.connection_header->find("callerid");
    return found == params.connection_header->end() ? "" : found->second;
  }

  InputTopic topic_;
};

/// A subscriber in which one bad message is one message: its bytes are decoded within bounds, a
/// corrupt one is counted (`undecodable_message`), and no exception leaves the callback
/// (guarded()).
///
/// A subscriber of other code to the same topic in the same process, if it is the first one there,
/// decodes for all of them, by the rules of roscpp: corrupt messages are then only lost.
class Subscription {
 public:
  template <typename Message>
  using Callback = std::function<void(const boost::shared_ptr<const Message>& message)>;
  template <typename Message>
  using EventCallback = std::function<void(const ros::MessageEvent<const Message>& event)>;

  /// Subscribes to nothing.
  Subscription() = default;

  /// Subscribes to a topic; `queue`: maximum number of waiting messages. `callback` is called with
  /// each message, in the callback queue of `node`, which must call one callback at a time.
  /// `monitor` must outlive the subscription.
  template <typename Message>
  static Subscription to(ros::NodeHandle& node, const std::string& topic, std::uint32_t queue,
                         StageMonitor& monitor, const Callback<Message>& callback) {
    return toEvents<Message>(node, topic, queue, monitor,
                             [callback](const ros::MessageEvent<const Message>& event) {
                               callback(event.getConstMessage());
                             });
  }

  /// The same with a member function of `owner`.
  template <typename Message, typename Owner>
  static Subscription to(ros::NodeHandle& node, const std::string& topic, std::uint32_t queue,
                         StageMonitor& monitor,
                         void (Owner::*callback)(const boost::shared_ptr<const Message>&),
                         Owner* owner) {
    return to<Message>(
        node, topic, queue, monitor,
        Callback<Message>([owner, callback](const auto& message) { (owner->*callback)(message); }));
  }

  /// The same with what roscpp knows of each message. `note` is called with each corrupt
  /// one, before the next message, in addition to the report to the monitor.
  template <typename Message>
  static Subscription toEvents(
      ros::NodeHandle& node, const std::string& topic, std::uint32_t queue, StageMonitor& monitor,
      const EventCallback<Message>& callback,
      const DecodeErrors::Callback& note = [](const auto&) {}) {
    const InputTopic resolved{node.resolveName(topic), ros::message_traits::datatype<Message>()};
    // Runs in the callback queue of `node`, as all that uses the monitor: it needs no lock.
    const auto count = [resolved, &monitor, note](const DecodeError& error) {
      guarded(monitor, resolved.topic, [&] {
        note(error);
        monitor.dropped(
            undecodable(resolved.topic + " from " + error.publisher, resolved.data_type, error.why),
            error.count);
      });
    };
    Subscription made;
    made.state_ = std::make_unique<State>(*node.getCallbackQueue(), resolved, count);
    const auto call = std::make_shared<const EventCallback<Message>>(
        [topic, &monitor, callback,
         &errors = made.state_->errors](const ros::MessageEvent<const Message>& event) {
          guarded(monitor, topic, [&] {
            errors.deliver();
            callback(event);
          });
        });
    made.state_->callback = call;
    // Called only while the subscriber of this state exists. The decoder, which may exist longer,
    // must not own what the callback captures: a publisher must end before the queue of its node.
    const auto forward = [&owned = *call](const ros::MessageEvent<const Message>& event) {
      owned(event);
    };
    ros::SubscribeOptions options(topic, queue, ros::message_traits::md5sum<Message>(),
                                  resolved.data_type);
    options.helper = boost::make_shared<BoundedDecoder<Message>>(resolved.topic, forward);
    // The first subscriber to a topic determines the transport for its whole process.
    options.transport_hints = ros::TransportHints().tcpNoDelay();
    made.state_->subscriber = node.subscribe(options);
    return made;
  }

  /// Whether it is subscribed to a topic.
  explicit operator bool() const { return state_ != nullptr; }

  /// The resolved name; empty if it subscribes to nothing.
  std::string topic() const { return state_ == nullptr ? "" : state_->subscriber.getTopic(); }

 private:
  struct State {
    State(ros::CallbackQueueInterface& queue, const InputTopic& topic,
          const DecodeErrors::Callback& count)
        : errors(queue, topic, count) {}

    DecodeErrors errors;
    std::shared_ptr<const void> callback;  ///< what the decoder calls
    ros::Subscriber subscriber;            ///< last: ends before what its callback uses
  };

  std::unique_ptr<State> state_;
};

}  // namespace datmo
