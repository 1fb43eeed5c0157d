// SPDX-License-Identifier: BSD-3-Clause
#include "fuzzed_graph.h"

namespace datmo::fuzz {

namespace {

constexpr char kTransforms[] = "/tf";
constexpr char kStaticTransforms[] = "/tf_static";

FuzzedGraph fuzzed(const campaign::CampaignGraph& graph) {
  FuzzedGraph all{graph,
                  campaign::sensorsOf(DATMO_FUSION_FUZZED_STAGES, graph),
                  {kTransforms, kStaticTransforms}};
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

Publications deliver(const Publication& message, Stamp now, GraphRunner& runner) {
  const auto transforms = message.as<tf2_msgs::TFMessage>();
  if (transforms && message.topic == kStaticTransforms) {
    runner.handleStaticTransforms(*transforms);
    return {};
  }
  return transforms ? runner.handleTransforms(*transforms, now) : runner.handle(message, now);
}

}  // namespace datmo::fuzz
