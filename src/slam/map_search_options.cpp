// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/slam/map_search.h"

namespace datmo {

MapSearchOptions MapSearchOptions::inCompleteMap() {
  MapSearchOptions options;
  options.missing_share = 0.06;
  options.max_log_ratio = 3.0;
  options.min_shared = 0.5;
  options.max_boxes = 4000000;
  return options;
}

void MapSearchOptions::visit(OptionVisitor& visitor) {
  visitor.number({"changed_share", "1",
                  "mean share of surfaces of one map that another one of the same place, made a "
                  "short time later, contradicts"},
                 changed_share, {0.001, 1.0});
  visitor.number({"missing_share", "1",
                  "mean share of surfaces of the newer map that a map of all of the area has not; "
                  "0: the older map is of a part, and what it lacks counts nothing"},
                 missing_share, {0.0, 1.0});
  visitor.number(
      {"max_log_ratio", "1", "hypotheses live up to this log-likelihood ratio to the best one"},
      max_log_ratio, {0.0, 1000.0});
  visitor.number({"max_changed_share", "1", "no pose that is contradicted by more is found"},
                 max_changed_share, {0.0, 1.0});
  visitor.number({"min_shared", "1", "share of surfaces that both maps have, at the pose found"},
                 min_shared, {0.0, 1.0});
  visitor.integer({"min_surfaces", "1", "static cells of the newer map with which it is searched"},
                  min_surfaces, {1, 1000000});
  visitor.number({"reach", "m", "surfaces up to here are compared"}, reach, {1.0, 1000.0});
  visitor.integer({"max_boxes", "1", "boxes of poses after which a search ends as ambiguous"},
                  max_boxes, {1, 100000000});
}

}  // namespace datmo
