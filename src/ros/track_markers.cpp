#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <string>

#include "class_shapes.h"
#include "marker_parts.h"
#include <Eigen/Eigenvalues>

#include "datmo_fusion/common/angle.h"
#include "datmo_fusion/common/object.h"
#include "datmo_fusion/ros/markers.h"
#include "datmo_fusion/ros/message_conversion.h"

namespace datmo {

namespace {

using visualization_msgs::Marker;
using visualization_msgs::MarkerArray;

/// The ellipse that holds the true position with 95 %: quantile of chi-square with two degrees of
/// freedom.
constexpr double kEllipseGate = 5.991;

/// Opacity of a box that hardly exists, and of one that surely does.
constexpr float kFaint = 0.1F;
constexpr float kSolid = 0.7F;

constexpr float kEllipseOpacity = 0.3F;

/// m, just above the ground: not hidden by the map.
constexpr double kEllipseHeight = 0.02;

/// Neighbouring ids look different: hues a golden section apart, those of a standing track pale.
std_msgs::ColorRGBA colourOfTrack(std::uint32_t id, bool moving, float opacity) {
  constexpr double kGoldenSection = 0.618033988749895;
  const double hue = std::fmod(id * kGoldenSection, 1.0);
  const auto channel = [&](double shift) {
    const double wave = 0.5 + 0.5 * std::cos(2.0 * kPi * (hue - shift));
    return static_cast<float>(moving ? wave : 0.5 + 0.25 * wave);
  };
  return colour(channel(0.0), channel(1.0 / 3.0), channel(2.0 / 3.0), opacity);
}

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

/// "#id class speed sensors", the class only where it is known.
std::string textOf(const TrackMessage& track) {
  const ObjectClass object_class = classFromMessage(track.classification);
  const std::string known =
      object_class == ObjectClass::kUnknown ? "" : std::string(" ") + nameOf(object_class);
  std::array<char, 32> speed{};
  std::snprintf(speed.data(), speed.size(), " %.1f m/s",
                std::hypot(track.velocity.x, track.velocity.y));
  return "#" + std::to_string(track.id) + known + speed.data() + " " + namesOf(track.sensors);
}

Marker labelOf(const std_msgs::Header& header, const TrackMessage& track,
               const MarkersOptions& options) {
  Marker marker = makeMarker(header, "track labels", Marker::TEXT_VIEW_FACING);
  marker.pose.position = track.pose.position;
  marker.pose.position.y += options.text_height;  // beside the arrow, seen from above
  marker.pose.position.z = heightOf(track, options) + options.text_height;
  marker.scale.z = options.text_height;
  marker.text = textOf(track);
  return marker;
}

/// On the ground, where the position is with 95 %.
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

/// Where it was.
Marker pathOf(const std_msgs::Header& header, const TrackMessage& track,
              const MarkersOptions& options) {
  Marker marker = makeMarker(header, "track paths", Marker::LINE_STRIP);
  marker.scale.x = options.line_width;
  for (const PathPointMessage& point : track.history) {
    marker.points.push_back(pointAt(point.pose.x, point.pose.y, kEllipseHeight));
  }
  return marker;
}

void add(Marker marker, const TrackMessage& track, float opacity, MarkerArray& markers) {
  marker.id = static_cast<int>(track.id);
  marker.color = colourOfTrack(track.id, track.moving, opacity);
  markers.markers.push_back(marker);
}

/// The class as a shape, and on the ground who saw it.
void addBody(const std_msgs::Header& header, const TrackMessage& track, float opacity,
             const MarkersOptions& options, MarkerArray& markers) {
  const ObjectClass object_class = classFromMessage(track.classification);
  const ClassShape shape = shapeOf(header, "track", object_class, track.pose, track.size, options);
  add(shape.body, track, opacity, markers);
  if (shape.head) {
    add(*shape.head, track, opacity, markers);
  }
  Marker outline = outlineOf(header, "track sensors", track.pose, track.size, options);
  outline.id = static_cast<int>(track.id);
  outline.pose.position.z = kEllipseHeight;
  outline.color = colourOfSensors(track.sensors, 1.0F);
  markers.markers.push_back(outline);
}

}  // namespace

MarkerArray markersOf(const TrackArray& tracks, const MarkersOptions& options) {
  MarkerArray markers;
  const std_msgs::Header& header = tracks.header;
  for (const TrackMessage& track : tracks.tracks) {
    const float body = kFaint + (kSolid - kFaint) * track.existence_probability;
    addBody(header, track, body, options, markers);
    add(arrowOf(header, track, options), track, 1.0F, markers);
    add(labelOf(header, track, options), track, 1.0F, markers);
    add(ellipseOf(header, track, options), track, kEllipseOpacity, markers);
    if (track.history.size() > 1) {  // rviz takes a line of one point for a mistake
      add(pathOf(header, track, options), track, 1.0F, markers);
    }
  }
  return markers;
}

}  // namespace datmo
