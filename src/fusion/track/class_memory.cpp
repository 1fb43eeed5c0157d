// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/fusion/track/class_memory.h"

#include <algorithm>
#include <iterator>

namespace datmo {

namespace {

bool tellsMore(const ClassProbabilities& a, const ClassProbabilities& b) {
  return *std::max_element(a.begin(), a.end()) > *std::max_element(b.begin(), b.end());
}

}  // namespace

void ClassMemory::update(const std::map<Member, ClassProbabilities>& own,
                         const std::map<Member, ClassProbabilities>& all) {
  std::map<std::string, std::pair<Member, ClassProbabilities>> ended;
  for (const auto& [member, belief] : said_) {
    if (all.count(member) > 0) {
      continue;  // it is the object's own, or went over to another
    }
    const auto [surest, added] = ended.try_emplace(member.first, member, belief);
    if (!added && tellsMore(belief, surest->second.second)) {
      surest->second = {member, belief};
    }
  }
  said_ = own;
  for (const auto& [source, one] : ended) {
    said_.insert(one);
  }
}

ClassProbabilities ClassMemory::belief() const {
  std::map<std::string, ClassProbabilities> by_source;
  for (const auto& [member, belief] : said_) {
    const auto [surest, added] = by_source.try_emplace(member.first, belief);
    if (!added && tellsMore(belief, surest->second)) {
      surest->second = belief;
    }
  }
  if (by_source.empty()) {
    return ClassBelief().probabilities();
  }
  ClassProbabilities joint = by_source.begin()->second;
  for (auto source = std::next(by_source.begin()); source != by_source.end(); ++source) {
    joint = jointBelief(joint, source->second);
  }
  return joint;
}

}  // namespace datmo
