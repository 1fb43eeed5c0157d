// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/slam/map_search.h"

namespace datmo {

MapSearchOptions MapSearchOptions::inCompleteMap() {
  MapSearchOptions options;
  options.missing_share = 0.06;
  options.max_log_ratio = 3.0;
  options.min_shared = 0.5;
  options.max_aligned_sigma = 0.0;
  options.max_boxes = 4000000;
  return options;
}

void MapSearchOptions::visit(OptionVisitor& visitor) {
  visitor.number({"missing_share", "1",
                  "mean share of the surfaces of the newer map that are missing in a map of the "
                  "whole area; 0: the older map covers a part, and what it lacks does not count"},
                 missing_share, {0.0, 1.0});
  visitor.number(
      {"max_log_ratio", "1", "hypotheses are kept up to this log-likelihood ratio to the best one"},
      max_log_ratio, {0.0, 1000.0});
  visitor.number({"max_aligned_sigma", "m",
                  "if several poses fit, the maps are aligned if a covariance that reaches all of "
                  "them leaves no surface up to `reach` less certain than this (standard "
                  "deviation); 0: never"},
                 max_aligned_sigma, {0.0, 100.0});
  visitor.number({"reach", "m", "surfaces up to this range are compared"}, reach, {1.0, 1000.0});
  visitor.integer({"max_boxes", "1", "boxes of poses after which a search ends as ambiguous"},
                  max_boxes, {1, 100000000});
}

}  // namespace datmo
