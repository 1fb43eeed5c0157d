// SPDX-License-Identifier: BSD-3-Clause
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <string>

#include "marker_parts.h"

#include "datmo_fusion/ros/display/marker_colors.h"
#include "datmo_fusion/ros/display/risk_style.h"

namespace datmo {

namespace {

using visualization_msgs::Marker;
using visualization_msgs::MarkerArray;

/// m, just above the map and below other lines on it.
constexpr double kTubeHeight = 0.015;
constexpr double kContactHeight = 0.06;

constexpr float kTubeOpacity = 0.35F;
constexpr float kContactOpacity = 0.8F;

/// m, diameter of the disc of a certain contact, and the minimum share of it for a less likely one.
constexpr double kContactSize = 2.5;
constexpr double kMinContactShare = 0.35;

/// m above ground: text of a contact, and text of the level, above the host.
constexpr double kContactLabel = 2.5;
constexpr double kLevelLabel = 4.0;

/// Relative text height of the level's reason, which is a whole sentence.
constexpr double kSentence = 0.6;

/// s; used if the message has no predicted path of the host.
constexpr double kDefaultHorizon = 4.0;

double horizonOf(const RiskArray& risks) {
  const auto steps = static_cast<double>(risks.host_path.size());
  const double horizon = (steps - 1.0) * static_cast<double>(risks.host_path_step);
  return horizon > 0.0 ? horizon : kDefaultHorizon;
}

/// Left (1) or right (-1) edge of the host's outline, at its center moved forward by `ahead` (m).
geometry_msgs::Point edgeOf(const geometry_msgs::Pose2D& pose, double ahead, double left) {
  return pointAt(pose.x + ahead * std::cos(pose.theta) - left * std::sin(pose.theta),
                 pose.y + ahead * std::sin(pose.theta) + left * std::cos(pose.theta), kTubeHeight);
}

/// Strips swept by the front bumper from step to step.
Marker tubeOf(const RiskArray& risks) {
  Marker marker = makeMarker(risks.header, "host tube", Marker::TRIANGLE_LIST);
  marker.scale.x = marker.scale.y = marker.scale.z = 1.0;
  const double ahead = 0.5 * static_cast<double>(risks.host_length);
  const double half = 0.5 * static_cast<double>(risks.host_width);
  const double horizon = horizonOf(risks);
  for (std::size_t i = 0; i + 1 < risks.host_path.size(); ++i) {
    const double time = static_cast<double>(i) * static_cast<double>(risks.host_path_step);
    const std_msgs::ColorRGBA paint = colorOfTime(time, horizon, kTubeOpacity);
    const auto right = edgeOf(risks.host_path[i], ahead, -half);
    const auto left = edgeOf(risks.host_path[i], ahead, half);
    const auto next_right = edgeOf(risks.host_path[i + 1], ahead, -half);
    const auto next_left = edgeOf(risks.host_path[i + 1], ahead, half);
    for (const auto& point : {right, next_right, next_left, right, next_left, left}) {
      marker.points.push_back(point);
      marker.colors.push_back(paint);
    }
  }
  marker.color = color(1.0F, 1.0F, 1.0F, kTubeOpacity);
  return marker;
}

std::string textOf(const RiskMessage& risk) {
  std::array<char, 64> text{};
  std::snprintf(text.data(), text.size(), "%.1f s %.0f %% %.0f m/s",
                static_cast<double>(risk.median_ttc),
                100.0 * static_cast<double>(risk.contact_probability.back()),
                static_cast<double>(risk.strike_speed));
  return text.data();
}

void addContact(const RiskArray& risks, const RiskMessage& risk, const RiskStyle& style,
                MarkerArray& markers) {
  const auto probability = static_cast<double>(risk.contact_probability.back());
  const std_msgs::ColorRGBA paint =
      colorOfTime(static_cast<double>(risk.median_ttc), horizonOf(risks), kContactOpacity);
  Marker disc = makeMarker(risks.header, "contacts", Marker::CYLINDER);
  disc.id = static_cast<int>(risk.id);
  disc.pose.position = pointAt(risk.contact.x, risk.contact.y, kContactHeight);
  disc.scale.x = disc.scale.y =
      kContactSize * (kMinContactShare + (1.0 - kMinContactShare) * probability);
  disc.scale.z = kTubeHeight;
  disc.color = paint;
  markers.markers.push_back(disc);
  Marker label = makeMarker(risks.header, "contact labels", Marker::TEXT_VIEW_FACING);
  label.id = disc.id;
  label.pose.position = pointAt(risk.contact.x, risk.contact.y, kContactLabel);
  label.scale.z = style.text_height;
  label.text = textOf(risk);
  label.color = color(0.1F, 0.1F, 0.1F);
  markers.markers.push_back(label);
}

/// What is likely to happen, and below it what to do: a whole sentence is wider than the view.
std::string inTwoLines(std::string reason) {
  if (const std::size_t colon = reason.find(": "); colon != std::string::npos) {
    reason[colon + 1] = '\n';
  }
  return reason;
}

void addLevel(const RiskArray& risks, const RiskStyle& style, MarkerArray& markers) {
  if (risks.level == RiskArray::LEVEL_NONE || risks.host_path.empty()) {
    return;
  }
  Marker label = makeMarker(risks.header, "risk level", Marker::TEXT_VIEW_FACING);
  const geometry_msgs::Pose2D& host = risks.host_path.front();
  label.pose.position = pointAt(host.x, host.y, kLevelLabel);
  label.scale.z = kSentence * style.text_height;
  label.text = inTwoLines(risks.reason);
  label.color = inkOf(colorOfLevel(risks.level));
  markers.markers.push_back(label);
}

}  // namespace

MarkerArray markersOf(const RiskArray& risks, const RiskStyle& style) {
  MarkerArray markers;
  Marker tube = tubeOf(risks);
  if (!tube.points.empty()) {  // rviz reports an empty list as an error
    markers.markers.push_back(tube);
  }
  for (const RiskMessage& risk : risks.risks) {
    const auto probability = static_cast<double>(risk.contact_probability.back());
    if (probability > 0.0 && probability >= style.min_probability &&
        std::isfinite(risk.median_ttc)) {
      addContact(risks, risk, style, markers);
    }
  }
  addLevel(risks, style, markers);
  return markers;
}

}  // namespace datmo
