#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "datmo_fusion/common/object.h"
#include "datmo_fusion/common/options.h"
#include "datmo_fusion/tracking/imm_filter.h"
#include "datmo_fusion/tracking/motion_evidence.h"
#include "datmo_fusion/tracking/track.h"
#include "datmo_fusion/tracking/tracked_box.h"

namespace datmo {

struct TargetOptions {
  ImmOptions filter;
  TrackedBoxOptions box;
  MotionEvidenceOptions evidence;
  double birth_speed_std = 8.0;  ///< m/s
  double stop_speed = 0.4;       ///< m/s

  void visit(OptionVisitor& visitor);
};

/// Something that is followed, whether it moves or not: filter, box, evidence of motion and history
/// of one track. Confirmed targets have an id. A track tree of the multiple hypotheses to come has
/// one of these at each leaf.
class Target {
 public:
  /// From the first object, in the fixed frame.
  Target(const Object& object, const TargetOptions& options);

  /// To the time of the next scan, `seconds` >= 0 ahead; `step` is of the same time.
  void predict(double seconds, const ImmStep& step, const TargetOptions& options);

  /// Takes in an object of the present scan.
  void update(const Object& object, const TargetOptions& options);

  /// The present scan shows no object of this target.
  void miss(const TargetOptions& options) { evidence_.miss(options.evidence); }

  /// The object as a measurement of this target's position.
  PositionMeasurement measurementOf(const Object& object) const {
    return box_.measurementOf(object);
  }

  /// Objects of two different known classes are never the same (thesis 3.3.4).
  bool mayBe(const Object& object) const;

  bool evidentlyMoves(const TargetOptions& options) const {
    return evidence_.suffices(filter_.estimate(), options.evidence);
  }

  /// Nothing speaks for it any more.
  bool isSpent() const { return evidence_.isSpent(); }

  void confirm(std::uint32_t id);
  bool confirmed() const { return id_ != 0; }
  std::uint32_t id() const { return id_; }

  const ImmFilter& filter() const { return filter_; }
  Box2 box() const { return box_.at(filter_.estimate().mean.head<2>()); }
  std::uint32_t hits() const { return hits_; }
  double sinceUpdate() const { return since_update_; }  ///< s
  /// s, from the first to the last object.
  double followed() const { return age_ - since_update_; }

  Track track(const TargetOptions& options) const;

 private:
  void judgeMotion(const TargetOptions& options);
  void classify(const Object& object);

  ImmFilter filter_;
  TrackedBox box_;
  MotionEvidence evidence_;
  std::uint32_t id_ = 0;
  std::uint32_t hits_ = 1;
  bool moving_ = false;
  double age_ = 0.0;
  double since_update_ = 0.0;
  double height_;
  ObjectClass object_class_;
  double class_probability_;
  std::vector<std::string> sensors_;
};

}  // namespace datmo
