#include "track_fusion_pipeline.h"

#include <algorithm>

namespace datmo {

TrackFusionPipeline::TrackFusionPipeline(const TrackFusionOptions& options, LastStage last,
                                         const TransformBuffer& transforms, StageTimes& times)
    : times_(times),
      fuses_(last >= LastStage::kTrackFusion),
      transform_wait_(options.stereo_tracker.transform_wait),
      longest_wait_(options.track_fusion.matcher.longest_wait),
      stereo_tracker_(options.stereo_tracker, transforms, stereo_monitor_),
      fusion_(options.track_fusion, fusion_monitor_),
      sources_(fusion_.sources()) {}

void TrackFusionPipeline::takeSplitScan(const SplitScanMessage& message) {
  stereo_tracker_.takeSplitScan(message);
}

void TrackFusionPipeline::takeStereoObjects(const ObjectArrayConstPtr& objects, Stamp now) {
  if (isInUse("stereo")) {
    stereo_tracker_.takeObjects(objects, now);
  }
}

void TrackFusionPipeline::takeTracks(const std::string& source, const TrackArray& tracks,
                                     Stamp now) {
  if (fuses_ && isInUse(source)) {
    fusion_.takeTracks(source, tracks, now);
  }
}

TrackArrayPtr TrackFusionPipeline::nextStereo(Stamp now) {
  TrackArrayPtr tracks = stereo_tracker_.next(now);
  if (tracks) {
    bookTime(stereo_monitor_);
    takeTracks("stereo", *tracks, now);
  }
  return tracks;
}

TrackArrayPtr TrackFusionPipeline::nextFused(Stamp now) {
  TrackArrayPtr fused = fuses_ ? fusion_.next(now) : nullptr;
  if (fused) {
    bookTime(fusion_monitor_);
  }
  return fused;
}

bool TrackFusionPipeline::isInUse(const std::string& source) const {
  return std::find(sources_.begin(), sources_.end(), source) != sources_.end();
}

void TrackFusionPipeline::bookTime(const StageMonitor& monitor) {
  times_.add(monitor.stage(), monitor.lastProcessed().seconds);
}

}  // namespace datmo
