// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <boost/pointer_cast.hpp>
#include <boost/shared_ptr.hpp>

#include <ros/message_traits.h>
#include <ros/node_handle.h>

#include "datmo_fusion/common/live_options.h"
#include "datmo_fusion/common/stamp.h"
#include "datmo_fusion/ros/frame_ids.h"
#include "datmo_fusion/ros/stage/arrival_check.h"
#include "datmo_fusion/ros/stage/guard.h"
#include "datmo_fusion/ros/stage/numbered_publisher.h"
#include "datmo_fusion/ros/stage/output_check.h"
#include "datmo_fusion/ros/stage/queue_length.h"
#include "datmo_fusion/ros/stage/stage_health.h"
#include "datmo_fusion/ros/stage/stage_monitor.h"
#include "datmo_fusion/ros/subscription.h"

namespace datmo {

/// A message whose type is known only through its topic.
using AnyMessage = boost::shared_ptr<const void>;

/// One input of a stage, without the type of its messages.
struct StageInput {
  using Callback = std::function<void(const AnyMessage& message, Stamp now)>;
  using Subscribe = std::function<Subscription(ros::NodeHandle& node, StageMonitor& monitor,
                                               const Callback& callback)>;

  std::string topic;      ///< the stage's own name for it, before remapping
  std::string data_type;  ///< "sensor_msgs/LaserScan"
  std::string booked_as;  ///< input under which the monitor counts it
  bool required = true;   ///< its silence is a fault
  Callback callback;
  Subscribe subscribe;  ///< guarded; frame ids without slashes; the arrival is recorded
};

/// Resolves a stage's topic name to its name in the graph.
using ResolveTopic = std::function<std::string(const std::string& topic)>;

/// Returns the required inputs with all topics that may supply them.
std::vector<WatchedInput> watchedInputs(const std::vector<StageInput>& inputs,
                                        const ResolveTopic& resolve);

StageTopics topicsOf(const std::vector<StageInput>& inputs,
                     const std::vector<std::string>& output_topics, const ResolveTopic& resolve);

/// One output of a stage, without the type of its messages.
struct StageOutput {
  using Publish = std::function<void(const AnyMessage& message)>;

  std::string topic;  ///< the stage's own name for it, before remapping
  std::string data_type;
  std::function<Publish(ros::NodeHandle& node)> advertise;
  std::function<OutputContent(const AnyMessage& message)> content;  ///< for OutputCheck
};

/// Publishes a stage's messages on one topic; does nothing without a host.
template <typename Message>
class StagePublisher {
 public:
  StagePublisher() = default;
  explicit StagePublisher(StageOutput::Publish publish) : publish_(std::move(publish)) {}

  /// A null message is ignored.
  void publish(const boost::shared_ptr<const Message>& message) const {
    if (message && publish_) {
      publish_(message);
    }
  }

 private:
  StageOutput::Publish publish_;
};

/// A service of a stage, without the types of request and response.
struct StageService {
  std::string name;  ///< in the nodelet's private namespace
  /// `monitor` must outlive the server.
  std::function<ros::ServiceServer(ros::NodeHandle& private_node, StageMonitor& monitor)> advertise;
};

/// Where a stage declares its inputs and outputs. Its host connects them to topics (StageHost) or
/// to other stages (GraphRunner).
///
/// A host delivers the messages of one stage sequentially. Messages available at the same time are
/// delivered in the order in which their inputs were declared.
class StagePorts {
 public:
  virtual ~StagePorts() = default;

  /// Whether `now` is simulated time: /clock advances in steps, and a message may overtake one, so
  /// that times of arrival carry no information about a sensor's clock.
  virtual bool hasSimulatedTime() const { return false; }

  template <typename Message>
  using Callback = std::function<void(const boost::shared_ptr<const Message>& message, Stamp now)>;

  /// An input whose silence is a fault. `now`: ROS time.
  template <typename Message>
  void in(const std::string& topic, Callback<Message> callback) {
    addInput(inputOf<Message>(topic, topic, true, std::move(callback)));
  }

  /// An input that may be silent.
  template <typename Message>
  void optionalIn(const std::string& topic, Callback<Message> callback) {
    addInput(inputOf<Message>(topic, topic, false, std::move(callback)));
  }

  /// An input whose messages may come instead of those of another input.
  template <typename Message>
  void inInsteadOf(const std::string& other, const std::string& topic, Callback<Message> callback) {
    addInput(inputOf<Message>(topic, other, false, std::move(callback)));
  }

  /// `latched`: late subscribers get the last message.
  template <typename Message>
  StagePublisher<Message> out(const std::string& topic, bool latched = false) {
    const auto advertise = [topic, latched](ros::NodeHandle& node) -> StageOutput::Publish {
      const std::uint32_t queue = latched ? 1 : queueLength<Message>();
      const auto publisher =
          std::make_shared<NumberedPublisher>(node.advertise<Message>(topic, queue, latched));
      return [publisher](const AnyMessage& any) {
        publisher->publish(boost::const_pointer_cast<Message>(typed<Message>(any)));
      };
    };
    const auto content = [](const AnyMessage& any) { return contentOf(*typed<Message>(any)); };
    return StagePublisher<Message>(
        addOutput({topic, ros::message_traits::datatype<Message>(), advertise, content}));
  }

  /// A service, if there is a ROS master. If `answer` throws, the call fails (guarded()).
  template <typename Service>
  void service(const std::string& name,
               std::function<typename Service::Response(const typename Service::Request&)> answer) {
    const auto advertise = [name, answer = std::move(answer)](ros::NodeHandle& private_node,
                                                              StageMonitor& monitor) {
      const boost::function<bool(typename Service::Request&, typename Service::Response&)> call =
          [name, answer, &monitor](auto& request, auto& response) {
            bool answered = false;
            guarded(monitor, name, [&] {
              response = answer(request);
              answered = true;
            });
            return answered;
          };
      return private_node.advertiseService(name, call);
    };
    addService({name, advertise});
  }

 protected:
  virtual void addInput(StageInput input) = 0;
  virtual StageOutput::Publish addOutput(StageOutput output) = 0;
  virtual void addService(StageService /*service*/) {}

 private:
  template <typename Message>
  static boost::shared_ptr<const Message> typed(const AnyMessage& message) {
    return boost::static_pointer_cast<const Message>(message);
  }

  template <typename Message>
  static OutputContent contentOf(const Message& message) {
    OutputContent content{std::nullopt, contentFault(message)};
    if (const ros::Time* stamp = ros::message_traits::timeStamp(message)) {
      content.stamp = toStamp(*stamp);
    }
    return content;
  }

  template <typename Message>
  static StageInput inputOf(const std::string& topic, const std::string& booked_as, bool required,
                            Callback<Message> callback) {
    const auto subscribe = [topic, booked_as](ros::NodeHandle& node, StageMonitor& monitor,
                                              const StageInput::Callback& callback_any) {
      const auto check = std::make_shared<ArrivalCheck>(topic, maxWaitInQueue<Message>(), monitor);
      const auto event_callback = [booked_as, &monitor, callback_any,
                                   check](const ros::MessageEvent<const Message>& event) {
        const auto message = receive(booked_as, event.getConstMessage(), monitor);
        if (check->passes(arrivedOf(event), ros::Time::now())) {
          callback_any(message, toStamp(ros::Time::now()));
        }
      };
      const auto note = [check](const DecodeError& error) {
        check->noteUndecodable(error.publisher, error.sequence);
      };
      return Subscription::toEvents<Message>(node, topic, queueLength<Message>(), monitor,
                                             event_callback, note);
    };
    return {topic,
            ros::message_traits::datatype<Message>(),
            booked_as,
            required,
            [callback](const AnyMessage& message, Stamp now) {
              callback(typed<Message>(message), now);
            },
            subscribe};
  }
};

/// A part of the chain from sensors to tracks: declares its inputs and outputs once, and runs both
/// live, as a nodelet, and on a bag.
class Stage {
 public:
  virtual ~Stage() = default;

  /// Declares inputs and outputs. Called once, before the first message.
  virtual void connect(StagePorts& ports) = 0;

  /// Publishes the next result that is ready; returns false if there is none. Called until then
  /// after each message and each change of tf and, if `maxWait` says so, periodically.
  virtual bool publishNext(Stamp /*now*/) { return false; }

  /// Returns the options that may be changed at run time, with their current values.
  virtual std::vector<LiveOption> live() const { return {}; }

  /// Changes some of these for subsequent output, without a reset. Throws OptionError and leaves
  /// all unchanged.
  virtual void change(const OptionValues& values) {
    detail::setLive(values, [](OptionVisitor& /*visitor*/) {});
  }

  /// s; how long a message may wait for others.
  virtual double maxWait() const { return 0.0; }
};

}  // namespace datmo
