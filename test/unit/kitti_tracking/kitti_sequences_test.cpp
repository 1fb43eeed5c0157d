// SPDX-License-Identifier: BSD-3-Clause
// Sequences of KITTI tracking; skipped if they are not installed.
#include <filesystem>

#include "kitti_tracking/kitti_calibration.h"
#include "kitti_tracking/kitti_tracking_files.h"
#include "kitti_tracking/tracking_evaluation.h"
#include <Eigen/LU>
#include <gtest/gtest.h>

namespace datmo::kitti::kitti_sequences_test {
namespace {

namespace fs = std::filesystem;

const fs::path kFolder = fs::path(DATMO_FUSION_SHARED_DATA) / "kitti_tracking";

class KittiSequences : public testing::Test {
 protected:
  void SetUp() override {
    if (!fs::is_directory(kFolder)) {
      GTEST_SKIP() << "no KITTI tracking data in " << kFolder;
    }
  }
};

std::vector<std::string> filesIn(const fs::path& folder) {
  std::vector<std::string> files;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
    files.push_back(entry.path().string());
  }
  return files;
}

/// Returns the labels, and the labeled objects as results.
std::vector<Sequence> perfectRuns() {
  std::vector<Sequence> sequences;
  for (const std::string& file : filesIn(kFolder / "label_02")) {
    Sequence sequence{file, readLabels(file), {}};
    for (TrackedObject object : sequence.labels) {
      if (object.type != ObjectType::kDontCare) {
        object.score = 1.0;
        sequence.results.push_back(object);
      }
    }
    sequences.push_back(sequence);
  }
  return sequences;
}

TEST_F(KittiSequences, LabelsAgainstThemselvesArePerfect) {
  const std::vector<Sequence> sequences = perfectRuns();
  for (const ObjectType type : {ObjectType::kCar, ObjectType::kPedestrian, ObjectType::kCyclist}) {
    const TrackingScore score = evaluateTracking(sequences, {type, 0.99});
    EXPECT_DOUBLE_EQ(score.samota.value(), 1.0) << nameOf(type);
    EXPECT_NEAR(score.amotp.value(), 1.0, 1e-9) << nameOf(type);
    EXPECT_EQ(score.best.errors(), 0U) << nameOf(type);
    EXPECT_EQ(score.best.fragmentations, 0U) << nameOf(type);
  }
}

TEST_F(KittiSequences, DetectionsAreOfTheirFoldersClass) {
  for (const ObjectType type : {ObjectType::kCar, ObjectType::kPedestrian, ObjectType::kCyclist}) {
    for (const std::string& file : filesIn(kFolder / "pointrcnn" / nameOf(type))) {
      const std::vector<Detection> detections = readDetections(file);
      ASSERT_FALSE(detections.empty()) << file;
      EXPECT_EQ(detections.front().type, type) << file;
    }
  }
}

TEST_F(KittiSequences, CalibrationsAreRotations) {
  for (const std::string& file : filesIn(kFolder / "calib")) {
    const Calibration calibration = readCalibration(file);
    EXPECT_NEAR(calibration.rectification.determinant(), 1.0, 1e-3) << file;
    EXPECT_NEAR(calibration.camera_from_velodyne.leftCols<3>().determinant(), 1.0, 1e-3) << file;
    EXPECT_NEAR(calibration.velodyne_from_imu.leftCols<3>().determinant(), 1.0, 1e-3) << file;
    EXPECT_GT(calibration.image_from_camera(0, 0), 0.0) << file;
  }
}

}  // namespace
}  // namespace datmo::kitti::kitti_sequences_test
