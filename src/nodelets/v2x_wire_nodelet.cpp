// SPDX-License-Identifier: BSD-3-Clause
#include <memory>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include <nodelet/nodelet.h>
#include <pluginlib/class_list_macros.hpp>

#include "datmo_fusion/device/datagram_listener.h"
#include "datmo_fusion/device/event_queue.h"
#include "datmo_fusion/ros/callback_poster.h"
#include "datmo_fusion/ros/parameters.h"
#include "datmo_fusion/ros/stage/guard.h"
#include "datmo_fusion/ros/stage/stage_reporter.h"
#include "datmo_fusion/ros/subscription.h"
#include "datmo_fusion/ros/v2x_wire.h"

namespace datmo {

/// Converts CAM and CPM of other stations received by UDP to `stations`, `stations/own` to CAM and
/// CPM, and SPATEM and MAPEM with our own position in `stations/own` to `signal_advice` (V2xWire).
/// Data from the socket's own thread is passed to the nodelet's callback queue, which also handles
/// the diagnostics.
class V2xWireNodelet : public nodelet::Nodelet {
 private:
  static constexpr std::uint32_t kQueue = 20;  ///< lists, ours and others'

  /// Maximum number of datagrams that wait for the nodelet's thread: one second with 100 stations.
  static constexpr std::size_t kWaiting = 1000;

  struct Datagram {
    std::string bytes;
    Stamp stamp;  ///< time of arrival
  };
  struct Listening {};
  using News = std::variant<Datagram, Listening, DeviceError>;

  void onInit() override {
    const auto options = loadOptions<StationWireOptions>(getPrivateNodeHandle());
    monitor_ = std::make_unique<StageMonitor>(getName());
    wire_ = std::make_unique<V2xWire>(options, *monitor_);
    ros::NodeHandle& node = getNodeHandle();
    stations_ = node.advertise<StationTracksMessage>("stations", kQueue);
    advice_ = node.advertise<SignalAdviceMessage>("signal_advice", kQueue);
    own_ =
        Subscription::to(node, "stations/own", kQueue, *monitor_, &V2xWireNodelet::serveOwn, this);
    reporter_ = std::make_unique<StageReporter>(
        node, getPrivateNodeHandle(), *monitor_, std::vector<WatchedInput>(),
        StageTopics{{own_.topic()}, {stations_.getTopic(), advice_.getTopic()}},
        StreamOptions().silence_after);
    callbacks_ = std::make_unique<CallbackPoster>(*node.getCallbackQueue(), [this] { serveAll(); });
    DatagramHandlers handlers;
    handlers.listening = [this] { put(Listening()); };
    handlers.received = [this](std::string_view bytes) {
      put(Datagram{std::string(bytes), toStamp(ros::Time::now())});
    };
    handlers.fault = [this](const DeviceError& error) { put(error); };
    listener_ =
        std::make_unique<DatagramListener>(DeviceAddress{options.source, options.port}, handlers);
  }

  void put(News news) {
    news_.put(std::move(news));
    callbacks_->post();
  }

  void serveAll() {
    const auto taken = news_.takeAll();
    monitor_->figure("datagrams discarded", static_cast<double>(taken.discarded));
    for (const News& one : taken.events) {
      guarded(*monitor_, "the UDP port",
              [&] { std::visit([this](const auto& kind) { serve(kind); }, one); });
    }
  }

  void serve(const Listening& /*news*/) { wire_->listening(); }

  void serve(const DeviceError& error) { wire_->failed(error, toStamp(ros::Time::now())); }

  void serve(const Datagram& datagram) {
    if (const StationTracksMessagePtr tracks = wire_->received(datagram.bytes, datagram.stamp)) {
      stations_.publish(tracks);
      reporter_->publishTiming();
    }
  }

  void serveOwn(const boost::shared_ptr<const StationTracksMessage>& tracks) {
    if (const SignalAdviceMessagePtr advice = wire_->serveOwn(*tracks)) {
      advice_.publish(advice);
    }
  }

  std::unique_ptr<StageMonitor> monitor_;
  std::unique_ptr<StageReporter> reporter_;
  std::unique_ptr<V2xWire> wire_;
  ros::Publisher advice_;
  ros::Publisher stations_;
  Subscription own_;
  EventQueue<News, Datagram, DeviceError> news_{kWaiting};
  std::unique_ptr<CallbackPoster> callbacks_;
  std::unique_ptr<DatagramListener> listener_;  ///< its thread ends before the objects it calls
};

}  // namespace datmo

PLUGINLIB_EXPORT_CLASS(datmo::V2xWireNodelet, nodelet::Nodelet)
