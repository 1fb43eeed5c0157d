// SPDX-License-Identifier: BSD-3-Clause
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "live_server.h"

#include <nodelet/nodelet.h>
#include <pluginlib/class_list_macros.hpp>

#include "datmo_fusion/ros/display/legend.h"
#include "datmo_fusion/ros/display/markers.h"
#include "datmo_fusion/ros/display/meshes.h"
#include "datmo_fusion/ros/display/risk_style.h"
#include "datmo_fusion/ros/parameters.h"
#include "datmo_fusion/ros/stage/guard.h"
#include "datmo_fusion/ros/subscription.h"

namespace datmo {

/// Publishes markers for rviz. In: labeled_scan, road_borders, objects, objects/dropped, tracks,
/// risks, ground_truth/objects. Out: markers and host_vehicle, while there are subscribers; legend,
/// once.
class MarkersNodelet : public nodelet::Nodelet {
 private:
  void onInit() override {
    monitor_ = std::make_unique<StageMonitor>(getName());
    options_ = loadOptions<MarkersOptions>(getPrivateNodeHandle());
    live_ = std::make_unique<LiveServer>(
        getPrivateNodeHandle(), *monitor_, [this] { return liveOptions(options_); },
        [this](const OptionValues& values) { options_ = withLiveValues(options_, values); });
    ros::NodeHandle& node = getNodeHandle();
    markers_ = node.advertise<visualization_msgs::MarkerArray>("markers", kQueue);
    host_ = node.advertise<visualization_msgs::Marker>("host_vehicle", 1);
    legend_ = node.advertise<sensor_msgs::Image>("legend", 1, true);
    legend_.publish(drawLegend());
    subscribe("labeled_scan", &MarkersNodelet::handleLabeledScan);
    subscribe("road_borders", &MarkersNodelet::handleBorders);
    subscribe("objects", &MarkersNodelet::handleObjects);
    subscribe("objects/dropped", &MarkersNodelet::handleDropped);
    subscribe("tracks", &MarkersNodelet::handleTracks);
    subscribe("risks", &MarkersNodelet::handleRisks);
    subscribe("ground_truth/objects", &MarkersNodelet::handleTruth);
  }

  template <typename Message>
  void subscribe(const std::string& topic,
                 void (MarkersNodelet::*take)(const boost::shared_ptr<const Message>&)) {
    subscriptions_.push_back(
        Subscription::to(getNodeHandle(), topic, kQueue, *monitor_, take, this));
  }

  void handleLabeledScan(const LabeledScanConstPtr& message) {
    last_scan_ = message;
    draw("labeled_scan", *message);
    publishGuarded("vehicle", [&] { return vehicleMarkers(message->header, options_.vehicle); });
    if (host_.getNumSubscribers() > 0) {
      guarded(*monitor_, "host_vehicle",
              [&] { host_.publish(hostMesh(message->header, options_.vehicle)); });
    }
  }

  void handleBorders(const RoadBordersConstPtr& message) { draw("road_borders", *message); }
  void handleObjects(const ObjectArrayConstPtr& message) { draw("objects", *message); }
  void handleDropped(const DroppedObjectsConstPtr& message) { draw("objects/dropped", *message); }
  void handleTracks(const TrackArrayConstPtr& message) { draw("tracks", *message); }
  void handleTruth(const TrueObjectArrayConstPtr& message) { draw("truth", *message); }

  void handleRisks(const RiskArrayConstPtr& message) {
    publishGuarded("risks", [&] { return markersOf(*message, RiskStyle()); });
  }

  template <typename Message>
  void draw(const std::string& source, const Message& message) {
    publishGuarded(source, [&] {
      visualization_msgs::MarkerArray markers = markersOf(message, options_);
      transformToFrame(message, markers);
      return markers;
    });
  }

  /// `make`: creates the markers of a source; called only if there are subscribers. If it fails,
  /// the other markers of the same message are drawn all the same.
  template <typename Make>
  void publishGuarded(const std::string& source, const Make& make) {
    if (markers_.getNumSubscribers() > 0) {
      guarded(*monitor_, source, [&] {
        visualization_msgs::MarkerArray markers = make();
        stale_.replace(source, markers);
        markers_.publish(markers);
      });
    }
  }

  /// Objects of the last scan are transformed by the scan's pose, which tf may not have yet.
  void transformToFrame(const std_msgs::Header& header,
                        visualization_msgs::MarkerArray& markers) const {
    if (last_scan_ && last_scan_->header.stamp == header.stamp) {
      transformToMap(*last_scan_, markers);
    }
  }

  void transformToFrame(const ObjectArray& objects,
                        visualization_msgs::MarkerArray& markers) const {
    transformToFrame(objects.header, markers);
  }

  void transformToFrame(const DroppedObjects& dropped,
                        visualization_msgs::MarkerArray& markers) const {
    transformToFrame(dropped.header, markers);
  }

  /// An intersection is drawn at the vehicle's position.
  void transformToFrame(const RoadBorders& road, visualization_msgs::MarkerArray& markers) const {
    if (last_scan_) {
      addIntersection(road, *last_scan_, options_, markers);
    }
  }

  /// All others keep their frame.
  template <typename Message>
  void transformToFrame(const Message& /*message*/,
                        visualization_msgs::MarkerArray& /*markers*/) const {}

  /// A second of messages: bounded, but enough for short delays.
  static constexpr std::uint32_t kQueue = 20;

  std::unique_ptr<StageMonitor> monitor_;
  MarkersOptions options_;
  std::unique_ptr<LiveServer> live_;
  StaleMarkers stale_;
  LabeledScanConstPtr last_scan_;
  ros::Publisher markers_;
  ros::Publisher host_;
  ros::Publisher legend_;
  std::vector<Subscription> subscriptions_;
};

}  // namespace datmo

PLUGINLIB_EXPORT_CLASS(datmo::MarkersNodelet, nodelet::Nodelet)
