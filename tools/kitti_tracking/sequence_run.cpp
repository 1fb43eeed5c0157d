// SPDX-License-Identifier: BSD-3-Clause
#include "kitti_tracking/sequence_run.h"

#include <algorithm>
#include <ctime>
#include <deque>
#include <utility>

#include "kitti_tracking/class_competition.h"

namespace datmo::kitti {

namespace {

/// Processor time of this program since construction, s; other load of the machine does not count.
class ProcessorTime {
 public:
  double seconds() const {
    return static_cast<double>(std::clock() - start_) / static_cast<double>(CLOCKS_PER_SEC);
  }

 private:
  std::clock_t start_ = std::clock();
};

/// By frame.
using FrameDetections = std::vector<std::vector<Detection>>;

FrameDetections byFrame(const std::vector<Detection>& detections, std::size_t frames) {
  FrameDetections result(frames);
  for (const Detection& detection : detections) {
    result.at(static_cast<std::size_t>(detection.frame)).push_back(detection);
  }
  return result;
}

std::size_t frameCount(const DetectedSequence& sequence) {
  int last = -1;
  for (const auto& detections : sequence.detections) {
    for (const Detection& detection : detections) {
      last = std::max(last, detection.frame);
    }
  }
  return static_cast<std::size_t>(last + 1);
}

/// One frame after the other.
class Runner {
 public:
  Runner(const DetectedSequence& sequence, const RunOptions& options)
      : options_(options), ego_motion_(options.ego_motion) {
    const CameraMount mount(sequence.calibration, options.image);
    run_.frames = frameCount(sequence);
    for (std::size_t i = 0; i < kTrackedClasses; ++i) {
      classes_.emplace_back(kTrackedTypes.at(i), options.classes.at(i), mount);
      detections_.push_back(byFrame(sequence.detections.at(i), run_.frames));
    }
  }

  SequenceRun run() {
    for (std::size_t frame = 0; frame < run_.frames; ++frame) {
      const double seconds = static_cast<double>(frame) * options_.frame_period;
      handleFrame(frame, Stamp::fromSeconds(seconds));
    }
    return std::move(run_);
  }

 private:
  void handleFrame(std::size_t frame, Stamp stamp) {
    std::vector<ObjectList> objects;
    for (std::size_t i = 0; i < kTrackedClasses; ++i) {
      objects.push_back(classes_[i].objects(detections_[i][frame], stamp));
    }
    compete(objects);
    if (options_.estimate_ego_motion && frame > 0) {
      stepEgoMotion(objects);
    }
    track(objects);
    for (std::size_t i = 0; i < kTrackedClasses; ++i) {
      addRows(classes_[i].rows(objects[i], detections_[i][frame], static_cast<int>(frame)), i);
    }
  }

  void stepEgoMotion(const std::vector<ObjectList>& objects) {
    const ProcessorTime watch;
    std::vector<Landmark> expected;
    std::vector<Landmark> seen;
    for (std::size_t i = 0; i < kTrackedClasses; ++i) {
      for (const Landmark& landmark : classes_[i].landmarks()) {
        expected.push_back(landmark);
      }
      for (const Object& object : objects[i].objects) {
        if (isLikely(object)) {
          seen.push_back({object.box.center.position(), object.position_covariance});
        }
      }
    }
    ego_motion_.step(options_.frame_period, expected, seen);
    run_.ego_motion_seconds += watch.seconds();
  }

  void track(const std::vector<ObjectList>& objects) {
    const ProcessorTime watch;
    std::vector<Box2> seen;
    for (const ObjectList& list : objects) {
      for (const Object& object : list.objects) {
        if (isLikely(object)) {
          seen.push_back(object.box);
        }
      }
    }
    for (std::size_t i = 0; i < kTrackedClasses; ++i) {
      classes_[i].track(objects[i], ego_motion_.baseInFixed(), seen);
    }
    run_.tracking_seconds += watch.seconds();
  }

  /// More likely true than false according to its detector.
  static bool isLikely(const Object& object) { return object.log_odds > 0.0; }

  void addRows(std::vector<TrackedObject> rows, std::size_t which) {
    for (TrackedObject& row : rows) {
      row.id = row.id * static_cast<int>(kTrackedClasses) + static_cast<int>(which);
      run_.rows.push_back(row);
    }
  }

  const RunOptions& options_;
  EgoMotion ego_motion_;
  std::deque<ClassTracking> classes_;
  std::vector<FrameDetections> detections_;
  SequenceRun run_;
};

}  // namespace

void RunOptions::visit(OptionVisitor& visitor) {
  for (std::size_t i = 0; i < kTrackedClasses; ++i) {
    visitor.group(kClassNames.at(i), [&] { classes.at(i).visit(visitor); });
  }
  visitor.toggle({"estimate_ego_motion", "",
                  "estimate the vehicle's motion from the detections; off: the vehicle's frame is "
                  "used as the fixed frame"},
                 estimate_ego_motion);
  visitor.group("ego_motion", [&] { ego_motion.visit(visitor); });
  visitor.number({"frame_period", "s", "from a frame to the next one"}, frame_period,
                 {0.001, 10.0});
  visitor.number({"image_width", "px", "of the left color image"}, image.width, {1.0, 1e5});
  visitor.number({"image_height", "px", "of the left color image"}, image.height, {1.0, 1e5});
}

SequenceRun runSequence(const DetectedSequence& sequence, const RunOptions& options) {
  return Runner(sequence, options).run();
}

}  // namespace datmo::kitti
