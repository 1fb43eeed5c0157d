// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "datmo_fusion/fusion/sync/source_matcher.h"
#include "datmo_fusion/fusion/track/track_fuser.h"
#include "datmo_fusion/ros/convert/messages.h"
#include "datmo_fusion/ros/frame_options.h"
#include "datmo_fusion/ros/stage/fusion_inputs.h"
#include "datmo_fusion/ros/stage/stage.h"
#include "datmo_fusion/ros/stage/stage_runner.h"

namespace datmo {

struct TrackFusionStageOptions {
  FrameOptions frames;  ///< of all stages
  StreamOptions input;
  SourceMatcherOptions matcher;
  TrackFuserOptions fuser;

  /// A track predicts where its object goes, so that a list serves until it is older than any delay
  /// of a sensor, or a slower sensor's next list has come. So little is gained by waiting for it
  /// (doc/fusion.md); live, each list of the reference is fused when it comes.
  TrackFusionStageOptions();

  void visit(OptionVisitor& visitor);
};

/// Matched lists of tracks and TrackFuser between messages: the same ones serve the nodelet and the
/// bag runner. What is accepted, and how a missing source is reported: FusionInputs. When the
/// clock jumps back all state is forgotten; ids go on.
///
/// A list serves until there is a nearer one of its source. Tracks that do not name their sensor
/// are taken for their source's own. Tracks and views that are not valid are left out, and said.
class TrackFusionStage : public Stage {
 public:
  using Options = TrackFusionStageOptions;

  /// `monitor` must outlive the stage. Throws OptionError.
  TrackFusionStage(const Checked<TrackFusionStageOptions>& options, StageMonitor& monitor);

  /// The sources in use, by name.
  std::vector<std::string> sources() const { return options_.fuser.sourcesInUse(); }

  /// The tracks of one source (else they are dropped: `unknown_source`). `now`: ROS time.
  void takeTracks(const std::string& source, const TrackArray& message, Stamp now);

  /// The next set of lists that is ready, fused, at the reference's stamp; null if there is none.
  /// Call it until null, after each list and from time to time: it is not known before whether one
  /// that is waited for still comes. `now`: ROS time.
  TrackArrayPtr next(Stamp now);

  void connect(StagePorts& ports) override;
  std::vector<LiveOption> live() const override { return liveOptions(options_); }
  void change(const OptionValues& values) override;
  bool publishNext(Stamp now) override;
  double maxWait() const override { return options_.matcher.max_wait; }

 private:
  using Matched = MatchedSamples<TrackList>;

  TrackArrayPtr fuse(const Matched& matched);
  void reset();
  TrackList listOf(const std::string& source, const TrackArray& message);
  void report(const TrackFusionCounts& counts);

  TrackFusionStageOptions options_;
  StageMonitor& monitor_;
  StageRunner runner_;
  FusionInputs inputs_;
  SourceMatcher<TrackList> matcher_;
  TrackFuser fuser_;
  StagePublisher<TrackArray> fused_;
};

}  // namespace datmo
