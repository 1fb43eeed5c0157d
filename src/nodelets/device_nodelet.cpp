// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <atomic>
#include <deque>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <utility>

#include <boost/make_shared.hpp>

#include <nodelet/nodelet.h>
#include <pluginlib/class_list_macros.hpp>
#include <ros/callback_queue_interface.h>
#include <sensor_msgs/LaserScan.h>

#include "datmo_fusion/ros/device_options.h"
#include "datmo_fusion/ros/parameters.h"
#include "datmo_fusion/ros/stage/stage_reporter.h"

namespace datmo {

namespace {

constexpr std::uint32_t kQueue = 10;  ///< scans, a quarter of a second

sensor_msgs::LaserScanPtr toMessage(const ScipModel& model, const DeviceScan& scan,
                                    const std::string& frame) {
  constexpr float kMillimeter = 1e-3F;  // m
  auto message = boost::make_shared<sensor_msgs::LaserScan>();
  message->header.stamp = toTime(scan.stamp);
  message->header.frame_id = frame;
  message->angle_min = static_cast<float>(model.firstBearing());
  message->angle_increment = static_cast<float>(model.beamSpacing());
  message->angle_max = static_cast<float>(
      model.firstBearing() + model.beamSpacing() * static_cast<double>(scan.ranges.size() - 1));
  message->time_increment = static_cast<float>(model.beamTime());
  message->scan_time = static_cast<float>(model.scanTime());
  message->range_min = static_cast<float>(model.min_range) * kMillimeter;
  message->range_max = static_cast<float>(model.max_range) * kMillimeter;
  message->ranges = scan.ranges;
  return message;
}

}  // namespace

/// A scanner on the network as scans on the topic `scan`. What the device's own thread says is
/// handed to the nodelet's callback queue, where the diagnostics live, too.
class DeviceNodelet : public nodelet::Nodelet {
 public:
  /// The device's thread ends before what it calls, and what it has rung for is not served any
  /// more.
  ~DeviceNodelet() override {
    scanner_.reset();
    if (monitor_) {
      getNodeHandle().getCallbackQueue()->removeByID(ownId());
    }
  }

 private:
  /// What has come from the device: a scan, a fault, or that it is connected.
  struct News {
    std::optional<ScipModel> model;
    std::optional<DeviceScan> scan;
    std::optional<DeviceError> fault;
  };

  /// Serves the news in the nodelet's queue.
  class Bell : public ros::CallbackInterface {
   public:
    explicit Bell(DeviceNodelet& nodelet) : nodelet_(nodelet) {}
    CallResult call() override {
      nodelet_.serve();
      return Success;
    }

   private:
    DeviceNodelet& nodelet_;
  };

  void onInit() override {
    options_ = loadOptions<DeviceOptions>(getPrivateNodeHandle());
    monitor_ = std::make_unique<StageMonitor>(getName());
    scans_ = getNodeHandle().advertise<sensor_msgs::LaserScan>("scan", kQueue);
    reporter_ = std::make_unique<StageReporter>(
        getNodeHandle(), getPrivateNodeHandle(), *monitor_, std::vector<WatchedInput>(),
        StageTopics{{}, {scans_.getTopic()}}, options_.input.silence_after);
    monitor_->condition(HealthLevel::kNothing, "not connected yet");
    DeviceHandlers handlers;
    handlers.connected = [this](const ScipModel& model) { ring({model, {}, {}}); };
    handlers.scan = [this](const ScipModel& model, DeviceScan scan) {
      ring({model, std::move(scan), {}});
    };
    handlers.fault = [this](const DeviceError& error) { ring({{}, {}, error}); };
    handlers.now = [] { return toStamp(ros::Time::now()); };
    scanner_ = std::make_unique<HokuyoScanner>(options_.hokuyo, handlers);
  }

  std::uint64_t ownId() const { return reinterpret_cast<std::uint64_t>(this); }

  void ring(News news) {
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      news_.push_back(std::move(news));
      // Reports on the connection are rare, and kept.
      const auto is_scan = [](const News& one) { return one.scan.has_value(); };
      if (static_cast<std::size_t>(std::count_if(news_.begin(), news_.end(), is_scan)) > kQueue) {
        news_.erase(std::find_if(news_.begin(), news_.end(), is_scan));
        ++overtaken_;
      }
    }
    getNodeHandle().getCallbackQueue()->addCallback(boost::make_shared<Bell>(*this), ownId());
  }

  void serve() {
    std::deque<News> news;
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      news.swap(news_);
    }
    for (const News& one : news) {
      if (one.fault) {
        takeFault(*one.fault);
      } else if (one.scan) {
        takeScan(*one.model, *one.scan);
      } else if (one.model) {
        takeConnection(*one.model);
      }
    }
  }

  void takeFault(const DeviceError& fault) {
    monitor_->setTime(toStamp(ros::Time::now()));
    monitor_->dropped(InputError(fault.reason(), fault.what()));
    monitor_->condition(HealthLevel::kNothing, fault.what());
  }

  void takeConnection(const ScipModel& model) {
    monitor_->setTime(toStamp(ros::Time::now()));
    monitor_->figure("connections", static_cast<double>(++connections_));
    first_offset_.reset();
    monitor_->condition(HealthLevel::kGood, "connected with " + model.name + ", " +
                                                std::to_string(model.beams()) + " beams, at " +
                                                options_.hokuyo.address);
  }

  void takeScan(const ScipModel& model, const DeviceScan& scan) {
    const Stopwatch watch;
    monitor_->received("scan", toStamp(ros::Time::now()));
    missed_ += scan.missed;
    if (scan.missed > 0) {
      monitor_->warned(InputError("missed_scans", std::to_string(scan.missed) +
                                                      " scans are missing before this one: "
                                                      "expected one each " +
                                                      std::to_string(model.scanTime()) + " s"));
    }
    if (scan.clock_steps > clock_steps_) {
      monitor_->warned(InputError(
          "clock_step", "the device's clock or the computer's was set: stamps begin anew"));
    }
    clock_steps_ = scan.clock_steps;
    monitor_->figure("scans missed", static_cast<double>(missed_));
    monitor_->figure("scans overtaken", static_cast<double>(overtaken_));
    monitor_->figure("rate [Hz]", monitor_->input("scan", toStamp(ros::Time::now())).rate);
    // The device's clock begins anywhere: what it gains or loses is what tells something.
    first_offset_ = first_offset_.value_or(scan.clock_offset);
    monitor_->figure("clock offset since connected [ms]",
                     kMilliseconds * (scan.clock_offset - *first_offset_));
    monitor_->figure("clock drift [ppm]", scan.clock_drift * kPartsPerMillion);
    monitor_->figure("clock steps", static_cast<double>(clock_steps_));
    scans_.publish(toMessage(model, scan, options_.frame));
    monitor_->processed({scan.stamp, watch.seconds()});
    reporter_->publishTiming();
  }

  static constexpr double kPartsPerMillion = 1e6;
  static constexpr double kMilliseconds = 1e3;

  DeviceOptions options_;
  std::unique_ptr<StageMonitor> monitor_;
  std::unique_ptr<StageReporter> reporter_;
  ros::Publisher scans_;
  std::mutex mutex_;
  std::deque<News> news_;
  std::atomic<std::uint64_t> overtaken_{0};  ///< that waited too long
  std::uint64_t connections_ = 0;
  std::uint64_t missed_ = 0;
  std::uint64_t clock_steps_ = 0;
  std::optional<double> first_offset_;  ///< s, of this connection
  std::unique_ptr<HokuyoScanner> scanner_;
};

}  // namespace datmo

PLUGINLIB_EXPORT_CLASS(datmo::DeviceNodelet, nodelet::Nodelet)
