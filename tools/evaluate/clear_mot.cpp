// SPDX-License-Identifier: BSD-3-Clause
#include "evaluate/clear_mot.h"

#include <cstdint>
#include <unordered_map>

#include "evaluate/object_scores.h"

namespace datmo::evaluation {

namespace {

constexpr double kMostlyTracked = 0.8;  // Milan et al. 2016
constexpr double kMostlyLost = 0.2;     // likewise

/// Follows each object through the frames in which it is required.
class EventCounter {
 public:
  explicit EventCounter(const MatchOptions& options) : options_(options) {}

  void add(std::size_t number, const Frame& frame, const FrameMatching& matching) {
    for (std::size_t i = 0; i < frame.truths.size(); ++i) {
      const TrueState& truth = frame.truths[i];
      const int track = matching.track_of_truth[i];
      if (truth.duty == Duty::kOptional) {
        continue;
      }
      ++counts_.required;
      if (track == kUnassigned) {
        addMiss(past_[truth.id]);
      } else {
        addMatch(number, truth, frame.tracks[static_cast<std::size_t>(track)], past_[truth.id]);
      }
    }
    counts_.false_positives += matching.falseTracks();
  }

  const ClearMot& counts() const { return counts_; }
  double distance() const { return distance_; }

 private:
  struct Past {
    bool matched = false;
    std::uint32_t track = 0;  // that it was last matched to
    bool missed_since = false;
  };

  void addMiss(Past& past) {
    ++counts_.misses;
    past.missed_since = past.matched;
  }

  void addMatch(std::size_t number, const TrueState& truth, const TrackState& track, Past& past) {
    ++counts_.matches;
    distance_ += matchDistance(truth, track, options_);
    if (past.matched && past.track != track.id) {
      counts_.switches.push_back({number, truth.id, past.track, track.id});
    }
    counts_.fragmentations += past.missed_since ? 1 : 0;
    past = {true, track.id, false};
  }

  MatchOptions options_;
  ClearMot counts_;
  double distance_ = 0.0;  // m, sum over the matches
  std::unordered_map<std::uint32_t, Past> past_;
};

void addShares(const std::vector<ObjectScore>& objects, ClearMot& result) {
  if (objects.empty()) {
    return;
  }
  double tracked = 0.0;
  double lost = 0.0;
  for (const ObjectScore& object : objects) {
    tracked += object.completeness() >= kMostlyTracked ? 1.0 : 0.0;
    lost += object.completeness() < kMostlyLost ? 1.0 : 0.0;
  }
  result.mostly_tracked = tracked / static_cast<double>(objects.size());
  result.mostly_lost = lost / static_cast<double>(objects.size());
}

}  // namespace

ClearMot scoreClearMot(const Frames& frames, const Matching& matching,
                       const MatchOptions& options) {
  EventCounter counter(options);
  for (std::size_t i = 0; i < frames.size(); ++i) {
    counter.add(i, frames[i], matching[i]);
  }
  ClearMot result = counter.counts();
  if (result.required > 0) {
    const std::size_t errors = result.misses + result.false_positives + result.switches.size();
    result.mota = 1.0 - static_cast<double>(errors) / static_cast<double>(result.required);
  }
  if (result.matches > 0) {
    result.motp = counter.distance() / static_cast<double>(result.matches);
  }
  addShares(scoreObjects(frames, matching), result);
  return result;
}

}  // namespace datmo::evaluation
