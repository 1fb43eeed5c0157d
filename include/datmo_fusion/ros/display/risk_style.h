// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <visualization_msgs/MarkerArray.h>

#include "datmo_fusion/ros/convert/risk_conversion.h"

namespace datmo {

/// How risks are drawn.
struct RiskStyle {
  double min_probability = 0.1;  ///< 0 to 1, of contact within 4 s; below, a contact is not drawn
  double text_height = 1.1;      ///< m
};

/// The host's tube ("host tube"): the ground that its outline covers as it is expected to go, from
/// red (now) to green (at the end of the prediction); where contacts are likely, the object's
/// position at contact as a disc on the ground in the same colors ("contacts"), the larger the
/// likelier, and its time, probability and speed ("contact labels"); the reason of the level above
/// the host ("risk level"), from the level of information on.
visualization_msgs::MarkerArray markersOf(const RiskArray& risks, const RiskStyle& style);

}  // namespace datmo
