// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/road/passage_grid.h"

#include <gtest/gtest.h>

namespace datmo::passage_grid_test {
namespace {

using State = PassageGrid::State;

/// A scan of one beam from a point.
BorderScan beamTo(const Point2& end, bool hit, const Point2& from = Point2::Zero()) {
  BorderScan scan;
  scan.scanner = Pose2(from, 0.0);
  BorderScan::Beam beam;
  beam.end = end;
  beam.hit = hit;
  scan.beams.push_back(beam);
  return scan;
}

const Point2 kEnd(10.25, 0.25);     ///< the middle of a cell
const Point2 kBeyond(20.25, 0.25);  ///< the same bearing, within half a cell
const Point2 kBefore(5.25, 0.25);

class PassageGridTest : public ::testing::Test {
 protected:
  void repeat(int times, const BorderScan& scan) {
    for (int i = 0; i < times; ++i) {
      grid_.update(scan);
    }
  }

  PassageGrid grid_{PassageGridOptions()};
};

TEST_F(PassageGridTest, CellsPassedAreFreeAndWhereTwoBeamsEndedOccupied) {
  repeat(1, beamTo(kEnd, true, {0.0, 0.25}));
  EXPECT_EQ(grid_.at(kBefore), State::kFree);
  EXPECT_EQ(grid_.at(kEnd), State::kUnknown);
  EXPECT_EQ(grid_.at(kBeyond), State::kUnknown);
  repeat(1, beamTo(kEnd, true, {0.0, 0.25}));
  EXPECT_EQ(grid_.at(kEnd), State::kOccupied);
}

TEST_F(PassageGridTest, ABeamWithoutReturnEndsOnNothing) {
  repeat(5, beamTo(kEnd, false, {0.0, 0.25}));
  EXPECT_EQ(grid_.at(kBefore), State::kFree);
  EXPECT_EQ(grid_.at(kEnd), State::kFree);
}

TEST_F(PassageGridTest, CellsWithFewBeamEndsAreFree) {
  repeat(2, beamTo(kEnd, true, {0.0, 0.25}));
  repeat(11, beamTo(kBeyond, false, {0.0, 0.25}));
  EXPECT_EQ(grid_.at(kEnd), State::kOccupied);  // 2 of 13: 0.154
  repeat(1, beamTo(kBeyond, false, {0.0, 0.25}));
  EXPECT_EQ(grid_.at(kEnd), State::kFree);  // 2 of 14: 0.143
}

TEST_F(PassageGridTest, CellsOfALongStationaryObjectBecomeFreeSooner) {
  PassageGridOptions options;
  options.max_beams = 10;
  grid_ = PassageGrid(options);
  repeat(1000, beamTo(kEnd, true, {0.0, 0.25}));
  ASSERT_EQ(grid_.at(kEnd), State::kOccupied);
  repeat(30, beamTo(kBeyond, false, {0.0, 0.25}));
  EXPECT_EQ(grid_.at(kEnd), State::kFree);
}

TEST_F(PassageGridTest, CellsLeftBehindAreForgotten) {
  repeat(2, beamTo(kEnd, true, {0.0, 0.25}));
  repeat(1, beamTo({110.0, 0.25}, false, {100.0, 0.25}));
  EXPECT_EQ(grid_.at(kEnd), State::kUnknown);
  repeat(1, beamTo({1.0, 0.25}, false, {0.0, 0.25}));
  EXPECT_EQ(grid_.at(kEnd), State::kUnknown);
}

TEST_F(PassageGridTest, ResetForgetsAll) {
  repeat(2, beamTo(kEnd, true, {0.0, 0.25}));
  grid_.reset();
  EXPECT_EQ(grid_.at(kEnd), State::kUnknown);
  EXPECT_EQ(grid_.at(kBefore), State::kUnknown);
}

}  // namespace
}  // namespace datmo::passage_grid_test
