#pragma once

#include <string>
#include <utility>
#include <vector>

#include "pipeline_options.h"
#include "stage_times.h"
#include "wiring.h"

#include "datmo_fusion/ros/stage_monitor.h"
#include "datmo_fusion/ros/transform_buffer.h"

namespace datmo {

/// The stages after tracker with track-level fusion:
///
///     tracks of tracker ────────────────────────────────── lidar ──┐
///     split scan, objects of stereo ──► stereo_tracker ── stereo ──┴► track_fusion ─ tracks
///
/// `now` is always the time at which a message came.
class TrackFusionPipeline {
 public:
  /// Tracks and the name of their source: lidar, stereo.
  using NamedTracks = std::pair<std::string, TrackArrayPtr>;

  /// `transforms` and `times` must outlive this. Throws OptionError.
  TrackFusionPipeline(const TrackFusionOptions& options, LastStage last,
                      const TransformBuffer& transforms, StageTimes& times);

  /// Where the vehicle was.
  void takeSplitScan(const SplitScanMessage& message);

  /// Of the stereo camera, for its tracker.
  void takeStereoObjects(const ObjectArrayConstPtr& objects, Stamp now);

  /// Tracks of tracker (lidar), or of a source that has no tracker here.
  void takeTracks(const std::string& source, const TrackArray& tracks, Stamp now);

  /// The next tracks of stereo_tracker that are ready; null if there are none. To be asked until
  /// there are none; the same holds for nextFused.
  TrackArrayPtr nextStereo(Stamp now);
  TrackArrayPtr nextFused(Stamp now);

  /// When the last objects that wait for a transform wait no more, and when the last tracks that
  /// wait for others do, if the last message came at `now`.
  Stamp endOfTracking(Stamp now) const { return now + transform_wait_; }
  Stamp endOfWaiting(Stamp now) const { return now + longest_wait_; }

  std::vector<const StageMonitor*> monitors() const { return {&stereo_monitor_, &fusion_monitor_}; }

 private:
  bool isInUse(const std::string& source) const;
  void bookTime(const StageMonitor& monitor);

  StageTimes& times_;
  bool fuses_;             ///< goes further than the trackers
  double transform_wait_;  ///< s
  double longest_wait_;    ///< s
  StageMonitor stereo_monitor_{"stereo_tracker"};
  StageMonitor fusion_monitor_{"track_fusion"};
  TrackerStage stereo_tracker_;
  TrackFusionStage fusion_;
  std::vector<std::string> sources_;
};

}  // namespace datmo
