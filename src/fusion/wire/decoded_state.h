// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "its_units.h"
#include <Eigen/Core>

#include "datmo_fusion/fusion/wire/cam.h"
#include "datmo_fusion/fusion/wire/station_messages.h"

namespace datmo {

// What CAM and CPM say of position, motion and size, in our units.

/// Where a station is, and how sure that is.
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

/// By speed and course; without course the speed goes anywhere.
Velocity velocityOf(const ItsSpeed& speed, const std::optional<ItsDirection>& course,
                    const StationMessageOptions& options);

/// Slower is standing, m/s.
inline constexpr double kStandstill = 0.3;

void setVelocity(const Velocity& velocity, StationTrack& track);

/// Of extents that are 0, those that are usual.
void setSize(ObjectClass object_class, StationTrack& track);

StationMessage decode(const Cam& cam, Stamp now, const StationMessageOptions& options);
StationMessage decode(const Cpm& cpm, const StationMessageOptions& options);

}  // namespace datmo
