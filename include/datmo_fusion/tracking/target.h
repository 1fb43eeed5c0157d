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

/// What the classes are made from that come with the objects of one sensor.
struct SensorClassOptions {
  bool class_by_size = true;

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
  /// By Object::sensors. The scanner's objects have classes by what an image shows
  /// (MonoClassifier).
  std::map<std::string, SensorClassOptions> sensors = {
      {"lidar", {false}}, {"mono", {false}}, {"radar", {false}}};

  void visit(OptionVisitor& visitor);

  /// Whether the class of an object has its size in it already: one of its sensors tells classes by
  /// it, or is not known.
  bool hasClassBySize(const Object& object) const;
};

/// That two objects of which nothing is known are of the same class.
inline constexpr double kChanceOfClass = 1.0 / static_cast<double>(kObjectClasses);

/// No observation of a scan.
inline constexpr std::size_t kUnseen = std::numeric_limits<std::size_t>::max();

/// Something that is followed, whether it moves or not: filter, box, existence and observed points
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

  /// Which objects may be measurements within this Mahalanobis distance squared.
  CenterGate gateOf(double gate) const { return box_.gateOf(filter_.estimate(), gate); }

  /// That an object is of this target's class, by the classes reported for both; of one whose class
  /// is not known it is chance: one in kObjectClasses.
  double sameClassProbability(const Object& object) const;

  /// That it moves and exists, by where it lies, by its velocity, and by what all beams of the last
  /// scans observed at its positions; `now`: the time of its state. Without beams, as of a camera,
  /// by the others alone. Not to be asked of confirmed targets: their observed points are
  /// forgotten.
  double motionProbability(const ScanHistory& history, Stamp now,
                           const TargetOptions& options) const;

  /// That it is something at all and not a chain of false alarms, from the track score (Blackman
  /// 2004).
  double existenceProbability(const TargetOptions& options) const {
    return existence_.probability(options.existence);
  }

  /// Before it is confirmed: the id that it is published under, from 1.
  void setId(std::uint32_t id) { id_ = id; }
  /// It becomes a track, the `order`th of all, from 1; `moves`: as far as is known now.
  void confirm(std::uint64_t order, bool moves);

  /// As its class becomes known; without effect where nothing is learned.
  void setTransitionPrior(const JumpCounts& prior) { filter_.setTransitionPrior(prior); }
  bool confirmed() const { return confirmed_as_ != 0; }
  /// As which of all it was confirmed; 0: not.
  std::uint64_t confirmedAs() const { return confirmed_as_; }
  std::uint32_t id() const { return id_; }  ///< 0: none
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
  void takeClass(const Object& object, const TargetOptions& options);
  void takeVelocity(const MeasuredVelocity& measured, const TargetOptions& options);
  void judgeMotion(const TargetOptions& options);
  double falseMotion(const TargetOptions& options) const;
  double trackedVelocityEvidence(double false_motion, const TargetOptions& options) const;

  // What is asked of all targets several times in a step comes first, side by side: many targets
  // are more than the cache holds.
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
  /// 0 to 1, how likely the velocity that tells most is if it stands, over how likely if it moves.
  double standing_velocity_ratio_ = 1.0;
  double height_;
  double motion_log_odds_;
  ClassBelief class_by_size_;     ///< of `class_`, by the reports that have a size in them
  SeenPointHistory seen_points_;  ///< until it is confirmed
  std::shared_ptr<const std::vector<std::string>> sensors_;  ///< shared: a target is copied often
};

}  // namespace datmo
