#pragma once

#include <string>
#include <vector>

#include "datmo_fusion/fusion/source_matcher.h"
#include "datmo_fusion/fusion/track_fuser.h"
#include "datmo_fusion/ros/fusion_inputs.h"
#include "datmo_fusion/ros/messages.h"
#include "datmo_fusion/ros/stage_monitor.h"
#include "datmo_fusion/ros/stamp_check.h"

namespace datmo {

struct TrackFusionStageOptions {
  std::string fixed_frame = "map";
  StreamOptions input;
  SourceMatcherOptions matcher;
  TrackFuserOptions fuser;

  TrackFusionStageOptions();

  void visit(OptionVisitor& visitor);
};

/// Matched lists of tracks and TrackFuser between messages: the same ones serve the nodelet and the
/// bag runner. What is let in, and what is said of a source that is missed: FusionInputs. When the
/// clock jumps back all state is forgotten.
class TrackFusionStage {
 public:
  /// `monitor` must outlive the stage. Throws OptionError.
  TrackFusionStage(const TrackFusionStageOptions& options, StageMonitor& monitor);

  /// The sources in use, by name.
  std::vector<std::string> sources() const { return options_.fuser.sourcesInUse(); }

  /// The tracks of one source (else they are dropped: `unknown_source`). `now`: ROS time.
  void takeTracks(const std::string& source, const TrackArray& message, Stamp now);

  /// The next set of lists that is ready, fused, at the reference's stamp; null if there is none.
  /// To be asked until null, after each list and from time to time: nobody knows before whether one
  /// that is waited for still comes. `now`: ROS time.
  TrackArrayPtr next(Stamp now);

 private:
  TrackFusionStageOptions options_;
  StageMonitor& monitor_;
  FusionInputs inputs_;
  SourceMatcher<TrackList> matcher_;
  TrackFuser fuser_;
};

}  // namespace datmo
