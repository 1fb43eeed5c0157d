// SPDX-License-Identifier: BSD-3-Clause
#include "kitti_tracking/sequence_run.h"

#include <algorithm>
#include <iterator>
#include <map>
#include <set>
#include <utility>

#include "made_camera.h"
#include <gtest/gtest.h>

namespace datmo::kitti::sequence_run_test {
namespace {

/// As in config/kitti_tracking: everything that is detected is published.
RunOptions runOptions() {
  RunOptions options;
  for (ClassTrackingOptions& one : options.classes) {
    one.tracker.require_motion = false;
    one.tracker.confirmation_hits = 1;
    one.tracker.confirmation_existence = 0.0;
    one.tracker.published_existence = 0.001;
    one.tracker.min_existence = 0.001;
  }
  options.image = {1200.0, 360.0};
  return options;
}

Detection detection(int frame, const Box3& box, double score = 8.0) {
  Detection result;
  result.frame = frame;
  result.score = score;
  result.box = box;
  return result;
}

/// A car that drives ahead of a stationary vehicle, parked cars, and a stationary pedestrian.
DetectedSequence street(int frames) {
  DetectedSequence sequence;
  sequence.calibration = madeCalibration();
  for (int frame = 0; frame < frames; ++frame) {
    auto& cars = sequence.detections[0];
    cars.push_back(detection(frame, boxAt(0.5, 15.0 + 0.5 * frame, -kPi / 2.0)));
    cars.push_back(detection(frame, boxAt(-6.0, 20.0, -kPi / 2.0)));
    cars.push_back(detection(frame, boxAt(-6.0, 30.0, -kPi / 2.0)));
    cars.push_back(detection(frame, boxAt(7.0, 25.0, -kPi / 2.0)));
    Box3 person = boxAt(3.0, 12.0);
    person.length = person.width = 0.6;
    sequence.detections[1].push_back(detection(frame, person));
  }
  return sequence;
}

TEST(SequenceRun, EachObjectKeepsOneIdOfItsOwn) {
  const SequenceRun run = runSequence(street(20), runOptions());
  EXPECT_EQ(run.frames, 20U);
  std::set<int> ids;
  std::set<std::pair<int, int>> rows;
  for (const TrackedObject& row : run.rows) {
    ids.insert(row.id);
    EXPECT_TRUE(rows.emplace(row.frame, row.id).second) << "one row for each frame and id";
  }
  EXPECT_EQ(ids.size(), 5U);
  EXPECT_EQ(run.rows.size(), 100U);
}

TEST(SequenceRun, BoxesAreThoseOfTheDetections) {
  const DetectedSequence sequence = street(20);
  const SequenceRun run = runSequence(sequence, runOptions());
  int cars = 0;
  for (const TrackedObject& row : run.rows) {
    if (row.frame == 19 && row.type == ObjectType::kCar) {
      ++cars;
      double best = 0.0;
      for (const Detection& found : sequence.detections[0]) {
        if (found.frame == 19) {
          best = std::max(best, overlap3d(row.box, found.box));
        }
      }
      EXPECT_GT(best, 0.8);
    }
  }
  EXPECT_EQ(cars, 4);
}

TEST(SequenceRun, AMissedTrackContinues) {
  DetectedSequence sequence = street(20);
  auto& cars = sequence.detections[0];
  cars.erase(std::remove_if(cars.begin(), cars.end(),
                            [](const Detection& d) { return d.frame == 12 && d.box.x == 0.5; }),
             cars.end());
  const SequenceRun run = runSequence(sequence, runOptions());
  EXPECT_EQ(run.rows.size(), 100U);
  for (const TrackedObject& row : run.rows) {
    if (row.frame == 12 && row.occluded != 0) {
      EXPECT_NEAR(row.box.z, 21.0, 0.5);
    }
  }
}

TEST(SequenceRun, LongAndCertainTracksScoreHigher) {
  DetectedSequence sequence = street(20);
  sequence.detections[0].push_back(detection(10, boxAt(-12.0, 40.0), 0.0));
  std::map<int, double> best;
  for (const TrackedObject& row : runSequence(sequence, runOptions()).rows) {
    double& score = best.try_emplace(row.id, row.score).first->second;
    score = std::max(score, row.score);
  }
  ASSERT_EQ(best.size(), 6U);
  std::set<double> scores;
  for (const auto& [id, score] : best) {
    scores.insert(score);
  }
  // By default the log odds are 0.9 (score - 2.5), to which eight times -4 is added.
  EXPECT_NEAR(*scores.begin(), (-2.25 - 32.0) / 9.0, 1e-9);
  EXPECT_NEAR(*std::next(scores.begin()), (20.0 * 4.95 - 32.0) / 28.0, 1e-9);
}

TEST(SequenceRun, FramesWithoutDetectionsAndNoDetectionsAtAll) {
  DetectedSequence sequence = street(3);
  sequence.detections[0].push_back(detection(50, boxAt(0.0, 20.0)));
  EXPECT_EQ(runSequence(sequence, runOptions()).frames, 51U);
  DetectedSequence nothing;
  nothing.calibration = madeCalibration();
  EXPECT_EQ(runSequence(nothing, runOptions()).frames, 0U);
}

TEST(SequenceRun, WithoutEgoMotionTheVehicleIsStationary) {
  RunOptions options = runOptions();
  options.estimate_ego_motion = false;
  const SequenceRun run = runSequence(street(20), options);
  EXPECT_EQ(run.rows.size(), 100U);
  EXPECT_EQ(run.ego_motion_seconds, 0.0);
}

}  // namespace
}  // namespace datmo::kitti::sequence_run_test
