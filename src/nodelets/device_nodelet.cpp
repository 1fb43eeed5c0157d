// SPDX-License-Identifier: BSD-3-Clause
#include <memory>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include <nodelet/nodelet.h>
#include <pluginlib/class_list_macros.hpp>

#include "datmo_fusion/device/device_events.h"
#include "datmo_fusion/ros/callback_poster.h"
#include "datmo_fusion/ros/convert/message_conversion.h"
#include "datmo_fusion/ros/device_diagnostics.h"
#include "datmo_fusion/ros/device_options.h"
#include "datmo_fusion/ros/device_output.h"
#include "datmo_fusion/ros/parameters.h"
#include "datmo_fusion/ros/stage/guard.h"
#include "datmo_fusion/ros/stage/stage_reporter.h"

namespace datmo {

/// Publishes a network device's data as messages. Output of the device's own thread is passed to
/// the nodelet's callback queue, which also handles the diagnostics.
class DeviceNodelet : public nodelet::Nodelet {
 private:
  void onInit() override {
    options_ = loadOptions<DeviceOptions>(getPrivateNodeHandle());
    monitor_ = std::make_unique<StageMonitor>(getName());
    output_ = std::make_unique<DeviceOutput>(getNodeHandle(), options_);
    reporter_ = std::make_unique<StageReporter>(
        getNodeHandle(), getPrivateNodeHandle(), *monitor_, std::vector<WatchedInput>(),
        StageTopics{{}, output_->topics()}, options_.input.silence_after);
    diagnostics_ = std::make_unique<DeviceDiagnostics>(*monitor_);
    events_ = std::make_unique<DeviceEventQueue>(DeviceOutput::queueSize(options_.device.kind));
    callbacks_ = std::make_unique<CallbackPoster>(*getNodeHandle().getCallbackQueue(),
                                                  [this] { serveAll(); });
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

  static Stamp now() { return toStamp(ros::Time::now()); }

  void post(DeviceEvent event) {
    events_->put(std::move(event));
    callbacks_->post();
  }

  void serveAll() {
    const DeviceEventQueue::Taken taken = events_->takeAll();
    for (const DeviceEvent& one : taken.events) {
      guarded(*monitor_, "device", [&] {
        std::visit([this, &taken](const auto& kind) { serve(kind, taken.discarded); }, one);
      });
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
    diagnostics_->measured(event.measurement, event.clock, discarded, now());
    output_->publish(event.measurement);
    monitor_->processed({event.measurement.stamp, watch.seconds()});
    reporter_->publishTiming();
  }

  DeviceOptions options_;
  std::unique_ptr<StageMonitor> monitor_;
  std::unique_ptr<StageReporter> reporter_;
  std::unique_ptr<DeviceDiagnostics> diagnostics_;
  std::unique_ptr<DeviceOutput> output_;
  std::unique_ptr<DeviceEventQueue> events_;
  std::unique_ptr<CallbackPoster> callbacks_;
  std::unique_ptr<DeviceRunner> runner_;  ///< its thread ends before the objects it calls
};

}  // namespace datmo

PLUGINLIB_EXPORT_CLASS(datmo::DeviceNodelet, nodelet::Nodelet)
