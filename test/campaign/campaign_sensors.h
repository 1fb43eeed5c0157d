// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "campaign_graph.h"
#include "run_bag/graph_runner.h"
#include "world.h"

namespace datmo::campaign {

/// All sensors that a stage may have, on a drive through a World.
class CampaignSensors {
 public:
  static constexpr double kStep = 1.0 / 16.0;  ///< s

  explicit CampaignSensors(const CampaignGraph& graph) : graph_(graph) {}

  /// Returns what they send at a step, on the graph's topics, including /tf, /tf_static, and
  /// messages that no stage of the graph subscribes to.
  std::vector<Publication> at(int step) const;

 private:
  void addMotion(double seconds, std::vector<Publication>& sent) const;
  void addScans(double seconds, std::vector<Publication>& sent) const;
  void addClouds(double seconds, std::vector<Publication>& sent) const;
  void addOthers(double seconds, std::vector<Publication>& sent) const;

  const CampaignGraph& graph_;
  World world_;
};

}  // namespace datmo::campaign
