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

/// What becomes of objects on a border or beyond (BorderFilter).
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

/// An object that was left out, and why.
struct DroppedObject {
  Object object;
  DropReason reason = DropReason::kOnBorder;
  RoadSide side = RoadSide::kLeft;
  double beyond = 0.0;  ///< m from the border to it, away from the road; negative: it reaches in
};

/// Tells apart what lies on the road from what lies on its borders and beyond, where more stands
/// and less moves: curbs, hedges, parked rows.
///
/// That is evidence and no verdict: such objects are no longer said to move
/// (DynamicState::kUnknown) and carry the odds that what lies there does (Object::motion_log_odds),
/// which the tracker weighs against what the beams say (motionProbability), so that a pedestrian on
/// the footpath or a car out of a driveway is followed nevertheless (thesis 2.4, 6.2). The thesis
/// takes them for false alarms however they move, and drops them (thesis 3.5.1).
///
/// An object lies on a border or beyond if all of its points do; by the thesis, if a corner of its
/// rectangle does. Where no border is known the road is taken to go on as it was (RoadExtension).
/// What is known to stand is left alone, by the thesis all that is not said to move.
class BorderFilter {
 public:
  /// Throws OptionError.
  explicit BorderFilter(const Checked<BorderFilterOptions>& options);

  /// Of `objects`, seen from `base_in_map` (the vehicle's pose), those that lie outside `road` (map
  /// frame) get their odds; by the thesis they are removed and returned.
  std::vector<DroppedObject> filter(const Pose2& base_in_map, const RoadModel& road,
                                    ObjectList& objects);

  /// Forgets where the road went on when no border was known.
  void forgetRoad() { extension_.reset(); }

 private:
  /// How an object lies on a border or beyond; none: on the road, or nothing is known.
  std::optional<DroppedObject> outside(const Object& object, const Pose2& base_in_map,
                                       const RoadModel& road) const;
  /// By the borders that are known.
  std::optional<DroppedObject> outsideKnown(const Object& object,
                                            const std::vector<Point2>& positions,
                                            const Pose2& base_in_map, const RoadModel& road) const;
  /// Where none is known, by how the road goes on.
  std::optional<DroppedObject> outsideExtension(const std::vector<Point2>& positions) const;

  BorderFilterOptions options_;
  RoadExtension extension_;
};

}  // namespace datmo
