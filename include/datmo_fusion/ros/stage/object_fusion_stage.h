// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <string>
#include <vector>

#include <geometry_msgs/PoseWithCovarianceStamped.h>
#include <nav_msgs/Odometry.h>

#include "datmo_fusion/common/scan.h"
#include "datmo_fusion/fusion/object/object_fuser.h"
#include "datmo_fusion/fusion/sync/source_matcher.h"
#include "datmo_fusion/ros/convert/messages.h"
#include "datmo_fusion/ros/stage/fusion_inputs.h"
#include "datmo_fusion/ros/stage/motion_input.h"
#include "datmo_fusion/ros/stage/stage.h"
#include "datmo_fusion/ros/stage/stage_runner.h"

namespace datmo {

struct ObjectFusionStageOptions {
  FrameOptions frames;   ///< shared by all stages
  MotionOptions motion;  ///< shared by all stages
  StreamOptions input;
  SourceMatcherOptions matcher;
  bool retroactive = false;
  ObjectFuserOptions fuser;

  void visit(OptionVisitor& visitor);
};

/// Matches object lists and runs ObjectFuser on them, for both the nodelet and the bag runner.
/// FusionInputs decides what is accepted and reports missing sources. The state is reset when the
/// clock jumps.
///
/// Each list is fused once: a source slower than the reference does not count twice. Lists that
/// were in no set are counted. Objects and views that do not name their sensor count as their
/// source's own; invalid views are dropped and reported.
///
/// `retroactive`: a list of the reference that waits for others yields an early list at once, from
/// the data at hand; the complete fused list of its stamp follows as if there had been none.
class ObjectFusionStage : public Stage {
 public:
  using Options = ObjectFusionStageOptions;

  /// `monitor` must outlive the stage. Throws OptionError.
  ObjectFusionStage(const Checked<ObjectFusionStageOptions>& options, StageMonitor& monitor);

  /// The sources in use, by name.
  std::vector<std::string> sources() const { return options_.fuser.sourcesInUse(); }

  /// Adds the objects of a source (else dropped: `unknown_source`). `now`: ROS time.
  void handleObjects(const std::string& source, const ObjectArray& message, Stamp now);

  /// Sets the newest odometry; ignored if the options say that the vehicle has none.
  void handleOdometry(const nav_msgs::Odometry& message) { inputs_.handleMotion(message); }

  /// Sets the newest SLAM pose; used only if the options say that the vehicle has no odometry.
  void handlePose(const geometry_msgs::PoseWithCovarianceStamped& message) {
    inputs_.handleMotion(message);
  }

  /// Sets the scanner's scan, which is used for objects at exactly its stamp.
  void handleLabeledScan(const LabeledScanMessage& message);

  /// Fuses the next set of lists that is ready, at the reference's stamp; null if there is none.
  /// Call it until null, after each list and periodically, because a set may become ready by
  /// timeout. `now`: ROS time.
  ObjectArrayPtr next(Stamp now);

  /// Returns the next early list; null if there is none. Call it when there is no fused one.
  ObjectArrayPtr nextEarly(Stamp now);

  void connect(StagePorts& ports) override;
  bool publishNext(Stamp now) override;
  double maxWait() const override { return options_.matcher.max_wait; }

 private:
  using Matched = MatchedSamples<ObjectList>;

  /// The lists of the set with known motion; the others are added to `missing`.
  std::vector<SourceObjects> movedLists(const Matched& matched,
                                        std::vector<MissingSource>& missing) const;
  /// Null without a scan of this stamp.
  const LabeledScan* scanAt(Stamp stamp) const;
  ObjectArrayPtr fuse(const Matched& matched);
  void reset();
  void report(const std::vector<SourceObjects>& lists, const ObjectFusionCounts& counts);

  ObjectFusionStageOptions options_;
  StageMonitor& monitor_;
  StageRunner runner_;
  FusionInputs inputs_;
  SourceMatcher<ObjectList> matcher_;
  ObjectFuser fuser_;
  StagePublisher<ObjectArray> fused_;
  StagePublisher<ObjectArray> early_;
  std::optional<Stamp> newest_;    ///< of all published lists
  double early_seconds_ = 0.0;     ///< time spent on early lists since the last set
  std::deque<LabeledScan> scans_;  ///< newer than the last set, by rising stamp
  std::uint64_t times_without_scan_ = 0;
  std::uint64_t bad_objects_ = 0;
  std::uint64_t objects_too_many_ = 0;
};

}  // namespace datmo
