// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/fusion/track/class_memory.h"

#include <algorithm>
#include <vector>

namespace datmo {

namespace {

/// Above chance, of the likeliest class: less is nothing but the doubt of ClassBelief.
constexpr double kTelling = 0.05;

bool tellsAnything(const ClassProbabilities& belief) {
  const double chance = 1.0 / static_cast<double>(belief.size());
  return *std::max_element(belief.begin(), belief.end()) > chance + kTelling;
}

}  // namespace

void ClassMemory::update(const Beliefs& own, const Beliefs& all) {
  for (const auto& [member, belief] : present_) {
    if (all.count(member) == 0 && tellsAnything(belief)) {
      ended_[member.first] = belief;
    }
  }
  for (const auto& [member, belief] : own) {
    if (tellsAnything(belief)) {
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
  if (beliefs.empty()) {
    return ClassBelief().probabilities();
  }
  ClassProbabilities joint = beliefs.front();
  for (std::size_t i = 1; i < beliefs.size(); ++i) {
    joint = jointBelief(joint, beliefs[i]);
  }
  return joint;
}

}  // namespace datmo
