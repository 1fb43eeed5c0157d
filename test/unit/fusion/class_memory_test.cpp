// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/fusion/track/class_memory.h"

#include <gtest/gtest.h>

namespace datmo::class_memory_test {
namespace {

using Beliefs = std::map<ClassMemory::Member, ClassProbabilities>;

const ClassMemory::Member kLidar{"lidar", 1};
const ClassMemory::Member kStereo{"stereo", 7};

ClassProbabilities saidTo(ObjectClass object_class, double probability) {
  ClassBelief belief;
  belief.update(object_class, probability);
  return belief.probabilities();
}

double ofPedestrian(const ClassMemory& memory) {
  return memory.belief()[static_cast<std::size_t>(ObjectClass::kPedestrian)];
}

TEST(ClassMemoryTest, BeforeAnythingWasSaidAllAreEquallyLikely) {
  EXPECT_EQ(ClassMemory().belief(), ClassBelief().probabilities());
}

TEST(ClassMemoryTest, SourcesAreJoinedByBayes) {
  ClassMemory memory;
  const Beliefs both{{kLidar, saidTo(ObjectClass::kPedestrian, 0.5)},
                     {kStereo, saidTo(ObjectClass::kPedestrian, 0.6)}};
  memory.update(both, both);
  EXPECT_EQ(memory.belief(), jointBelief(both.at(kLidar), both.at(kStereo)));
  EXPECT_GT(ofPedestrian(memory), 0.7);
}

TEST(ClassMemoryTest, WhatATrackThatEndedSaidCountsOn) {
  ClassMemory memory;
  const Beliefs both{{kLidar, ClassBelief().probabilities()},
                     {kStereo, saidTo(ObjectClass::kPedestrian, 0.9)}};
  memory.update(both, both);
  const double before = ofPedestrian(memory);
  const Beliefs alone{{kLidar, ClassBelief().probabilities()}};
  for (int i = 0; i < 5; ++i) {
    memory.update(alone, alone);
  }
  EXPECT_DOUBLE_EQ(ofPedestrian(memory), before);
}

TEST(ClassMemoryTest, WhatWentOverToAnotherObjectDoesNot) {
  ClassMemory memory;
  const Beliefs both{{kLidar, ClassBelief().probabilities()},
                     {kStereo, saidTo(ObjectClass::kPedestrian, 0.9)}};
  memory.update(both, both);
  memory.update({{kLidar, ClassBelief().probabilities()}}, both);
  EXPECT_EQ(memory.belief(), ClassBelief().probabilities());
}

TEST(ClassMemoryTest, OfTheTracksOfOneSourceTheSurestCounts) {
  ClassMemory memory;
  std::uint32_t id = 0;
  for (const double probability : {0.6, 0.9, 0.7}) {
    const Beliefs own{{{"stereo", ++id}, saidTo(ObjectClass::kPedestrian, probability)}};
    memory.update(own, own);
  }
  EXPECT_EQ(memory.belief(), saidTo(ObjectClass::kPedestrian, 0.9));
}

}  // namespace
}  // namespace datmo::class_memory_test
