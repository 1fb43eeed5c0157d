// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <string>

#include "class_shapes.h"
#include "marker_parts.h"
#include "track_colors.h"
#include "track_label.h"
#include <Eigen/Eigenvalues>

#include "datmo_fusion/common/object.h"
#include "datmo_fusion/ros/convert/message_conversion.h"
#include "datmo_fusion/ros/display/track_style.h"
#include "datmo_fusion/ros/stage/stamp_check.h"

namespace datmo {

namespace {

using visualization_msgs::Marker;
using visualization_msgs::MarkerArray;

/// The 95 % ellipse of the position: quantile of chi-square with two degrees of freedom.
constexpr double kEllipseGate = 5.991;

/// Opacity of a track with low existence, and of a certain one.
constexpr float kFaint = 0.1F;
constexpr float kSolid = 0.9F;

constexpr float kEllipseOpacity = 0.3F;

/// m, just above the ground, so that the map does not hide it.
constexpr double kEllipseHeight = 0.02;

double heightOf(const TrackMessage& track, const MarkersOptions& options) {
  return track.size.z > 0.0 ? track.size.z : options.default_height;
}

Marker arrowOf(const std_msgs::Header& header, const TrackMessage& track,
               const MarkersOptions& options) {
  Marker marker = makeMarker(header, "track velocities", Marker::ARROW);
  marker.scale.x = 2.0 * options.line_width;  // shaft
  marker.scale.y = 5.0 * options.line_width;  // head
  const geometry_msgs::Point& from = track.pose.position;
  const double z = heightOf(track, options);
  marker.points = {pointAt(from.x, from.y, z),
                   pointAt(from.x + track.velocity.x * options.arrow_time,
                           from.y + track.velocity.y * options.arrow_time, z)};
  return marker;
}

/// High enough above the box not to cover it when seen from up to 45 degrees above the ground, for
/// any heading of the box.
Marker labelOf(const std_msgs::Header& header, const TrackMessage& track,
               const MarkersOptions& options) {
  Marker marker = makeMarker(header, "track labels", Marker::TEXT_VIEW_FACING);
  marker.pose.position = track.pose.position;
  const double to_end = 0.5 * std::max({track.size.x, track.size.y, options.min_size});
  marker.pose.position.z = heightOf(track, options) + to_end + 0.5 * options.text_height;
  marker.scale.z = options.text_height;
  marker.text = labelText(track);
  return marker;
}

/// The 95 % ellipse of the position, on the ground.
Marker ellipseOf(const std_msgs::Header& header, const TrackMessage& track,
                 const MarkersOptions& options) {
  Eigen::Matrix2d covariance;
  covariance << track.covariance[0], track.covariance[1],  //
      track.covariance[kTrackState], track.covariance[kTrackState + 1];
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> solver;
  solver.computeDirect(covariance);
  const auto diameter = [&](int axis) {
    const double variance = std::max(solver.eigenvalues()[axis], 0.0);
    return std::max(2.0 * std::sqrt(kEllipseGate * variance), options.line_width);
  };
  const Eigen::Vector2d major = solver.eigenvectors().col(1);
  Marker marker = makeMarker(header, "track covariances", Marker::CYLINDER);
  marker.pose = toMessage(
      Pose2(track.pose.position.x, track.pose.position.y, std::atan2(major.y(), major.x())));
  marker.pose.position.z = kEllipseHeight;
  marker.scale.x = diameter(1);
  marker.scale.y = diameter(0);
  marker.scale.z = kEllipseHeight;
  return marker;
}

/// Its recent path.
Marker pathOf(const std_msgs::Header& header, const TrackMessage& track,
              const MarkersOptions& options) {
  Marker marker = makeMarker(header, "track paths", Marker::LINE_STRIP);
  marker.scale.x = options.line_width;
  for (const PathPointMessage& point : track.history) {
    if (secondsBetween(toStamp(point.stamp), toStamp(header.stamp)) <= options.path_time) {
      marker.points.push_back(pointAt(point.pose.x, point.pose.y, kEllipseHeight));
    }
  }
  return marker;
}

void add(Marker marker, const TrackMessage& track, const std_msgs::ColorRGBA& color,
         MarkerArray& markers) {
  marker.id = static_cast<int>(track.id);
  marker.color = color;
  markers.markers.push_back(marker);
}

Marker groundOutline(const std_msgs::Header& header, const std::string& name,
                     const TrackMessage& track, const MarkersOptions& options) {
  Marker outline = outlineOf(header, name, track.pose, track.size, options);
  outline.pose.position.z = kEllipseHeight;
  return outline;
}

/// The class as a shape or mesh.
ClassShape bodyOf(const std_msgs::Header& header, const TrackMessage& track,
                  const TrackStyle& style) {
  const ObjectClass object_class = classFromMessage(track.classification);
  if (style.shape == TrackShape::kMesh) {
    if (auto mesh = meshOf(header, "track", object_class, track.pose, track.size, style.sizes)) {
      return {*mesh, std::nullopt};
    }
  }
  return shapeOf(header, "track", object_class, track.pose, track.size, style.sizes);
}

/// The body, and on the ground its outline, and one in the color of the sensors.
void addBody(const std_msgs::Header& header, const TrackMessage& track, const TrackStyle& style,
             MarkerArray& markers) {
  const MarkersOptions& options = style.sizes;
  const ClassShape shape = bodyOf(header, track, style);
  const float opacity =
      style.fade_by_existence ? kFaint + (kSolid - kFaint) * track.existence_probability : kSolid;
  const std_msgs::ColorRGBA paint = colorOf(track, style.color_by, opacity);
  add(shape.body, track, paint, markers);
  if (shape.head) {
    add(*shape.head, track, paint, markers);
  }
  add(groundOutline(header, "track outlines", track, options), track, inkOf(track, style.color_by),
      markers);
  add(groundOutline(header, "track sensors", track, options), track,
      colorOfSensors(track.sensors, 1.0F), markers);
}

void addTrack(const std_msgs::Header& header, const TrackMessage& track, const TrackStyle& style,
              MarkerArray& markers) {
  const std_msgs::ColorRGBA ink = inkOf(track, style.color_by);
  addBody(header, track, style, markers);
  if (track.moving) {
    add(arrowOf(header, track, style.sizes), track, ink, markers);
  }
  add(labelOf(header, track, style.sizes), track, ink, markers);
  add(ellipseOf(header, track, style.sizes), track, colorOf(track, style.color_by, kEllipseOpacity),
      markers);
  const Marker path = pathOf(header, track, style.sizes);
  if (path.points.size() > 1) {  // rviz reports a line of one point as an error
    add(path, track, ink, markers);
  }
}

}  // namespace

MarkerArray markersOf(const TrackArray& tracks, const TrackStyle& style) {
  MarkerArray markers;
  for (const TrackMessage& track : tracks.tracks) {
    if (track.existence_probability >= style.min_existence) {
      addTrack(tracks.header, track, style, markers);
    }
  }
  return markers;
}

MarkerArray markersOf(const TrackArray& tracks, const MarkersOptions& options) {
  TrackStyle style;
  style.sizes = options;
  return markersOf(tracks, style);
}

}  // namespace datmo
