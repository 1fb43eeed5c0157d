// SPDX-License-Identifier: BSD-3-Clause
#include "evaluate/hota.h"

#include <cmath>
#include <numeric>

#include "evaluate/pair_choice.h"

namespace datmo::evaluation {

namespace {

constexpr int kAlphas = 19;  // Luiten et al. 2021
constexpr double kAlphaStep = 0.05;
// Similarities are differences of rounded numbers; one that equals alpha must be accepted.
constexpr double kRounding = 1e-9;
// Weights of matching, association and localization in the choice of matches (Luiten et al. 2021),
// so far apart that the order is lexicographic.
constexpr double kMatchGain = 1e4;
constexpr double kLocalizationGain = 1e-6;

/// Sums over the matches of one alpha.
struct Level {
  double matches = 0.0;
  double association = 0.0;  // sum of A(c) over the matches
  double similarity = 0.0;   // sum over the matches
};

class LevelScorer {
 public:
  LevelScorer(const ScoredRun& run, double gate, double alpha)
      : run_(run), gate_(gate), alpha_(alpha) {}

  Level score() const {
    const std::vector<double> potential = associationOf(potentialMatches());
    std::vector<double> matches(run_.encounters.size(), 0.0);
    Level level;
    for (const std::vector<ScoredPair>& frame : run_.frames) {
      matchFrame(frame, potential, matches, level);
    }
    const std::vector<double> association = associationOf(matches);
    level.matches = std::accumulate(matches.begin(), matches.end(), 0.0);
    level.association =
        std::inner_product(matches.begin(), matches.end(), association.begin(), 0.0);
    return level;
  }

 private:
  double similarity(const ScoredPair& pair) const { return 1.0 - pair.candidate.distance / gate_; }
  bool mayMatch(const ScoredPair& pair) const { return similarity(pair) >= alpha_ - kRounding; }

  /// Number of frames in which each encounter could be matched if there were no others.
  std::vector<double> potentialMatches() const {
    std::vector<double> result(run_.encounters.size(), 0.0);
    for (const std::vector<ScoredPair>& frame : run_.frames) {
      for (const ScoredPair& pair : frame) {
        result[pair.encounter] += mayMatch(pair) ? 1.0 : 0.0;
      }
    }
    return result;
  }

  /// A(c) = TPA / (TPA + FNA + FPA) of each encounter.
  std::vector<double> associationOf(const std::vector<double>& matches) const {
    std::vector<double> result(matches.size(), 0.0);
    for (std::size_t i = 0; i < matches.size(); ++i) {
      const Encounter& encounter = run_.encounters[i];
      const std::size_t frames =
          run_.object_frames[encounter.object] + run_.track_frames[encounter.track];
      result[i] = matches[i] / (static_cast<double>(frames) - matches[i]);
    }
    return result;
  }

  void matchFrame(const std::vector<ScoredPair>& frame, const std::vector<double>& potential,
                  std::vector<double>& matches, Level& level) const {
    std::vector<ScoredPair> able;
    std::vector<PairGain> gains;
    able.reserve(frame.size());
    gains.reserve(frame.size());
    for (const ScoredPair& pair : frame) {
      if (mayMatch(pair)) {
        able.push_back(pair);
        gains.push_back(
            {pair.candidate.truth, pair.candidate.track,
             kMatchGain + potential[pair.encounter] + kLocalizationGain * similarity(pair)});
      }
    }
    for (const std::size_t index : choosePairs(gains)) {
      matches[able[index].encounter] += 1.0;
      level.similarity += similarity(able[index]);
    }
  }

  const ScoredRun& run_;
  double gate_;
  double alpha_;
};

/// Sums over the alphas.
struct Sums {
  double hota = 0.0;
  double deta = 0.0;
  double assa = 0.0;
  double loca = 0.0;
  int matched_alphas = 0;
};

void addLevel(const Level& level, double detections, HotaScores& result, Sums& sums) {
  // TP + FN + FP.
  const double all = detections - level.matches;
  const double association = level.matches > 0.0 ? level.association / level.matches : 0.0;
  result.hota_alpha.push_back(std::sqrt(level.association / all));
  sums.hota += result.hota_alpha.back();
  sums.deta += level.matches / all;
  sums.assa += association;
  if (level.matches > 0.0) {
    sums.loca += level.similarity / level.matches;
    ++sums.matched_alphas;
  }
}

}  // namespace

HotaScores scoreHota(const ScoredRun& run, double gate) {
  HotaScores result;
  Sums sums;
  const double detections = run.required() + run.published();
  for (int i = 1; i <= kAlphas; ++i) {
    result.alphas.push_back(kAlphaStep * i);
    if (detections > 0.0) {
      addLevel(LevelScorer(run, gate, result.alphas.back()).score(), detections, result, sums);
    }
  }
  if (detections > 0.0) {
    result.hota = sums.hota / kAlphas;
    result.deta = sums.deta / kAlphas;
    result.assa = sums.assa / kAlphas;
  }
  if (sums.matched_alphas > 0) {
    result.loca = sums.loca / sums.matched_alphas;
  }
  return result;
}

}  // namespace datmo::evaluation
