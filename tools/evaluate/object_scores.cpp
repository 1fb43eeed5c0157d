// SPDX-License-Identifier: BSD-3-Clause
#include "evaluate/object_scores.h"

#include <algorithm>
#include <numeric>
#include <unordered_map>

#include "datmo_fusion/common/quantile.h"

namespace datmo::evaluation {

namespace {

/// Scores in the making, by first frame of their objects.
class ObjectTable {
 public:
  void addFrame(const TrueState& truth, Stamp stamp) {
    const auto [position, is_new] = indices_.emplace(truth.id, entries_.size());
    if (is_new) {
      entries_.emplace_back();
      entries_.back().score.id = truth.id;
      entries_.back().score.classification = truth.classification;
      entries_.back().score.first = stamp;
    }
    ObjectScore& score = entries_[position->second].score;
    score.last = stamp;
    ++score.required_frames;
  }

  void addHit(const TrueState& truth, const TrackState& track, Stamp stamp) {
    Entry& entry = entries_[indices_.at(truth.id)];
    ObjectScore& score = entry.score;
    if (!score.delay) {
      score.delay = secondsBetween(score.first, stamp);
    }
    if (std::find(score.track_ids.begin(), score.track_ids.end(), track.id) ==
        score.track_ids.end()) {
      score.track_ids.push_back(track.id);
    }
    ++score.tracked_frames;
    entry.errors.add(truth, track);
  }

  std::vector<ObjectScore> scores() const {
    std::vector<ObjectScore> result;
    for (const Entry& entry : entries_) {
      result.push_back(entry.score);
      result.back().errors = entry.errors.result();
    }
    return result;
  }

 private:
  struct Entry {
    ObjectScore score;
    StateErrorSum errors;
  };

  std::vector<Entry> entries_;
  std::unordered_map<std::uint32_t, std::size_t> indices_;  // by id
};

}  // namespace

double ObjectScore::completeness() const {
  return static_cast<double>(tracked_frames) / static_cast<double>(required_frames);
}

DelayScore scoreDelays(const std::vector<ObjectScore>& objects) {
  std::vector<double> delays;
  for (const ObjectScore& object : objects) {
    if (object.delay) {
      delays.push_back(*object.delay);
    }
  }
  DelayScore score;
  score.objects = delays.size();
  if (!delays.empty()) {
    const double sum = std::accumulate(delays.begin(), delays.end(), 0.0);
    score.mean = sum / static_cast<double>(delays.size());
    score.median = quantile(delays, 0.5);
  }
  return score;
}

std::vector<ObjectScore> scoreObjects(const Frames& frames, const Matching& matching) {
  ObjectTable table;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    const Stamp stamp = frames[i].stamp;
    for (const TrueState& truth : frames[i].truths) {
      if (truth.duty == Duty::kRequired) {
        table.addFrame(truth, stamp);
      }
    }
    forEachHit(frames[i], matching[i], [&](const TrueState& truth, const TrackState& track) {
      table.addHit(truth, track, stamp);
    });
  }
  return table.scores();
}

}  // namespace datmo::evaluation
