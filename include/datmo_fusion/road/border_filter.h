// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "datmo_fusion/common/object.h"
#include "datmo_fusion/common/options.h"
#include "datmo_fusion/common/scan.h"
#include "datmo_fusion/road/border_offset.h"
#include "datmo_fusion/road/free_space_entry_test.h"
#include "datmo_fusion/road/road_extension.h"
#include "datmo_fusion/road/road_model.h"
#include "datmo_fusion/visibility/scan_history.h"

namespace datmo {

struct BorderFilterOptions {
  static constexpr char kConsistent[] = "consistent";
  static constexpr char kThesis[] = "thesis";

  std::string method = kConsistent;
  double margin = 0.5;              ///< m
  double sigmas = 1.0;              ///< 1
  double max_sigma = 1.0;           ///< m
  double reach = 30.0;              ///< m
  double required_on_border = 3.0;  ///< 1
  double required_beyond = 1.0;     ///< 1
  ScanHistoryOptions history;
  FreeSpaceEntryTestOptions free_space_entry;
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
  double motion_evidence = 0.0;  ///< as FreeSpaceEntryTest says
};

/// Takes objects on and beyond the road's borders that seem to move for false alarms (thesis
/// 3.5.1), unless they move consistently there (thesis 2.4, 6.2): a pedestrian on the footpath, a
/// car out of a driveway. What a mover leaves and enters was seen free, and a curb was not
/// (FreeSpaceEntryTest): that is decided from its first detection on, before it could be tracked.
///
/// An object lies on a border or beyond if all of its points do; by the thesis, if a corner of its
/// rectangle does, and however it moves. Where no border is known the road is taken to go on as it
/// was (RoadExtension). Objects that nobody says to move are left alone.
class BorderFilter {
 public:
  /// Throws OptionError.
  explicit BorderFilter(const BorderFilterOptions& options);

  /// Removes from `objects`, which were found in `scan`, what is a false alarm by `road` (map
  /// frame); returns what was removed. Scans by rising stamps, all of them: those without objects
  /// too.
  std::vector<DroppedObject> filter(const LabeledScan& scan, const RoadModel& road,
                                    ObjectList& objects);

  /// Forgets where the road went on when no border was known.
  void forgetRoad() { extension_.reset(); }

  /// Forgets all, as at the start.
  void reset();

 private:
  /// How an object lies on a border or beyond.
  struct Outside {
    DroppedObject reason;
    BorderOffset offset;
    double required = 0.0;  ///< evidence of motion
  };

  /// By the borders that are known.
  std::optional<Outside> outsideKnown(const Object& object, const std::vector<Point2>& positions,
                                      const Pose2& base_in_map, const RoadModel& road) const;
  /// Where none is known, by how the road goes on.
  std::optional<Outside> outsideExtension(const std::vector<Point2>& positions) const;
  std::optional<DroppedObject> falseAlarm(const Object& object, const Pose2& base_in_map,
                                          const RoadModel& road) const;

  BorderFilterOptions options_;
  ScanHistory history_;
  FreeSpaceEntryTest entry_test_;
  RoadExtension extension_;
};

}  // namespace datmo
