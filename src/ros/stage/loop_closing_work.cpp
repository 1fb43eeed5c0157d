// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/ros/stage/loop_closing_work.h"

#include <exception>

#include "datmo_fusion/ros/stage/stage_monitor.h"

namespace datmo {

namespace {

void take(LoopCloser& closer, const LoopJob::Step& step) {
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

}  // namespace

LoopResult closeLoops(LoopCloser& closer, const LoopJob& job) {
  const Stopwatch watch;
  LoopResult result;
  result.drive = job.drive;
  try {
    for (const LoopJob::Step& step : job.steps) {
      take(closer, step);
    }
    if (job.wants_results) {
      result.trajectory = closer.trajectory();
      result.map = std::make_shared<const OccupancyMap>(closer.map());
    }
  } catch (const std::exception& error) {  // no memory, in a thread that must not end by it
    result.error = error.what();
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
