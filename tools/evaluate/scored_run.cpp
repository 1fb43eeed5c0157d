// SPDX-License-Identifier: BSD-3-Clause
#include "evaluate/scored_run.h"

#include <cstdint>
#include <map>
#include <numeric>
#include <unordered_map>
#include <utility>

namespace datmo::evaluation {

namespace {

double sum(const std::vector<std::size_t>& counts) {
  return static_cast<double>(std::accumulate(counts.begin(), counts.end(), std::size_t{0}));
}

/// Numbers ids from 0 on, and counts how often each was requested.
class IdCounter {
 public:
  std::size_t count(std::uint32_t id) {
    const std::size_t number = numbers_.emplace(id, counts_.size()).first->second;
    counts_.resize(numbers_.size(), 0);
    ++counts_[number];
    return number;
  }
  const std::vector<std::size_t>& counts() const { return counts_; }

 private:
  std::unordered_map<std::uint32_t, std::size_t> numbers_;
  std::vector<std::size_t> counts_;
};

class RunBuilder {
 public:
  void add(const Frame& frame, const FrameMatching& matching) {
    std::vector<std::size_t> objects(frame.truths.size());
    std::vector<std::size_t> tracks(frame.tracks.size());
    for (std::size_t i = 0; i < objects.size(); ++i) {
      if (frame.truths[i].duty == Duty::kRequired) {
        objects[i] = objects_.count(frame.truths[i].id);
      }
    }
    for (std::size_t j = 0; j < tracks.size(); ++j) {
      if (matching.verdicts[j] != Verdict::kNeutral) {
        tracks[j] = tracks_.count(frame.tracks[j].id);
      }
    }
    run_.frames.emplace_back();
    for (const Candidate& pair : matching.candidates) {
      if (frame.truths[pair.truth].duty == Duty::kRequired &&
          matching.verdicts[pair.track] != Verdict::kNeutral) {
        run_.frames.back().push_back({encounter(objects[pair.truth], tracks[pair.track]), pair});
      }
    }
  }

  ScoredRun build() {
    run_.object_frames = objects_.counts();
    run_.track_frames = tracks_.counts();
    return std::move(run_);
  }

 private:
  std::size_t encounter(std::size_t object, std::size_t track) {
    const auto [position, is_new] =
        encounters_.emplace(std::make_pair(object, track), run_.encounters.size());
    if (is_new) {
      run_.encounters.push_back({object, track});
    }
    return position->second;
  }

  IdCounter objects_;
  IdCounter tracks_;
  std::map<std::pair<std::size_t, std::size_t>, std::size_t> encounters_;
  ScoredRun run_;
};

}  // namespace

double ScoredRun::required() const { return sum(object_frames); }

double ScoredRun::published() const { return sum(track_frames); }

ScoredRun scoredRun(const Frames& frames, const Matching& matching) {
  RunBuilder builder;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    builder.add(frames[i], matching[i]);
  }
  return builder.build();
}

}  // namespace datmo::evaluation
