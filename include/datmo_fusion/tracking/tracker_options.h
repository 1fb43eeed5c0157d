// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "datmo_fusion/common/options.h"
#include "datmo_fusion/tracking/association.h"
#include "datmo_fusion/tracking/association_scan.h"
#include "datmo_fusion/tracking/clutter_map.h"
#include "datmo_fusion/tracking/duplicates.h"
#include "datmo_fusion/tracking/hypothesis_expansion.h"
#include "datmo_fusion/tracking/split_merge.h"
#include "datmo_fusion/tracking/target.h"
#include "datmo_fusion/visibility/scan_history.h"
#include "datmo_fusion/visibility/visibility.h"

namespace datmo {

/// How objects are associated with targets: over several scans, or in each scan by itself.
enum class TrackerAssociation { kMultipleHypotheses, kGlobalNearestNeighbor };

struct TrackerOptions {
  TrackerAssociation association = TrackerAssociation::kMultipleHypotheses;
  HypothesisOptions hypotheses;
  SplitMergeOptions split_merge;
  ScanIntakeOptions intake;
  AssociationOptions gating;
  ClutterMapOptions clutter;
  VisibilityOptions visibility;
  ScanHistoryOptions scans;
  TargetOptions target;
  DuplicateOptions duplicates;
  bool require_motion = true;
  int confirmation_hits = 3;
  double confirmation_existence = 0.5;  ///< 1
  double min_existence = 0.25;          ///< 1
  double published_existence = 0.5;     ///< 1
  double tentative_silence = 1.0;       ///< s
  double confirmed_silence = 3.0;       ///< s
  double published_silence = 1.5;       ///< s
  double max_position_std = 5.0;        ///< m
  double history_time = 3.0;            ///< s
  double time_budget = 0.03;            ///< s

  void visit(OptionVisitor& visitor);
};

}  // namespace datmo
