// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "datmo_fusion/common/object.h"
#include "datmo_fusion/common/pose2.h"
#include "datmo_fusion/ros/convert/messages.h"
#include "datmo_fusion/ros/convert/risk_conversion.h"

namespace datmo {

/// One road user in the driver's picture; frame: the host's outline, x forward, y to the left.
struct DriverIcon {
  std::uint32_t id = 0;
  ObjectClass object_class = ObjectClass::kUnknown;
  Pose2 pose;                ///< m, rad: center and heading of its box
  double length = 0.0;       ///< m
  double width = 0.0;        ///< m
  double probability = 0.0;  ///< of contact within 4 s
  bool is_cause = false;     ///< it causes the level
};

/// Content of the driver's picture (thesis 4.2.5).
struct DriverView {
  std::uint8_t level = RiskArray::LEVEL_NONE;
  std::string reason;                   ///< in words; empty: no risk
  std::optional<double> time_to_brake;  ///< s, for the object that causes the level
  std::optional<double> ttc;            ///< s, median time to contact of the same object
  double host_length = 0.0;             ///< m
  double host_width = 0.0;              ///< m
  double path_step = 0.0;               ///< s
  std::vector<Pose2> path;              ///< of the host's outline, the first at the origin
  std::vector<DriverIcon> icons;        ///< by rising id
  std::optional<Point2> contact;        ///< m, with the object that causes the level
};

/// Combines risks with the tracks they refer to. `tracks`: null or in another frame if there are
/// none; then the icons are missing. Icons with a non-finite pose or size are omitted; the path
/// ends before its first non-finite pose, as its later ones would have other times.
DriverView driverViewOf(const RiskArray& risks, const TrackArray* tracks);

}  // namespace datmo
