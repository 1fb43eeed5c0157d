// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <visualization_msgs/MarkerArray.h>

#include "datmo_fusion/ros/convert/risk_conversion.h"

namespace datmo {

/// How risks are drawn.
struct RiskStyle {
  double min_probability = 0.1;  ///< 0 to 1, of contact within 4 s; others are not drawn
  double text_height = 1.1;      ///< m
};

/// The host's predicted tube ("host tube"): the ground swept by its outline, from red (now) to
/// green (at the end of the prediction). For likely contacts the object's position at contact as a
/// disc on the ground in the same colors ("contacts"), larger the likelier, and its time,
/// probability and speed ("contact labels"). The reason of the level above the host ("risk level"),
/// from level information on.
visualization_msgs::MarkerArray markersOf(const RiskArray& risks, const RiskStyle& style);

}  // namespace datmo
