// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "its_units.h"
#include <Eigen/Core>

#include "datmo_fusion/fusion/wire/cam.h"
#include "datmo_fusion/fusion/wire/station_messages.h"

namespace datmo {

// Position, motion and size from CAM and CPM, in our units.

/// A station's position and its uncertainty.
struct ReferencePosition {
  LocalPlane plane;
  Eigen::Matrix2d covariance;  ///< m^2
};

/// Throws WireError (`no_position`).
ReferencePosition referencePositionOf(const ItsPosition& position,
                                      const StationMessageOptions& options);

struct Velocity {
  Point2 velocity = Point2::Zero();                          ///< m/s, east and north
  Eigen::Matrix2d covariance = Eigen::Matrix2d::Identity();  ///< (m/s)^2
  bool is_known = false;
};

Velocity unknownVelocity(const StationMessageOptions& options);

/// Velocity from speed and course; without course the direction is unknown.
Velocity velocityOf(const ItsSpeed& speed, const std::optional<ItsDirection>& course,
                    const StationMessageOptions& options);

/// m/s; slower is standing still.
inline constexpr double kStandstill = 0.3;

void setVelocity(const Velocity& velocity, StationTrack& track);

/// Replaces extents of 0 by the usual ones.
void setSize(ObjectClass object_class, StationTrack& track);

StationMessage decode(const Cam& cam, Stamp now, const StationMessageOptions& options);
StationMessage decode(const Cpm& cpm, const StationMessageOptions& options);

}  // namespace datmo
