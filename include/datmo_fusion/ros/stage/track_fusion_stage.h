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
  FrameOptions frames;  ///< shared by all stages
  StreamOptions input;
  SourceMatcherOptions matcher;
  TrackFuserOptions fuser;

  /// A track predicts its object's motion, so a list remains useful until it is older than any
  /// sensor latency, or a slower sensor's next list arrives. So there is little gain in waiting for
  /// it (doc/fusion.md); live, each list of the reference is fused on arrival.
  TrackFusionStageOptions();

  void visit(OptionVisitor& visitor);
};

/// Matches track lists and runs TrackFuser on them, for both the nodelet and the bag runner.
/// FusionInputs decides what is accepted and reports missing sources. The state is reset when the
/// clock jumps; ids continue.
///
/// A list is used until there is a nearer one of its source. Tracks that do not name their sensor
/// count as their source's own. Invalid tracks and views are dropped and reported.
class TrackFusionStage : public Stage {
 public:
  using Options = TrackFusionStageOptions;

  /// `monitor` must outlive the stage. Throws OptionError.
  TrackFusionStage(const Checked<TrackFusionStageOptions>& options, StageMonitor& monitor);

  /// The sources in use, by name.
  std::vector<std::string> sources() const { return options_.fuser.sourcesInUse(); }

  /// Adds the tracks of a source (else dropped: `unknown_source`). `now`: ROS time.
  void handleTracks(const std::string& source, const TrackArray& message, Stamp now);

  /// Fuses the next set of lists that is ready, at the reference's stamp; null if there is none.
  /// Call it until null, after each list and periodically, because a set may become ready by
  /// timeout. `now`: ROS time.
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
