// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/ros/stage/stage.h"

#include <algorithm>
#include <iterator>

namespace datmo {

std::vector<WatchedInput> watchedInputs(const std::vector<StageInput>& inputs,
                                        const ResolveTopic& resolve) {
  std::vector<WatchedInput> watched;
  for (const StageInput& input : inputs) {
    if (input.required) {
      watched.push_back({input.topic, {}});
    }
  }
  for (const StageInput& input : inputs) {
    const auto found = std::find_if(watched.begin(), watched.end(), [&](const WatchedInput& each) {
      return each.name == input.booked_as;
    });
    if (found != watched.end()) {
      found->topics.push_back({resolve(input.topic), input.data_type});
    }
  }
  return watched;
}

StageTopics topicsOf(const std::vector<StageInput>& inputs,
                     const std::vector<std::string>& output_topics, const ResolveTopic& resolve) {
  StageTopics topics;
  std::transform(inputs.begin(), inputs.end(), std::back_inserter(topics.inputs),
                 [&](const StageInput& input) { return resolve(input.topic); });
  std::transform(output_topics.begin(), output_topics.end(), std::back_inserter(topics.outputs),
                 resolve);
  return topics;
}

}  // namespace datmo
