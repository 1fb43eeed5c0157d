// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <set>
#include <string>
#include <utility>

#include <visualization_msgs/MarkerArray.h>

#include "datmo_fusion/common/options.h"
#include "datmo_fusion/ros/convert/messages.h"
#include "datmo_fusion/ros/shared_keys.h"

namespace datmo {

/// Dimensions of the vehicle's own body, in the frame of the scans (base_link).
struct VehicleBodyOptions {
  double length = 4.6;         ///< m
  double width = 1.85;         ///< m
  double rear_overhang = 0.9;  ///< m
  double height = 1.5;         ///< m

  void visit(OptionVisitor& visitor);
};

struct MarkersOptions {
  double point_size = 0.3;      ///< m
  double line_width = 0.12;     ///< m
  double text_height = 1.1;     ///< m
  double min_size = 0.3;        ///< m
  double default_height = 1.5;  ///< m
  double arrow_time = 1.0;      ///< s
  double path_time = 3.0;       ///< s
  VehicleBodyOptions vehicle;

  void visit(OptionVisitor& visitor);
  static SharedKeys sharedKeys();
};

/// Convert messages to rviz markers. Each kind of marker has its own namespace, and ids stay with
/// what they represent; the frame is the message's own unless stated otherwise.

/// The end points of a scan ("scan"), colored by state, in the map frame of the pose they were
/// observed from.
visualization_msgs::MarkerArray markersOf(const LabeledScanMessage& scan,
                                          const MarkersOptions& options);

/// The vehicle's own body ("vehicle"): a car of boxes and wheels that moves with the frame of the
/// scan.
visualization_msgs::MarkerArray vehicleMarkers(const std_msgs::Header& scan,
                                               const VehicleBodyOptions& options);

/// Outlines of the objects' boxes ("objects"), colored by sensor: violet lidar, cyan stereo, yellow
/// both, gray others; pale unless moving. If the class is known, also its shape ("object bodies",
/// "object heads"): a box for a vehicle, a cylinder with a head for a pedestrian, a narrow box with
/// a head for a cyclist, a thin cylinder for a pole.
visualization_msgs::MarkerArray markersOf(const ObjectArray& objects,
                                          const MarkersOptions& options);

/// For each track, in separate namespaces: the shape of its class in the color of the class ("track
/// bodies", "track heads"), a box if the class is unknown, pale if stationary, more transparent the
/// less likely the track exists; its outline on the ground ("track outlines"), and one in the color
/// of the sensors that saw it last ("track sensors"); an arrow as long as the distance covered in
/// `arrow_time` ("track velocities"); above it "#id class speed", the speed only if moving ("track
/// labels"); the 95 % ellipse of its position on the ground ("track covariances"); its path in the
/// last `path_time` ("track paths").
visualization_msgs::MarkerArray markersOf(const TrackArray& tracks, const MarkersOptions& options);

/// For each section of the road's borders a line ("road borders"), orange on the left, pink on the
/// right, darker for a side street, wider and less transparent the likelier it is, and thin lines
/// at two standard deviations to its sides ("road border sigmas"). Throws InputError like
/// fromMessage.
visualization_msgs::MarkerArray markersOf(const RoadBorders& road, const MarkersOptions& options);

/// "intersection" and its probability ("intersection"), at the vehicle's position at the scan;
/// empty if the vehicle is not at one. Throws InputError (`bad_pose`).
void addIntersection(const RoadBorders& road, const LabeledScanMessage& scan,
                     const MarkersOptions& options, visualization_msgs::MarkerArray& markers);

/// For dropped objects: a gray outline ("dropped objects"), the reason, how far it reaches beyond
/// the border, and the evidence of its motion ("dropped labels").
visualization_msgs::MarkerArray markersOf(const DroppedObjects& dropped,
                                          const MarkersOptions& options);

/// Dashed gray outlines of the moving ground-truth objects ("ground truth"), the thinnest of all.
visualization_msgs::MarkerArray markersOf(const TrueObjectArray& objects,
                                          const MarkersOptions& options);

/// Transforms markers from the vehicle's frame to the map by the pose of the scan they were made
/// from. Throws InputError (`bad_pose`).
void transformToMap(const LabeledScanMessage& scan, visualization_msgs::MarkerArray& markers);

/// Remembers what is drawn and deletes markers that have become obsolete.
class StaleMarkers {
 public:
  /// Appends a DELETE for each marker of the last call with this `source` that is not drawn again.
  void replace(const std::string& source, visualization_msgs::MarkerArray& markers);

 private:
  using Key = std::pair<std::string, int>;  ///< namespace and id
  std::map<std::string, std::set<Key>> drawn_;
};

}  // namespace datmo
