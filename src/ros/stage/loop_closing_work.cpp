// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/ros/stage/loop_closing_work.h"

#include <exception>

#include "datmo_fusion/ros/stage/stage_monitor.h"

namespace datmo {

namespace {

void apply(LoopCloser& closer, const LoopJob::Step& step) {
  switch (step.use) {
    case KeyframeSelector::Use::kNothing:
      return;
    case KeyframeSelector::Use::kPose:
      closer.addPose({step.scan.stamp, step.scan.base_in_map.pose});
      return;
    case KeyframeSelector::Use::kFirst:
      closer.clear();
      closer.add(step.scan);
      return;
    case KeyframeSelector::Use::kKeyframe:
      closer.add(step.scan);
      return;
  }
}

/// Calls `call`; returns the error message, or an empty one. Even memory exhaustion must not end
/// the thread.
template <typename Call>
std::string errorOf(const Call& call) {
  try {
    call();
  } catch (const std::exception& error) {
    return error.what();
  }
  return {};
}

}  // namespace

LoopResult closeLoops(LoopCloser& closer, const LoopJob& job) {
  const Stopwatch watch;
  LoopResult result;
  result.drive = job.drive;
  result.error = errorOf([&] {
    for (const LoopJob::Step& step : job.steps) {
      apply(closer, step);
    }
  });
  if (!result.error.empty()) {
    closer.clear();
  } else if (job.wants_results) {
    result.error = errorOf([&] {
      result.trajectory = closer.trajectory();
      result.loops = closer.loops();
      result.map = std::make_shared<const OccupancyMap>(closer.map());
    });
  }
  result.map_in_global = closer.mapInGlobal();
  result.counts = closer.counts();
  result.keyframes = closer.graph().poses().size();
  result.scans = closer.scans();
  result.memory = static_cast<double>(closer.bytes());
  result.residual = closer.residual();
  result.seconds = watch.seconds();
  return result;
}

}  // namespace datmo
