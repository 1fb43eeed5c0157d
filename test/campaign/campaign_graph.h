// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <string>
#include <vector>

#include "run_bag/graph_runner.h"
#include "run_bag/sensor_set.h"

#include "datmo_fusion/ros/stage/stage_graph.h"

namespace datmo::campaign {

/// A graph of stages and its sensors.
struct CampaignGraph {
  std::string name;
  GraphSwitches switches;
  std::string motion = "odometry";  ///< motion/source
  bool has_echoes = false;          ///< the scanner sends several for each beam
};

/// Returns graphs in which each input of each stage occurs, and each switch is on, at least once.
const std::vector<CampaignGraph>& campaignGraphs();

/// Returns the sensor set's options, with the graph's source of motion. Throws OptionError.
SensorSet sensorsOf(const std::string& config, const CampaignGraph& graph);

/// Passes a message to the stages, which may also be one of transforms.
Publications handleAny(const Publication& message, Stamp now, GraphRunner& runner);

/// Reasons of drops that no input may cause: internal errors, and outputs that must not be
/// published.
inline constexpr std::array<const char*, 2> kDefectReasons{"unexpected_error", "bad_output"};

}  // namespace datmo::campaign
