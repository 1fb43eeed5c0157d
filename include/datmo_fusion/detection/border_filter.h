// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "datmo_fusion/common/object.h"
#include "datmo_fusion/common/options.h"
#include "datmo_fusion/common/pose2.h"
#include "datmo_fusion/road/border_offset.h"
#include "datmo_fusion/road/road_extension.h"
#include "datmo_fusion/road/road_model.h"

namespace datmo {

/// How objects on or beyond a border are treated (BorderFilter).
enum class BorderFilterMethod { kEvidence, kThesis };

struct BorderFilterOptions {
  BorderFilterMethod method = BorderFilterMethod::kEvidence;
  double margin = 0.5;            ///< m
  double sigmas = 1.0;            ///< 1
  double max_sigma = 1.0;         ///< m
  double reach = 30.0;            ///< m
  double motion_log_odds = -2.0;  ///< 1
  RoadExtensionOptions extension;

  void visit(OptionVisitor& visitor);
};

/// Why an object is a false alarm; values as in DroppedObject.msg.
enum class DropReason : std::uint8_t { kOnBorder, kBeyondBorder };

/// An object that was dropped, and why.
struct DroppedObject {
  Object object;
  DropReason reason = DropReason::kOnBorder;
  RoadSide side = RoadSide::kLeft;
  double beyond = 0.0;  ///< m from the border, away from the road; negative: onto the road
};

/// Separates objects on the road from those on or beyond its borders, where more is static: curbs,
/// hedges, parked rows.
///
/// evidence: position is used as evidence rather than a decision. Such objects lose the state
/// moving (DynamicState::kUnknown) and get the prior log odds that objects there move
/// (Object::motion_log_odds), which the tracker weighs against the beams (motionProbability), so
/// that a pedestrian on the sidewalk or a car leaving a driveway is still tracked (thesis 2.4,
/// 6.2). The thesis considers them false alarms whatever their motion, and drops them (thesis
/// 3.5.1).
///
/// An object is on or beyond a known border if all of its points are; in the thesis, if a corner of
/// its rectangle is. Where no border is known for all of them the road is extrapolated
/// (RoadExtension), and points that lie beside neither say nothing. Static objects are not
/// affected; in the thesis, nor is any object that is not moving.
class BorderFilter {
 public:
  /// Throws OptionError.
  explicit BorderFilter(const Checked<BorderFilterOptions>& options);

  /// Assigns the prior log odds to those of `objects`, seen from `base_in_map` (the vehicle's
  /// pose), that lie outside `road` (map frame); in the thesis's method they are removed and
  /// returned.
  std::vector<DroppedObject> filter(const Pose2& base_in_map, const RoadModel& road,
                                    ObjectList& objects);

  /// Forgets the extrapolation of the road.
  void forgetRoad() { extension_.reset(); }

 private:
  /// How an object lies on or beyond a border; none: it is on the road, or nothing is known.
  std::optional<DroppedObject> outside(const Object& object, const Pose2& base_in_map,
                                       const RoadModel& road) const;
  /// By the known borders.
  std::optional<DroppedObject> outsideKnown(const Object& object,
                                            const std::vector<Point2>& positions,
                                            const Pose2& base_in_map, const RoadModel& road) const;
  /// Where none is known for all of it, by the extrapolated road as well.
  std::optional<DroppedObject> outsideExtension(const std::vector<Point2>& positions,
                                                const RoadModel& road) const;
  /// Offset of a point from the extrapolated border on this side, or else from the nearest known
  /// one; none: neither is beside it.
  std::optional<BorderOffset> offsetOn(RoadSide side, const Point2& position,
                                       const RoadModel& road) const;

  BorderFilterOptions options_;
  RoadExtension extension_;
};

}  // namespace datmo
