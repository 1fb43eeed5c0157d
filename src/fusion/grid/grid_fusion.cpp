// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/fusion/grid/grid_fusion.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <stdexcept>

namespace datmo {

namespace {

constexpr float kPercent = 100.0F;

/// Half a percent, the resolution of grids: limits the log odds, which would otherwise be
/// unbounded.
constexpr float kMinProbability = 0.005F;

/// Agreement below the rounding error of floats.
constexpr float kNoAgreement = 1e-6F;

/// Evidence in a source's value of a cell.
struct ValueEvidence {
  // Plausibility of occupied and of free, and the mass committed to neither: Dempster's rule
  // multiplies each of the three over the sources (commonality, Shafer 1976).
  float may_be_occupied = 1.0F;
  float may_be_free = 1.0F;
  float open = 1.0F;

  float probability = 0.5F;  ///< of being occupied, discounted by the source's reliability
  float weighted = 0.0F;     ///< weight * percent
};

ValueEvidence evidenceOf(float value, const GridSourceOptions& source) {
  const auto reliability = static_cast<float>(source.reliability);
  const float evidence = reliability * (2.0F * value - 1.0F);  // positive: for occupied
  ValueEvidence value_evidence;
  value_evidence.may_be_occupied = 1.0F - std::max(0.0F, -evidence);
  value_evidence.may_be_free = 1.0F - std::max(0.0F, evidence);
  value_evidence.open = std::min(value_evidence.may_be_occupied, value_evidence.may_be_free);
  value_evidence.probability =
      std::clamp(0.5F + 0.5F * evidence, kMinProbability, 1.0F - kMinProbability);
  value_evidence.weighted = static_cast<float>(source.weight) * kPercent * value;
  return value_evidence;
}

/// One source with a table of the evidence of each value.
struct Source {
  const Percent* cells;
  float weight;
  std::array<ValueEvidence, std::numeric_limits<Percent>::max() + 1> evidence_of_value;

  explicit Source(const WeightedGrid& weighted)
      : cells(weighted.grid->cells().data()), weight(static_cast<float>(weighted.source.weight)) {
    for (std::size_t percent = 0; percent < evidence_of_value.size(); ++percent) {
      // Values above 100 count as 100.
      const float value = std::min(1.0F, static_cast<float>(percent) / kPercent);
      evidence_of_value[percent] = evidenceOf(value, weighted.source);
    }
  }
};

/// `value`: 0 to 100. Does not use std::lround, which would take longer than everything else.
Percent rounded(float value) {
  constexpr float kHalf = 0.5F;
  return static_cast<Percent>(value + kHalf);
}

/// The evidence of several sources on one cell, combined by Dempster's rule but not normalized.
class Evidence {
 public:
  void add(const ValueEvidence& value_evidence) {
    may_be_occupied_ *= value_evidence.may_be_occupied;
    may_be_free_ *= value_evidence.may_be_free;
    open_ *= value_evidence.open;
  }
  /// Share of evidence without contradiction, 0 to 1.
  float agreement() const { return may_be_occupied_ + may_be_free_ - open_; }
  float pignisticProbability() const {
    return agreement() < kNoAgreement ? 0.5F : (may_be_occupied_ - 0.5F * open_) / agreement();
  }

 private:
  float may_be_occupied_ = 1.0F;
  float may_be_free_ = 1.0F;
  float open_ = 1.0F;
};

// The rules: each processes, source by source, the evidence on one cell.

struct WeightedSum {
  float sum = 0.0F;
  float weights = 0.0F;
  void add(const Source& source, Percent, const ValueEvidence& value_evidence) {
    sum += value_evidence.weighted;
    weights += source.weight;
  }
  Percent result(const Evidence&) const { return rounded(sum / weights); }
};

/// Sources come in the order of their priority.
struct Priority {
  Percent first = kUnknownPercent;
  void add(const Source&, Percent value, const ValueEvidence&) {
    first = first == kUnknownPercent ? value : first;
  }
  Percent result(const Evidence&) const { return first; }
};

struct Maximum {
  Percent max = kUnknownPercent;
  void add(const Source&, Percent value, const ValueEvidence&) { max = std::max(max, value); }
  Percent result(const Evidence&) const { return max; }
};

/// Multiplies the odds, which is equivalent and needs no logarithm.
struct LogOdds {
  float occupied = 1.0F;
  float free = 1.0F;
  void add(const Source&, Percent, const ValueEvidence& value_evidence) {
    occupied *= value_evidence.probability;
    free *= 1.0F - value_evidence.probability;
  }
  Percent result(const Evidence&) const { return rounded(kPercent * occupied / (occupied + free)); }
};

struct DempsterShafer {
  void add(const Source&, Percent, const ValueEvidence&) {}
  Percent result(const Evidence& evidence) const {
    return rounded(kPercent * evidence.pignisticProbability());
  }
};

template <typename Rule>
void fuseCells(const std::vector<Source>& sources, FusedGrids& result) {
  const std::size_t cells = result.fused.cells().size();
  // Bytes may alias anything: hoisted out of the loop, so that it is not reloaded for each cell.
  Percent* const fused = result.fused.cells().data();
  Percent* const conflict = result.conflict.cells().data();
  for (std::size_t cell = 0; cell < cells; ++cell) {
    int known = 0;
    Percent value = kUnknownPercent;
    Rule rule;
    Evidence evidence;
    for (const Source& source : sources) {
      if (source.cells[cell] < 0) {
        continue;
      }
      ++known;
      value = source.cells[cell];
      const ValueEvidence& value_evidence =
          source.evidence_of_value[static_cast<std::uint8_t>(value)];
      rule.add(source, value, value_evidence);
      evidence.add(value_evidence);
    }
    if (known > 1) {
      fused[cell] = rule.result(evidence);
      conflict[cell] = rounded(kPercent * (1.0F - evidence.agreement()));
    } else {
      fused[cell] = value;
    }
  }
}

void checkWindows(const std::vector<WeightedGrid>& grids) {
  if (grids.empty()) {
    throw std::invalid_argument("fuseGrids: expected at least one grid");
  }
  for (const WeightedGrid& weighted : grids) {
    if (weighted.grid->window() != grids.front().grid->window()) {
      throw std::invalid_argument("fuseGrids: expected grids of one window");
    }
  }
}

}  // namespace

void GridSourceOptions::visit(OptionVisitor& visitor) {
  visitor.toggle({"use", "", "whether this source is fused", Tier::kPublic}, use);
  visitor.integer({"priority", "1",
                   "rule priority: among the sources that see a cell, the one with the highest "
                   "priority decides (thesis eq. 3.2.6: vision before the lidar)"},
                  priority, {-100, 100});
  visitor.number({"weight", "1", "rule weighted_sum: weight in the mean (thesis eq. 3.2.5: alpha)"},
                 weight, {0.01, 1.0});
  visitor.number({"reliability", "1",
                  "rules log_odds and dempster_shafer, and the conflict: how often the source is "
                  "right; the rest of its evidence is discounted (Shafer 1976)"},
                 reliability, {0.0, 1.0});
}

FusedGrids fuseGrids(FusionRule rule, const std::vector<WeightedGrid>& grids) {
  checkWindows(grids);
  std::vector<WeightedGrid> ordered = grids;
  std::stable_sort(ordered.begin(), ordered.end(),
                   [](const WeightedGrid& a, const WeightedGrid& b) {
                     return a.source.priority > b.source.priority;
                   });
  const std::vector<Source> sources(ordered.begin(), ordered.end());
  const SensorGrid& first = *grids.front().grid;
  FusedGrids result{SensorGrid(first.stamp(), first.window()),
                    SensorGrid(first.stamp(), first.window())};
  switch (rule) {
    case FusionRule::kWeightedSum:
      fuseCells<WeightedSum>(sources, result);
      break;
    case FusionRule::kPriority:
      fuseCells<Priority>(sources, result);
      break;
    case FusionRule::kMaximum:
      fuseCells<Maximum>(sources, result);
      break;
    case FusionRule::kLogOdds:
      fuseCells<LogOdds>(sources, result);
      break;
    case FusionRule::kDempsterShafer:
      fuseCells<DempsterShafer>(sources, result);
      break;
  }
  return result;
}

}  // namespace datmo
