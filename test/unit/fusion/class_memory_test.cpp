// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/fusion/track/class_memory.h"

#include <gtest/gtest.h>

#include "datmo_fusion/common/class_belief.h"

namespace datmo::class_memory_test {
namespace {

using Beliefs = ClassMemory::Beliefs;

const ClassMemory::Member kLidar{"lidar", 1};
const ClassMemory::Member kStereo{"stereo", 7};
const ClassMemory::Member kNextStereo{"stereo", 8};

ClassProbabilities reportedAs(ObjectClass object_class, double probability) {
  ClassBelief belief;
  belief.update(reportedClass(object_class, probability));
  return belief.probabilities();
}

const ClassProbabilities kUnknown = ClassBelief().probabilities();
const ClassProbabilities kPedestrian = reportedAs(ObjectClass::kPedestrian, 0.9);
const ClassProbabilities kCyclist = reportedAs(ObjectClass::kCyclist, 0.6);

TEST(ClassMemoryTest, InitiallyAllClassesAreEquallyLikely) {
  EXPECT_EQ(ClassMemory().belief(), kUnknown);
}

TEST(ClassMemoryTest, SourcesAreJoinedByBayes) {
  ClassMemory memory;
  const Beliefs both{{kLidar, kCyclist}, {kStereo, kPedestrian}};
  memory.update(both, both);
  EXPECT_EQ(memory.belief(), jointBelief({kCyclist, kPedestrian}));
}

TEST(ClassMemoryTest, EvidenceOfAnEndedTrackIsKept) {
  ClassMemory memory;
  const Beliefs both{{kLidar, kUnknown}, {kStereo, kPedestrian}};
  memory.update(both, both);
  const Beliefs alone{{kLidar, kUnknown}};
  for (int i = 0; i < 5; ++i) {
    memory.update(alone, alone);
    EXPECT_EQ(memory.belief(), jointBelief({kUnknown, kPedestrian}));
  }
}

TEST(ClassMemoryTest, EvidenceOfATrackThatSwitchedObjectsIsNot) {
  for (const bool lost : {false, true}) {
    ClassMemory memory;
    const Beliefs both{{kLidar, kUnknown}, {kStereo, kPedestrian}};
    memory.update(both, both);
    const Beliefs alone{{kLidar, kUnknown}};
    memory.update(lost ? Beliefs{} : alone, both);
    memory.update(alone, alone);  // and ended there
    EXPECT_EQ(memory.belief(), kUnknown);
  }
}

TEST(ClassMemoryTest, TheNextInformativeTrackOfTheSourceReplacesIt) {
  ClassMemory memory;
  memory.update({{kStereo, kPedestrian}}, {{kStereo, kPedestrian}});
  memory.update({}, {});
  memory.update({{kNextStereo, kUnknown}}, {{kNextStereo, kUnknown}});
  EXPECT_EQ(memory.belief(), jointBelief({kUnknown, kPedestrian}));
  memory.update({{kNextStereo, kCyclist}}, {{kNextStereo, kCyclist}});
  EXPECT_EQ(memory.belief(), kCyclist);
}

}  // namespace
}  // namespace datmo::class_memory_test
