// SPDX-License-Identifier: BSD-3-Clause
#include <memory>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "callback_poster.h"

#include <nodelet/nodelet.h>
#include <pluginlib/class_list_macros.hpp>

#include "datmo_fusion/device/datagram_listener.h"
#include "datmo_fusion/device/datagram_sender.h"
#include "datmo_fusion/device/event_queue.h"
#include "datmo_fusion/ros/parameters.h"
#include "datmo_fusion/ros/signal_wire.h"
#include "datmo_fusion/ros/stage/stage_reporter.h"
#include "datmo_fusion/ros/station_wire.h"

namespace datmo {

/// CAM and CPM of other stations by UDP to `stations`, and `stations/own` to CAM and CPM; SPATEM
/// and MAPEM with our own position in `stations/own` to `signal_advice`. What the socket's own
/// thread has is handed to the nodelet's callback queue, where the diagnostics live.
class V2xWireNodelet : public nodelet::Nodelet {
 private:
  static constexpr std::uint32_t kQueue = 20;  ///< lists, of ours and of others

  /// Datagrams that wait for the nodelet's thread at most: those of a second among 100 stations.
  static constexpr std::size_t kWaiting = 1000;

  /// From one look-up of the destination's name to the next, s: it may take some.
  static constexpr double kLookUpPause = 10.0;

  struct Datagram {
    std::string bytes;
    Stamp stamp;  ///< when it came
  };
  struct Listening {};
  using News = std::variant<Datagram, Listening, DeviceError>;

  void onInit() override {
    options_ = loadOptions<StationWireOptions>(getPrivateNodeHandle());
    monitor_ = std::make_unique<StageMonitor>(getName());
    monitor_->condition(HealthLevel::kNoOutput, "does not listen yet");
    destination_ = std::make_unique<DatagramDestination>(options_.destination,
                                                         options_.destination_port, kLookUpPause);
    wire_ = std::make_unique<StationWire>(options_, *monitor_);
    signals_ = std::make_unique<SignalWire>(options_.signals, *monitor_);
    ros::NodeHandle& node = getNodeHandle();
    stations_ = node.advertise<StationTracksMessage>("stations", kQueue);
    advice_ = node.advertise<SignalAdviceMessage>("signal_advice", kQueue);
    own_ = node.subscribe<StationTracksMessage>(
        "stations/own", kQueue, [this](const auto& tracks) { serveOwn(*tracks); }, nullptr,
        ros::TransportHints().tcpNoDelay());
    reporter_ = std::make_unique<StageReporter>(
        node, getPrivateNodeHandle(), *monitor_, std::vector<WatchedInput>(),
        StageTopics{{own_.getTopic()}, {stations_.getTopic(), advice_.getTopic()}},
        StreamOptions().silence_after);
    callbacks_ = std::make_unique<CallbackPoster>(node, [this] { serveAll(); });
    DatagramHandlers handlers;
    handlers.listening = [this] { put(Listening()); };
    handlers.received = [this](std::string_view bytes) {
      put(Datagram{std::string(bytes), toStamp(ros::Time::now())});
    };
    handlers.fault = [this](const DeviceError& error) { put(error); };
    listener_ =
        std::make_unique<DatagramListener>(DeviceAddress{options_.source, options_.port}, handlers);
  }

  void put(News news) {
    news_.put(std::move(news));
    callbacks_->post();
  }

  void serveAll() {
    const auto taken = news_.takeAll();
    monitor_->figure("datagrams discarded", static_cast<double>(taken.discarded));
    for (const News& one : taken.events) {
      std::visit([this](const auto& kind) { serve(kind); }, one);
    }
  }

  void serve(const Listening& /*news*/) {
    monitor_->condition(HealthLevel::kOk, "listens to UDP port " + std::to_string(options_.port));
  }

  void serve(const DeviceError& error) {
    monitor_->setTime(toStamp(ros::Time::now()));
    monitor_->dropped(InputError(error.reason(), error.what()));
    monitor_->condition(HealthLevel::kNoOutput, error.what());
  }

  void serve(const Datagram& datagram) {
    const Stopwatch watch;
    if (SignalWire::takes(datagram.bytes)) {
      signals_->received(datagram.bytes, datagram.stamp);
      return;
    }
    if (const StationTracksMessagePtr tracks = wire_->received(datagram.bytes, datagram.stamp)) {
      stations_.publish(tracks);
      monitor_->processed({toStamp(tracks->header.stamp), watch.seconds()});
      reporter_->publishTiming();
    }
  }

  void serveOwn(const StationTracksMessage& tracks) {
    if (const SignalAdviceMessagePtr advice = signals_->advise(tracks)) {
      advice_.publish(advice);
    }
    send(tracks);
  }

  void send(const StationTracksMessage& tracks) {
    if (options_.destination.empty()) {
      return;
    }
    try {
      for (const std::string& datagram : wire_->toSend(tracks)) {
        sent_ += destination_->send(datagram) ? 1 : 0;
      }
      monitor_->figure("datagrams sent", static_cast<double>(sent_));
    } catch (const DeviceError& error) {
      monitor_->warned(InputError(error.reason(), error.what()));
    }
  }

  StationWireOptions options_;
  std::unique_ptr<StageMonitor> monitor_;
  std::unique_ptr<StageReporter> reporter_;
  std::unique_ptr<StationWire> wire_;
  std::unique_ptr<SignalWire> signals_;
  ros::Publisher advice_;
  ros::Publisher stations_;
  ros::Subscriber own_;
  std::unique_ptr<DatagramDestination> destination_;
  std::uint64_t sent_ = 0;
  EventQueue<News, Datagram, DeviceError> news_{kWaiting};
  std::unique_ptr<CallbackPoster> callbacks_;
  std::unique_ptr<DatagramListener> listener_;  ///< its thread ends before what it calls
};

}  // namespace datmo

PLUGINLIB_EXPORT_CLASS(datmo::V2xWireNodelet, nodelet::Nodelet)
