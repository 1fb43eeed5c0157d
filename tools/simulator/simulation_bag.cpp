// SPDX-License-Identifier: BSD-3-Clause
#include "simulator/simulation_bag.h"

#include <algorithm>
#include <map>
#include <optional>
#include <utility>

#include "output_bag.h"
#include "simulator/feature_flow.h"
#include "simulator/simulation_messages.h"
#include "simulator/stereo_messages.h"
#include "simulator/vehicle_sensors.h"
#include <tf2_msgs/TFMessage.h>

#include "datmo_fusion/ros/convert/host_conversion.h"
#include "datmo_fusion/ros/convert/message_conversion.h"
#include "datmo_fusion/ros/convert/velocity_conversion.h"
#include "datmo_fusion/ros/stage/stamp_check.h"
#include "datmo_fusion/ros/transform_topics.h"

namespace datmo::simulator {

namespace {

/// s of ROS time at the start; well above 0, which means "no time" in ROS.
constexpr double kEpoch = 1000.0;

/// A sensor that measures at a rate and records its measurements. To add a sensor, add a class that
/// measures a World with a random stream of its own name, and a source.
struct Source {
  double rate = 1.0;                            ///< Hz
  std::function<void(double time, Stamp)> run;  ///< `time` in s since the start
  int runs = 0;                                 ///< so far

  double nextTime() const { return runs / rate; }
};

/// Holds the sensors of a run and the bag to which they write.
class Recording {
 public:
  Recording(const Scene& scene, OutputBag& bag)
      : scene_(scene),
        bag_(bag),
        map_in_world_(scene.world.at(0.0).base),
        scanner_(scene.options.scanner, stream("scanner")),
        odometer_(scene.options.odometer, stream("odometer")),
        vehicle_sensors_(scene.options.vehicle_sensors, stream("vehicle_sensors")) {
    if (scene.options.stereo.enabled) {
      const auto seed = static_cast<std::uint64_t>(scene.options.seed);
      stereo_.emplace(scene.options.stereo, seed);
      if (scene.options.stereo.features) {
        features_.emplace(scene.options.stereo, seed);
      }
    }
    if (scene.options.mono.enabled) {
      mono_.emplace(scene.options.mono, stream("mono"));
    }
  }

  void recordMounts() {
    const Viewpoint view = scanner_.viewpoint();
    const Stamp start = Stamp::fromSeconds(kEpoch);
    tf2_msgs::TFMessage message;
    message.transforms.push_back(toTransform(view.sensor_in_base, start, "base_link", view.sensor));
    message.transforms.back().transform.translation.z = view.height;
    if (stereo_) {
      message.transforms.push_back(toMount(scene_.options.stereo, start));
    }
    bag_.writeLatched(kStaticTransformTopic, toTime(start), message);
  }

  void recordContact() {
    if (scene_.contact) {
      const Stamp stamp = Stamp::fromSeconds(kEpoch + scene_.contact->time);
      write("/ground_truth/contact", stamp, toTrueContact(*scene_.contact, stamp));
    }
  }

  /// In the order in which measurements of the same time are recorded.
  std::vector<Source> sources() {
    std::vector<Source> sources{{scene_.options.odometer.rate,
                                 [this](double time, Stamp stamp) { recordOdometry(time, stamp); }},
                                {scene_.options.scanner.scan_rate,
                                 [this](double time, Stamp stamp) { recordScan(time, stamp); }}};
    if (scene_.options.vehicle_sensors.enabled) {
      sources.push_back({scene_.options.vehicle_sensors.rate,
                         [this](double time, Stamp stamp) { recordHostSensors(time, stamp); }});
    }
    if (stereo_) {
      sources.push_back({scene_.options.stereo.rate,
                         [this](double time, Stamp stamp) { recordStereo(time, stamp); }});
    }
    if (mono_) {
      sources.push_back({scene_.options.mono.rate,
                         [this](double time, Stamp stamp) { recordMono(time, stamp); }});
    }
    return sources;
  }

 private:
  RandomStream stream(const std::string& sensor) const {
    return {static_cast<std::uint64_t>(scene_.options.seed), sensor};
  }

  template <typename Message>
  void write(const std::string& topic, Stamp stamp, const Message& message) {
    bag_.write(topic, toTime(stamp), message);
  }

  void recordOdometry(double time, Stamp stamp) {
    const Odometry odometry = odometer_.measure(scene_.world.at(time));
    tf2_msgs::TFMessage transform;
    transform.transforms.push_back(toTransform(odometry.pose.pose, stamp, "odom", "base_link"));
    write("/odometry", stamp, toMessage(odometry, stamp));
    write(kTransformTopic, stamp, transform);
  }

  void recordHostSensors(double time, Stamp stamp) {
    const HostMeasurement measured = vehicle_sensors_.measure(scene_.world.at(time));
    const double noise = scene_.options.vehicle_sensors.acceleration_noise;
    write("/steering", stamp, *toSteering(measured.steering, stamp));
    write("/acceleration", stamp, *toAcceleration({measured.acceleration, noise * noise}, stamp));
  }

  void recordScan(double time, Stamp stamp) {
    const EchoScan scan = scanner_.measure(scene_.world, time);
    const WorldState state = scene_.world.at(time);
    const Stamp last_beam = stamp + scene_.options.scanner.sweep_duration;
    if (scene_.options.scanner.echoes == 1) {
      write("/scan", last_beam, toLaserScan(scan, scene_.options.scanner, stamp));
    } else {
      write("/echoes", last_beam, toMultiEchoScan(scan, scene_.options.scanner, stamp));
    }
    recordTruth(state, scan, stamp);
  }

  void recordTruth(const WorldState& state, const EchoScan& scan, Stamp stamp) {
    std::vector<Viewpoint> views{scanner_.viewpoint()};
    if (stereo_) {
      views.push_back(stereo_->viewpoint());
    }
    if (mono_) {
      views.push_back(mono_->viewpoint());
    }
    const auto objects =
        objectTruths(scene_.world, state, scan, views, scene_.options.ground_truth);
    write("/ground_truth/pose", stamp, toTruePose(state, map_in_world_, stamp));
    write("/ground_truth/objects", stamp, toMessage(objects, map_in_world_, stamp));
    write("/ground_truth/road_borders", stamp,
          toTrueBorders(scene_.world.roads(), state, map_in_world_, stamp));
    if (scene_.options.ground_truth.echoes) {
      write("/ground_truth/echoes", stamp, toTrueEchoes(scan, stamp));
    }
  }

  void recordStereo(double time, Stamp exposure) {
    const StereoPoints points = stereo_->measure(scene_.world, time);
    const Stamp stamp = exposure + scene_.options.stereo.stamp_error;
    const Stamp ready = stamp + scene_.options.stereo.latency;
    write("/stereo/left/camera_info", ready, toLeftInfo(scene_.options.stereo, stamp));
    write("/stereo/right/camera_info", ready, toRightInfo(scene_.options.stereo, stamp));
    if (features_) {
      bag_.write("/stereo/point_velocities", toTime(ready),
                 *toMessage(features_->measure(scene_.world, time), stamp, "base_link"));
    }
    write("/stereo/points2", ready, toCloud(points, stamp));
  }

  void recordMono(double time, Stamp stamp) {
    ObjectList list = mono_->measure(scene_.world, time);
    list.stamp = stamp;
    bag_.write("/objects/mono", toTime(stamp + scene_.options.mono.latency),
               datmo::toMessage(list, "base_link"));
  }

  const Scene& scene_;
  OutputBag& bag_;
  Pose2 map_in_world_;
  LaserScanner scanner_;
  Odometer odometer_;
  VehicleSensors vehicle_sensors_;
  std::optional<StereoCamera> stereo_;
  std::optional<FeatureFlow> features_;
  std::optional<ClassCamera> mono_;
};

rosbag::CompressionType compressionType(const std::string& name) {
  static const std::map<std::string, rosbag::CompressionType> types{
      {"none", rosbag::compression::Uncompressed},
      {"bz2", rosbag::compression::BZ2},
      {"lz4", rosbag::compression::LZ4}};
  return types.at(name);
}

}  // namespace

bool writeSimulationBag(const Scene& scene, const std::string& file, const Progress& progress) {
  OutputBag bag(file, compressionType(scene.options.compression));
  Recording recording(scene, bag);
  recording.recordMounts();
  std::vector<Source> sources = recording.sources();
  const double end = scene.contact ? scene.contact->time : scene.options.duration;
  while (true) {
    Source& next = *std::min_element(
        sources.begin(), sources.end(),
        [](const Source& a, const Source& b) { return a.nextTime() < b.nextTime(); });
    const double time = next.nextTime();
    if (time >= end) {
      break;
    }
    if (!progress(time)) {
      return false;
    }
    next.run(time, Stamp::fromSeconds(kEpoch + time));
    ++next.runs;
  }
  recording.recordContact();
  bag.finish();
  return true;
}

}  // namespace datmo::simulator
