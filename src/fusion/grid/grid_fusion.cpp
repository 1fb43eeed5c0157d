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
struct Meaning {
  // Plausibility of occupied and of free, and the mass committed to neither: Dempster's rule
  // multiplies each of the three over the sources (commonality, Shafer 1976).
  float may_be_occupied = 1.0F;
  float may_be_free = 1.0F;
  float open = 1.0F;

  float probability = 0.5F;  ///< of being occupied, discounted by the source's reliability
  float weighed = 0.0F;      ///< weight * percent
};

Meaning meaningOf(float said, const GridSourceOptions& source) {
  const auto reliability = static_cast<float>(source.reliability);
  const float evidence = reliability * (2.0F * said - 1.0F);  // positive: for occupied
  Meaning meaning;
  meaning.may_be_occupied = 1.0F - std::max(0.0F, -evidence);
  meaning.may_be_free = 1.0F - std::max(0.0F, evidence);
  meaning.open = std::min(meaning.may_be_occupied, meaning.may_be_free);
  meaning.probability = std::clamp(0.5F + 0.5F * evidence, kMinProbability, 1.0F - kMinProbability);
  meaning.weighed = static_cast<float>(source.weight) * kPercent * said;
  return meaning;
}

/// One source with a table of the evidence of each value.
struct Source {
  const Percent* cells;
  float weight;
  std::array<Meaning, std::numeric_limits<Percent>::max() + 1> meanings;

  explicit Source(const WeighedGrid& weighed)
      : cells(weighed.grid->cells().data()), weight(static_cast<float>(weighed.source.weight)) {
    for (std::size_t percent = 0; percent < meanings.size(); ++percent) {
      // Values above 100 count as 100.
      const float said = std::min(1.0F, static_cast<float>(percent) / kPercent);
      meanings[percent] = meaningOf(said, weighed.source);
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
  void take(const Meaning& meaning) {
    may_be_occupied_ *= meaning.may_be_occupied;
    may_be_free_ *= meaning.may_be_free;
    open_ *= meaning.open;
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
  void take(const Source& source, Percent, const Meaning& meaning) {
    sum += meaning.weighed;
    weights += source.weight;
  }
  Percent result(const Evidence&) const { return rounded(sum / weights); }
};

/// Sources come in the order of their priority.
struct Priority {
  Percent first = kUnknownPercent;
  void take(const Source&, Percent said, const Meaning&) {
    first = first == kUnknownPercent ? said : first;
  }
  Percent result(const Evidence&) const { return first; }
};

struct Maximum {
  Percent max = kUnknownPercent;
  void take(const Source&, Percent said, const Meaning&) { max = std::max(max, said); }
  Percent result(const Evidence&) const { return max; }
};

/// Multiplies the odds, which is equivalent and needs no logarithm.
struct LogOdds {
  float occupied = 1.0F;
  float free = 1.0F;
  void take(const Source&, Percent, const Meaning& meaning) {
    occupied *= meaning.probability;
    free *= 1.0F - meaning.probability;
  }
  Percent result(const Evidence&) const { return rounded(kPercent * occupied / (occupied + free)); }
};

struct DempsterShafer {
  void take(const Source&, Percent, const Meaning&) {}
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
    Percent said = kUnknownPercent;
    Rule rule;
    Evidence evidence;
    for (const Source& source : sources) {
      if (source.cells[cell] < 0) {
        continue;
      }
      ++known;
      said = source.cells[cell];
      const Meaning& meaning = source.meanings[static_cast<std::uint8_t>(said)];
      rule.take(source, said, meaning);
      evidence.take(meaning);
    }
    if (known > 1) {
      fused[cell] = rule.result(evidence);
      conflict[cell] = rounded(kPercent * (1.0F - evidence.agreement()));
    } else {
      fused[cell] = said;
    }
  }
}

void checkWindows(const std::vector<WeighedGrid>& grids) {
  if (grids.empty()) {
    throw std::invalid_argument("fuseGrids: expected at least one grid");
  }
  for (const WeighedGrid& weighed : grids) {
    if (weighed.grid->window() != grids.front().grid->window()) {
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

FusedGrids fuseGrids(FusionRule rule, const std::vector<WeighedGrid>& grids) {
  checkWindows(grids);
  std::vector<WeighedGrid> ordered = grids;
  std::stable_sort(ordered.begin(), ordered.end(), [](const WeighedGrid& a, const WeighedGrid& b) {
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
