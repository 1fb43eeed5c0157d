// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>

#include "marker_parts.h"
#include "track_colors.h"

#include "datmo_fusion/risk/object_futures.h"
#include "datmo_fusion/ros/convert/message_conversion.h"
#include "datmo_fusion/ros/display/track_style.h"
#include "datmo_fusion/tracking/track_check.h"

namespace datmo {

namespace {

using visualization_msgs::Marker;
using visualization_msgs::MarkerArray;

/// m, just above the ground and above other lines on it.
constexpr double kPredictionHeight = 0.04;

/// Opacity of the path of a mode that is certain.
constexpr float kCertain = 0.8F;

/// m; a path that ends closer to its start is not drawn: rviz reports it as an error.
constexpr double kShortest = 0.05;

Marker pathOf(const std_msgs::Header& header, const BodyPath& path, double line_width) {
  Marker marker = makeMarker(header, "track predictions", Marker::LINE_STRIP);
  marker.scale.x = line_width;
  for (const BodyPose& pose : path.poses) {
    marker.points.push_back(pointAt(pose.center.x(), pose.center.y(), kPredictionHeight));
  }
  return marker;
}

}  // namespace

MarkerArray predictionsOf(const TrackArray& message, const TrackStyle& style) {
  const TrackList list = fromMessage(message);
  const ObjectFutureOptions options;
  HorizonOptions horizon;
  horizon.horizon = style.prediction_time;
  const RandomDraws draws(0);  // not used without noise
  MarkerArray markers;
  for (std::size_t i = 0; i < list.tracks.size(); ++i) {
    const Track& track = list.tracks[i];
    if (!isValid(track) || track.existence_probability < style.min_existence) {
      continue;
    }
    const ObjectFutures futures(track, std::nullopt, options, horizon, draws);
    for (int mode = 0; mode < kMotionModes; ++mode) {
      const double share = track.mode_probabilities[static_cast<std::size_t>(mode)];
      if (share < style.min_mode) {
        continue;
      }
      const BodyPath path = futures.nominalPath(static_cast<MotionMode>(mode));
      if ((path.poses.back().center - path.poses.front().center).norm() < kShortest) {
        continue;
      }
      Marker marker = pathOf(message.header, path, style.sizes.line_width);
      marker.id = static_cast<int>(track.id * kMotionModes + static_cast<unsigned>(mode));
      marker.color = inkOf(message.tracks[i], style.color_by);
      marker.color.a = kCertain * static_cast<float>(share);
      markers.markers.push_back(marker);
    }
  }
  return markers;
}

}  // namespace datmo
