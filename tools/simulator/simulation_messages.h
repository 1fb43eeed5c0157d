// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "simulator/collision.h"
#include "simulator/ground_truth.h"
#include "simulator/laser_scanner.h"
#include "simulator/odometer.h"
#include "simulator/world.h"
#include <datmo_fusion/TrueContact.h>

#include <nav_msgs/Odometry.h>
#include <sensor_msgs/LaserScan.h>
#include <sensor_msgs/MultiEchoLaserScan.h>

#include "datmo_fusion/common/stamp.h"
#include "datmo_fusion/ros/convert/messages.h"

namespace datmo::simulator {

/// Nearest echoes; infinite: none (REP 117).
sensor_msgs::LaserScan toLaserScan(const EchoScan& scan, const LaserScannerOptions& options,
                                   Stamp stamp);

/// All echoes; an empty list: none.
sensor_msgs::MultiEchoLaserScan toMultiEchoScan(const EchoScan& scan,
                                                const LaserScannerOptions& options, Stamp stamp);

/// The origin of the nearest echo of each beam.
TrueEchoes toTrueEchoes(const EchoScan& scan, Stamp stamp);

nav_msgs::Odometry toMessage(const Odometry& odometry, Stamp stamp);

datmo_fusion::TrueContact toTrueContact(const EgoContact& contact, Stamp stamp);

/// The following are in the frame of the ground truth, the world as `map_in_world` sees it.
nav_msgs::Odometry toTruePose(const WorldState& state, const Pose2& map_in_world, Stamp stamp);
TrueObjectArray toMessage(const std::vector<ObjectTruth>& objects, const Pose2& map_in_world,
                          Stamp stamp);
TrueRoadBorders toTrueBorders(const RoadNetwork& roads, const WorldState& state,
                              const Pose2& map_in_world, Stamp stamp);

}  // namespace datmo::simulator
