// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <set>
#include <string>
#include <vector>

#include "campaign_graph.h"
#include "run_bag/graph_runner.h"

namespace datmo::fuzz {

/// One of the campaign's graphs, with the options of stages.yaml.
struct FuzzedGraph {
  const campaign::CampaignGraph& campaign;
  SensorSet sensors;
  std::set<std::string> topics;  ///< that its stages read, and those of transforms
};

/// All of them; read once.
const std::vector<FuzzedGraph>& fuzzedGraphs();

}  // namespace datmo::fuzz
