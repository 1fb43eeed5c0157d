// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <deque>
#include <memory>
#include <mutex>
#include <string>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include <boost/make_shared.hpp>

#include <nodelet/nodelet.h>
#include <pluginlib/class_list_macros.hpp>
#include <ros/callback_queue_interface.h>

#include "datmo_fusion/ros/convert/device_conversion.h"
#include "datmo_fusion/ros/convert/message_conversion.h"
#include "datmo_fusion/ros/device_diagnostics.h"
#include "datmo_fusion/ros/device_options.h"
#include "datmo_fusion/ros/parameters.h"
#include "datmo_fusion/ros/stage/stage_reporter.h"

namespace datmo {

namespace {

constexpr std::uint32_t kQueue = 10;  ///< measurements, a quarter of a second or more

}  // namespace

/// A device on the network as messages. What the device's own thread says is handed to the
/// nodelet's callback queue, where the diagnostics live, too.
class DeviceNodelet : public nodelet::Nodelet {
 public:
  /// The device's thread ends before what it calls, and what it has rung for is not served any
  /// more.
  ~DeviceNodelet() override {
    runner_.reset();
    if (monitor_) {
      getNodeHandle().getCallbackQueue()->removeByID(ownId());
    }
  }

 private:
  struct Connected {
    std::string device;
  };
  struct Fault {
    DeviceError error;
  };
  struct Warning {
    DeviceError error;
  };
  struct Measured {
    DeviceMeasurement measurement;
    ClockState clock;
  };
  using News = std::variant<Connected, Fault, Warning, Measured>;

  /// Serves the news in the nodelet's queue.
  class Bell : public ros::CallbackInterface {
   public:
    explicit Bell(DeviceNodelet& nodelet) : nodelet_(nodelet) {}
    CallResult call() override {
      nodelet_.serveAll();
      return Success;
    }

   private:
    DeviceNodelet& nodelet_;
  };

  void onInit() override {
    options_ = loadOptions<DeviceOptions>(getPrivateNodeHandle());
    monitor_ = std::make_unique<StageMonitor>(getName());
    advertise();
    reporter_ = std::make_unique<StageReporter>(
        getNodeHandle(), getPrivateNodeHandle(), *monitor_, std::vector<WatchedInput>(),
        StageTopics{{}, topics()}, options_.input.silence_after);
    diagnostics_ = std::make_unique<DeviceDiagnostics>(*monitor_);
    DeviceHandlers handlers;
    handlers.connected = [this](const std::string& device) { ring(Connected{device}); };
    handlers.measured = [this](DeviceMeasurement measurement, const ClockState& clock) {
      ring(Measured{std::move(measurement), clock});
    };
    handlers.fault = [this](const DeviceError& error) { ring(Fault{error}); };
    handlers.warning = [this](const DeviceError& error) { ring(Warning{error}); };
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
    }
  }

  std::vector<std::string> topics() const {
    return velocities_ ? std::vector<std::string>{output_.getTopic(), velocities_.getTopic()}
                       : std::vector<std::string>{output_.getTopic()};
  }

  template <typename Data>
  const ros::Publisher& outputOf(const Data& /*data*/) const {
    return std::is_same_v<Data, GroundVelocity> ? velocities_ : output_;
  }

  static Stamp now() { return toStamp(ros::Time::now()); }

  std::uint64_t ownId() const { return reinterpret_cast<std::uint64_t>(this); }

  void ring(News news) {
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      news_.push_back(std::move(news));
      // Reports on the connection are rare, and kept.
      overtaken_ += keepNewest<Measured>();
      keepNewest<Warning>();
    }
    getNodeHandle().getCallbackQueue()->addCallback(boost::make_shared<Bell>(*this), ownId());
  }

  /// Returns how many were left out: none or one.
  template <typename Kind>
  std::uint64_t keepNewest() {
    const auto is_such = [](const News& one) { return std::holds_alternative<Kind>(one); };
    if (std::count_if(news_.begin(), news_.end(), is_such) <= kQueue) {
      return 0;
    }
    news_.erase(std::find_if(news_.begin(), news_.end(), is_such));
    return 1;
  }

  void serveAll() {
    std::deque<News> news;
    std::uint64_t overtaken = 0;
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      news.swap(news_);
      overtaken = overtaken_;
    }
    for (const News& one : news) {
      std::visit([this, overtaken](const auto& kind) { serve(kind, overtaken); }, one);
    }
  }

  void serve(const Connected& news, std::uint64_t /*overtaken*/) {
    diagnostics_->connected(news.device, now());
  }

  void serve(const Fault& news, std::uint64_t /*overtaken*/) {
    diagnostics_->fault(news.error, now());
  }

  void serve(const Warning& news, std::uint64_t /*overtaken*/) {
    diagnostics_->warning(news.error, now());
  }

  void serve(const Measured& news, std::uint64_t overtaken) {
    const Stopwatch watch;
    const Stamp stamp = news.measurement.stamp;
    diagnostics_->measured(news.measurement, news.clock, overtaken, now());
    std::visit(
        [this, stamp](const auto& data) {
          outputOf(data).publish(toMessage(data, stamp, options_.frame));
        },
        news.measurement.data);
    monitor_->processed({stamp, watch.seconds()});
    reporter_->publishTiming();
  }

  DeviceOptions options_;
  std::unique_ptr<StageMonitor> monitor_;
  std::unique_ptr<StageReporter> reporter_;
  std::unique_ptr<DeviceDiagnostics> diagnostics_;
  ros::Publisher output_;
  ros::Publisher velocities_;  ///< of a satellite receiver alone
  std::mutex mutex_;
  std::deque<News> news_;
  std::uint64_t overtaken_ = 0;  ///< measurements that waited too long
  std::unique_ptr<DeviceRunner> runner_;
};

}  // namespace datmo

PLUGINLIB_EXPORT_CLASS(datmo::DeviceNodelet, nodelet::Nodelet)
