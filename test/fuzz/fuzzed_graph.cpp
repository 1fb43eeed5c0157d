// SPDX-License-Identifier: BSD-3-Clause
#include "fuzzed_graph.h"

#include "datmo_fusion/ros/transform_topics.h"

namespace datmo::fuzz {

namespace {

FuzzedGraph fuzzed(const campaign::CampaignGraph& graph) {
  FuzzedGraph all{graph,
                  campaign::sensorsOf(DATMO_FUSION_FUZZED_STAGES, graph),
                  {kTransformTopic, kStaticTransformTopic}};
  for (const StageState& stage : GraphRunner(all.sensors, graph.switches).states(Stamp())) {
    all.topics.insert(stage.topics.inputs.begin(), stage.topics.inputs.end());
  }
  return all;
}

}  // namespace

const std::vector<FuzzedGraph>& fuzzedGraphs() {
  static const std::vector<FuzzedGraph> graphs = [] {
    std::vector<FuzzedGraph> all;
    for (const campaign::CampaignGraph& graph : campaign::campaignGraphs()) {
      all.push_back(fuzzed(graph));
    }
    return all;
  }();
  return graphs;
}

}  // namespace datmo::fuzz
