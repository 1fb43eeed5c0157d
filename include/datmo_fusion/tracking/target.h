// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "datmo_fusion/common/class_belief.h"
#include "datmo_fusion/common/object.h"
#include "datmo_fusion/common/options.h"
#include "datmo_fusion/tracking/class_by_speed.h"
#include "datmo_fusion/tracking/existence_score.h"
#include "datmo_fusion/tracking/imm_filter.h"
#include "datmo_fusion/tracking/motion_by_class.h"
#include "datmo_fusion/tracking/motion_likelihood.h"
#include "datmo_fusion/tracking/track.h"
#include "datmo_fusion/tracking/tracked_box.h"
#include "datmo_fusion/visibility/seen_points.h"

namespace datmo {

struct Observation;

/// How the classes of one sensor's objects are derived.
struct SensorClassOptions {
  bool class_by_size = true;
  bool measures_size = true;

  void visit(OptionVisitor& visitor);
};

struct TargetOptions {
  ImmOptions filter;
  TrackedBoxOptions box;
  ExistenceOptions existence;
  MotionLikelihoodOptions motion_likelihood;
  ClassBySpeedOptions class_by_speed;
  MotionByClassOptions motion_by_class;
  double birth_speed_std = 8.0;  ///< m/s
  double stop_speed = 0.4;       ///< m/s
  /// By Object::sensors. The classes of the scanner's objects come from the image (MonoClassifier).
  std::map<std::string, SensorClassOptions> sensors = {
      {"lidar", {false, true}}, {"mono", {false, false}}, {"radar", {false, false}}};

  void visit(OptionVisitor& visitor);

  /// Returns whether the class of an object already includes its size: one of its sensors
  /// classifies by size, or is unknown, and no other kind of sensor measured the size as well.
  bool hasClassBySize(const Object& object) const;
};

/// Probability that two objects of unknown class are of the same class.
inline constexpr double kChanceOfClass = 1.0 / static_cast<double>(kObjectClasses);

/// No observation of a scan.
inline constexpr std::size_t kUnseen = std::numeric_limits<std::size_t>::max();

/// A followed object, moving or not: filter, box, existence and observed points of one track.
/// Confirmed targets have an id. Cheap to copy: each leaf of a track tree is one.
class Target {
 public:
  /// Starts from the first object, in the fixed frame, and its index in the scan. `number`: the
  /// same in all hypotheses of a target, ascending from target to target. `transitions`: model from
  /// which jumps between motion modes are learned; none: they are not.
  Target(const Object& object, std::size_t index, std::uint64_t number,
         const TargetOptions& options,
         const std::optional<TransitionModel>& transitions = std::nullopt);

  /// Predicts to the time of the next scan, `seconds` >= 0 ahead; `steps` are for the same time.
  /// The motion is that of its most likely class.
  void predict(double seconds, const ImmSteps& steps, const TargetOptions& options);

  /// Updates with its observation in the current scan, and the index of that. Detection
  /// probability: as for miss().
  void update(const Observation& observation, std::size_t index, double detection_probability,
              const TargetOptions& options);

  /// Updates with a missed detection in the current scan; `detection_probability`: given that it
  /// exists.
  void miss(double detection_probability, const TargetOptions& options);

  /// Updates its class with that of one of its objects, by a sensor that does not measure size.
  void updateClass(const ClassProbabilities& reported) { class_.update(reported); }

  /// Returns the object as a measurement of this target's position.
  PositionMeasurement measurementOf(const Object& object) const {
    return box_.measurementOf(object);
  }

  /// Returns the gate of objects within this squared Mahalanobis distance.
  CenterGate gateOf(double gate) const { return box_.gateOf(filter_.estimate(), gate); }

  /// Returns the probability that an object is of this target's class, by the classes reported for
  /// both; if a class is unknown, it is chance: one in kObjectClasses.
  double sameClassProbability(const Observation& observation) const;

  /// Returns the probability that it moves and exists, given its position, its velocity, and the
  /// beams of recent scans at its positions; `now`: the time of its state. Without beams, as for a
  /// camera, only by the others. Must not be called for confirmed targets: their observed points
  /// are dropped.
  double motionProbability(const ScanHistory& history, Stamp now,
                           const TargetOptions& options) const;

  /// Returns the probability that it exists and is not a chain of false alarms, from the track
  /// score (Blackman 2004).
  double existenceProbability(const TargetOptions& options) const {
    return existence_.probability(options.existence);
  }

  /// Sets the id under which it is published once it is confirmed, from 1.
  void setId(std::uint32_t id) { id_ = id; }
  /// Makes it a track, the `order`th of all, from 1; `moves`: as far as is known now.
  void confirm(std::uint64_t order, bool moves);

  /// Sets the prior once its class is known; no effect if nothing is learned.
  void setTransitionPrior(const JumpCounts& prior) { filter_.setTransitionPrior(prior); }
  bool confirmed() const { return confirmed_as_ != 0; }
  /// Returns its position in the order of confirmations, from 1; 0: not confirmed.
  std::uint64_t confirmedAs() const { return confirmed_as_; }
  std::uint32_t id() const { return id_; }  ///< 0: none
  std::uint64_t number() const { return number_; }

  const ImmFilter& filter() const { return filter_; }
  Box2 box() const { return box_.at(filter_.estimate().mean.head<2>()); }
  /// Returns the covariance of the box's center, m^2: from the filter, and from the uncertain size.
  Eigen::Matrix2d positionCovariance() const {
    return filter_.estimate().covariance.topLeftCorner<2, 2>() + box_.centerCovariance();
  }
  ObjectClass objectClass() const { return class_.mostLikely(); }
  const std::vector<std::string>& sensors() const { return *sensors_; }
  /// Returns the index of its object in the current scan; kUnseen: missed.
  std::size_t measurementIndex() const { return measurement_index_; }
  std::uint32_t hits() const { return hits_; }
  double sinceUpdate() const { return since_update_; }  ///< s
  /// Returns the time from the first to the last object, s.
  double followed() const { return age_ - since_update_; }

  /// Returns the published track, except for what only the tracker knows.
  Track track(const TargetOptions& options) const;

 private:
  void updateClass(const Object& object, const TargetOptions& options);
  void updateVelocity(const MeasuredVelocity& measured, const TargetOptions& options);
  void judgeMotion(const TargetOptions& options);
  double falseMotion(const TargetOptions& options) const;
  double trackedVelocityEvidence(double false_motion, const TargetOptions& options) const;

  // Data that is read for all targets several times per step comes first, side by side: many
  // targets do not fit in the cache.
  std::uint64_t number_;
  std::uint64_t confirmed_as_ = 0;
  std::uint32_t id_ = 0;
  std::uint32_t hits_ = 1;
  std::size_t measurement_index_;
  double age_ = 0.0;
  double since_update_ = 0.0;
  ExistenceScore existence_;
  ClassBelief class_;
  bool moving_ = false;
  TrackedBox box_;
  ImmFilter filter_;
  /// 0 to 1, smallest likelihood ratio so far of its velocity, standing versus moving.
  double standing_velocity_ratio_ = 1.0;
  double height_;
  double motion_log_odds_;
  ClassBelief class_by_size_;     ///< of `class_`, from the reports that include size
  SeenPointHistory seen_points_;  ///< until it is confirmed
  std::shared_ptr<const std::vector<std::string>> sensors_;  ///< shared: a target is copied often
};

}  // namespace datmo
