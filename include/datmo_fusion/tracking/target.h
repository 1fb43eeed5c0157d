// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "datmo_fusion/common/class_belief.h"
#include "datmo_fusion/common/object.h"
#include "datmo_fusion/common/options.h"
#include "datmo_fusion/tracking/class_by_speed.h"
#include "datmo_fusion/tracking/imm_filter.h"
#include "datmo_fusion/tracking/motion_evidence.h"
#include "datmo_fusion/tracking/motion_likelihood.h"
#include "datmo_fusion/tracking/track.h"
#include "datmo_fusion/tracking/tracked_box.h"
#include "datmo_fusion/visibility/seen_points.h"

namespace datmo {

struct Observation;

struct TargetOptions {
  ImmOptions filter;
  TrackedBoxOptions box;
  MotionEvidenceOptions evidence;
  MotionLikelihoodOptions motion_likelihood;
  ClassBySpeedOptions class_by_speed;
  double birth_probability = 0.2;  ///< 1
  double birth_speed_std = 8.0;    ///< m/s
  double stop_speed = 0.4;         ///< m/s
  double fused_free_share = 0.8;   ///< 1
  int fused_vehicle_detections = 2;
  double fused_history = 0.5;     ///< s
  double fused_proof_time = 2.0;  ///< s

  void visit(OptionVisitor& visitor);
};

/// That two objects of which nothing is known are of the same class.
inline constexpr double kChanceOfClass = 1.0 / static_cast<double>(kObjectClasses);

/// No observation of a scan.
inline constexpr std::size_t kUnseen = std::numeric_limits<std::size_t>::max();

/// Something that is followed, whether it moves or not: filter, box, evidence of motion and history
/// of one track. Confirmed targets have an id. Cheap to copy: each leaf of a track tree is one.
class Target {
 public:
  /// From the first object, in the fixed frame, and its index in the scan. `number`: the same for
  /// all hypotheses of a target, rising from target to target.
  /// `transitions`: what it learns of its jumps between motion modes; none: nothing.
  Target(const Object& object, std::size_t index, std::uint64_t number,
         const TargetOptions& options,
         const std::optional<TransitionModel>& transitions = std::nullopt);

  /// To the time of the next scan, `seconds` >= 0 ahead; `steps` are of the same time. It moves as
  /// those of its most likely class do.
  void predict(double seconds, const ImmSteps& steps, const TargetOptions& options);

  /// Takes in what it was seen as in the present scan, and the index of that. Probability of
  /// detection: as for miss().
  void update(const Observation& observation, std::size_t index, double detection_probability,
              const TargetOptions& options);

  /// The present scan shows no object of this target, and would have with this probability if it
  /// were there.
  void miss(double detection_probability, const TargetOptions& options);

  /// The object as a measurement of this target's position.
  PositionMeasurement measurementOf(const Object& object) const {
    return box_.measurementOf(object);
  }

  /// That an object is of this target's class, by the classes reported for both; of one whose class
  /// is not known it is chance: one in kObjectClasses.
  double sameClassProbability(const Object& object) const;

  /// By its objects alone.
  bool evidentlyMoves(const TargetOptions& options) const {
    return evidence_.suffices(filter_.estimate(), options.evidence);
  }

  /// By its velocity and by what all beams of the last scans saw at its positions; `now`: the time
  /// of its state. Where they saw nothing of them and no sensor measured its velocity, by its
  /// objects alone.
  bool movesByBeams(const ScanHistory& history, Stamp now, const TargetOptions& options) const;

  /// Two sensors see it now, one of which sees it move (thesis 3.3.3), and nothing that it did
  /// before says that it stands.
  ///
  /// The thesis takes that for a fact at the first detection. But vehicles stand at every curb, and
  /// what is beside one, or an echo of the curb below it, looks as if it moved: that one moves has
  /// to be seen more than once. Who was followed for longer has shown by then whether it moves.
  bool isSeenMovingByTwo(const TargetOptions& options) const;

  /// It was taken for a moving object before its own motion was evident, and has had the time to
  /// show that it does not move.
  bool motionRefuted(const TargetOptions& options) const {
    return confirmed() && !has_moved_ && followed() > options.fused_proof_time && !mayMove(options);
  }

  /// That it is something at all and not a chain of false alarms, from the track score (Blackman
  /// 2004).
  double existenceProbability(const TargetOptions& options) const;

  /// It becomes a track; `moves`: as far as is known now.
  void confirm(std::uint32_t id, bool moves);

  /// As its class becomes known; without effect where nothing is learned.
  void setTransitionPrior(const JumpCounts& prior) { filter_.setTransitionPrior(prior); }
  bool confirmed() const { return id_ != 0; }
  std::uint32_t id() const { return id_; }
  std::uint64_t number() const { return number_; }

  const ImmFilter& filter() const { return filter_; }
  Box2 box() const { return box_.at(filter_.estimate().mean.head<2>()); }
  /// m^2, of the box's center: by the filter, and by the size that is not known.
  Eigen::Matrix2d positionCovariance() const {
    return filter_.estimate().covariance.topLeftCorner<2, 2>() + box_.centerCovariance();
  }
  ObjectClass objectClass() const { return class_.mostLikely(); }
  const std::vector<std::string>& sensors() const { return *sensors_; }
  /// Index of its object in the present scan; kUnseen: missed.
  std::size_t measurementIndex() const { return measurement_index_; }
  std::uint32_t hits() const { return hits_; }
  double sinceUpdate() const { return since_update_; }  ///< s
  /// s, from the first to the last object.
  double followed() const { return age_ - since_update_; }

  /// What is published of it, but what only the tracker knows.
  Track track(const TargetOptions& options) const;

 private:
  void takeVelocity(const MeasuredVelocity& measured, const TargetOptions& options);
  void judgeMotion(const TargetOptions& options);
  bool mayMove(const TargetOptions& options) const {
    return mayBeAsFastAs(filter_.estimate(), options.evidence.speed_significance,
                         options.evidence.min_speed);
  }

  TrackedBox box_;
  ImmFilter filter_;
  MotionEvidence evidence_;
  /// Logarithm of how much likelier its objects are for one moving object than for clutter. Other
  /// than the score of existence it is not limited: it looks back at all that is known.
  double association_score_ = 0.0;
  SeenPointHistory seen_points_;  ///< until it is confirmed
  std::uint64_t number_;
  std::uint32_t id_ = 0;
  std::size_t measurement_index_;
  std::uint32_t hits_ = 1;
  bool moving_ = false;
  bool has_moved_ = false;          ///< as it was seen to, once at least
  bool velocity_measured_ = false;  ///< by some sensor, once at least
  double age_ = 0.0;
  double since_update_ = 0.0;
  double height_;
  double motion_log_odds_;
  int detections_of_two_;  ///< in a row: two sensors saw it, one of them saw it move
  ClassBelief class_;
  std::shared_ptr<const std::vector<std::string>> sensors_;  ///< shared: a target is copied often
};

}  // namespace datmo
