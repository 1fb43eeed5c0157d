// SPDX-License-Identifier: BSD-3-Clause
#include <memory>
#include <string>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "callback_poster.h"

#include <nodelet/nodelet.h>
#include <pluginlib/class_list_macros.hpp>

#include "datmo_fusion/device/device_events.h"
#include "datmo_fusion/ros/convert/device_conversion.h"
#include "datmo_fusion/ros/convert/host_conversion.h"
#include "datmo_fusion/ros/convert/message_conversion.h"
#include "datmo_fusion/ros/device_diagnostics.h"
#include "datmo_fusion/ros/device_options.h"
#include "datmo_fusion/ros/parameters.h"
#include "datmo_fusion/ros/stage/stage_reporter.h"

namespace datmo {

namespace {

/// Maximum number of waiting measurements: at least a tenth of a second for scanners (10 Hz to 100
/// Hz) and receivers (kQueue), a second for a bus at 100 Hz (kCanQueue).
constexpr std::uint32_t kQueue = 10;
constexpr std::uint32_t kCanQueue = 100;

}  // namespace

/// Publishes a network device's data as messages. Output of the device's own thread is passed to
/// the nodelet's callback queue, which also handles the diagnostics.
class DeviceNodelet : public nodelet::Nodelet {
 private:
  void onInit() override {
    options_ = loadOptions<DeviceOptions>(getPrivateNodeHandle());
    monitor_ = std::make_unique<StageMonitor>(getName());
    advertise();
    reporter_ = std::make_unique<StageReporter>(
        getNodeHandle(), getPrivateNodeHandle(), *monitor_, std::vector<WatchedInput>(),
        StageTopics{{}, topics()}, options_.input.silence_after);
    diagnostics_ = std::make_unique<DeviceDiagnostics>(*monitor_);
    events_ = std::make_unique<DeviceEventQueue>(
        options_.device.kind == DeviceKind::kCan ? kCanQueue : kQueue);
    callbacks_ = std::make_unique<CallbackPoster>(getNodeHandle(), [this] { serveAll(); });
    DeviceHandlers handlers;
    handlers.connected = [this](const std::string& device) { post(DeviceConnected{device}); };
    handlers.measured = [this](DeviceMeasurement measurement, const ClockState& clock) {
      post(DeviceMeasured{std::move(measurement), clock});
    };
    handlers.fault = [this](const DeviceError& error) { post(DeviceFault{error}); };
    handlers.warning = [this](const DeviceError& error) { post(DeviceWarning{error}); };
    handlers.now = now;
    runner_ = std::make_unique<DeviceRunner>(options_.device.runner, deviceMaker(options_.device),
                                             handlers);
  }

  void advertise() {
    ros::NodeHandle& node = getNodeHandle();
    switch (options_.device.kind) {
      case DeviceKind::kHokuyo:
      case DeviceKind::kSickLms:
        output_ = node.advertise<sensor_msgs::LaserScan>("scan", kQueue);
        break;
      case DeviceKind::kVelodyne:
        output_ = node.advertise<sensor_msgs::PointCloud2>("points", kQueue);
        break;
      case DeviceKind::kNmea:
        output_ = node.advertise<sensor_msgs::NavSatFix>("gnss", kQueue);
        velocities_ = node.advertise<geometry_msgs::TwistStamped>("twist", kQueue);
        break;
      case DeviceKind::kCan:
        output_ = node.advertise<geometry_msgs::TwistStamped>("twist", kCanQueue);
        advertiseHostSensors(node, options_.device.can);
        break;
    }
  }

  /// What a bus measures of the host in addition to its motion.
  void advertiseHostSensors(ros::NodeHandle& node, const CanOptions& can) {
    if (can.publishesSteering()) {
      steering_ = node.advertise<sensor_msgs::JointState>("steering", kCanQueue);
    }
    if (!can.acceleration.empty()) {
      acceleration_ =
          node.advertise<geometry_msgs::AccelWithCovarianceStamped>("acceleration", kCanQueue);
    }
  }

  std::vector<std::string> topics() const {
    std::vector<std::string> topics;
    for (const ros::Publisher* each : {&output_, &velocities_, &steering_, &acceleration_}) {
      if (*each) {
        topics.push_back(each->getTopic());
      }
    }
    return topics;
  }

  template <typename Data>
  void publishHostSensors(const Data& /*data*/) {}
  void publishHostSensors(const VehicleTwist& twist) {
    if (twist.steering) {
      steering_.publish(toSteering(twist.steering->value, twist.steering->stamp));
    }
    if (twist.acceleration) {
      acceleration_.publish(
          toAcceleration({twist.acceleration->value, 0.0}, twist.acceleration->stamp));
    }
  }

  template <typename Data>
  const ros::Publisher& outputOf(const Data& /*data*/) const {
    return std::is_same_v<Data, GroundVelocity> ? velocities_ : output_;
  }

  static Stamp now() { return toStamp(ros::Time::now()); }

  void post(DeviceEvent event) {
    events_->put(std::move(event));
    callbacks_->post();
  }

  void serveAll() {
    const DeviceEventQueue::Taken taken = events_->takeAll();
    for (const DeviceEvent& one : taken.events) {
      std::visit([this, &taken](const auto& kind) { serve(kind, taken.discarded); }, one);
    }
  }

  void serve(const DeviceConnected& event, std::uint64_t /*discarded*/) {
    diagnostics_->connected(event.device, now());
  }

  void serve(const DeviceFault& event, std::uint64_t /*discarded*/) {
    diagnostics_->fault(event.error, now());
  }

  void serve(const DeviceWarning& event, std::uint64_t /*discarded*/) {
    diagnostics_->warning(event.error, now());
  }

  void serve(const DeviceMeasured& event, std::uint64_t discarded) {
    const Stopwatch watch;
    const Stamp stamp = event.measurement.stamp;
    diagnostics_->measured(event.measurement, event.clock, discarded, now());
    std::visit(
        [this, stamp](const auto& data) {
          outputOf(data).publish(toMessage(data, stamp, options_.frame));
          publishHostSensors(data);
        },
        event.measurement.data);
    monitor_->processed({stamp, watch.seconds()});
    reporter_->publishTiming();
  }

  DeviceOptions options_;
  std::unique_ptr<StageMonitor> monitor_;
  std::unique_ptr<StageReporter> reporter_;
  std::unique_ptr<DeviceDiagnostics> diagnostics_;
  ros::Publisher output_;
  ros::Publisher velocities_;    ///< only of a satellite receiver
  ros::Publisher steering_;      ///< only of a bus
  ros::Publisher acceleration_;  ///< the same
  std::unique_ptr<DeviceEventQueue> events_;
  std::unique_ptr<CallbackPoster> callbacks_;
  std::unique_ptr<DeviceRunner> runner_;  ///< its thread ends before the objects it calls
};

}  // namespace datmo

PLUGINLIB_EXPORT_CLASS(datmo::DeviceNodelet, nodelet::Nodelet)
