// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/fusion/track/class_memory.h"

#include <vector>

namespace datmo {

void ClassMemory::update(const Beliefs& own, const Beliefs& all) {
  for (const auto& [member, belief] : present_) {
    if (all.count(member) == 0 && isInformative(belief)) {
      ended_[member.first] = belief;
    }
  }
  for (const auto& [member, belief] : own) {
    if (isInformative(belief)) {
      ended_.erase(member.first);
    }
  }
  present_ = own;
}

ClassProbabilities ClassMemory::belief() const {
  std::vector<ClassProbabilities> beliefs;
  for (const auto& [member, belief] : present_) {
    beliefs.push_back(belief);
  }
  for (const auto& [source, belief] : ended_) {
    beliefs.push_back(belief);
  }
  return jointBelief(beliefs);
}

}  // namespace datmo
