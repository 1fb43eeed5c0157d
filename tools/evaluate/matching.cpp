// SPDX-License-Identifier: BSD-3-Clause
#include "evaluate/matching.h"

#include <algorithm>
#include <cmath>
#include <unordered_map>

#include "evaluate/pair_choice.h"

namespace datmo::evaluation {

namespace {

/// Matches frame after frame, and stores the last match of each object and track.
class Matcher {
 public:
  explicit Matcher(const MatchOptions& options) : options_(options) {}

  FrameMatching match(const Frame& frame) {
    FrameMatching result;
    result.candidates = candidatesOf(frame, options_);
    result.track_of_truth.assign(frame.truths.size(), kUnassigned);
    result.verdicts.assign(frame.tracks.size(), Verdict::kFalse);
    for (const Duty duty : {Duty::kRequired, Duty::kOptional}) {
      keepPartners(frame, duty, result);
      assignRest(frame, duty, result);
    }
    spareTracksOfOptional(frame, result);
    return result;
  }

 private:
  static bool isOpen(const Frame& frame, Duty duty, const FrameMatching& result,
                     const Candidate& candidate) {
    return frame.truths[candidate.truth].duty == duty &&
           result.track_of_truth[candidate.truth] == kUnassigned &&
           result.verdicts[candidate.track] == Verdict::kFalse;
  }

  void keepPartners(const Frame& frame, Duty duty, FrameMatching& result) {
    for (const Candidate& candidate : result.candidates) {
      if (isOpen(frame, duty, result, candidate) &&
          werePartners(frame.truths[candidate.truth].id, frame.tracks[candidate.track].id)) {
        pair(frame, candidate, result);
      }
    }
  }

  void assignRest(const Frame& frame, Duty duty, FrameMatching& result) {
    // Greater than any sum of distances: one more match is always better.
    const double match_gain = options_.gate * static_cast<double>(frame.truths.size() + 1);
    std::vector<Candidate> open;
    std::vector<PairGain> gains;
    for (const Candidate& candidate : result.candidates) {
      if (isOpen(frame, duty, result, candidate)) {
        open.push_back(candidate);
        gains.push_back({candidate.truth, candidate.track, match_gain - candidate.distance});
      }
    }
    for (const std::size_t index : choosePairs(gains)) {
      pair(frame, open[index], result);
    }
  }

  void pair(const Frame& frame, const Candidate& candidate, FrameMatching& result) {
    const TrueState& truth = frame.truths[candidate.truth];
    const TrackState& track = frame.tracks[candidate.track];
    result.track_of_truth[candidate.truth] = static_cast<int>(candidate.track);
    result.verdicts[candidate.track] =
        truth.duty == Duty::kRequired ? Verdict::kHit : Verdict::kNeutral;
    track_of_truth_[truth.id] = track.id;
    truth_of_track_[track.id] = truth.id;
  }

  bool werePartners(std::uint32_t truth, std::uint32_t track) const {
    const auto last_track = track_of_truth_.find(truth);
    const auto last_truth = truth_of_track_.find(track);
    return last_track != track_of_truth_.end() && last_track->second == track &&
           last_truth != truth_of_track_.end() && last_truth->second == truth;
  }

  /// A second track on an optional truth is no more wrong than the first.
  static void spareTracksOfOptional(const Frame& frame, FrameMatching& result) {
    for (const Candidate& candidate : result.candidates) {
      if (frame.truths[candidate.truth].duty == Duty::kOptional &&
          result.verdicts[candidate.track] == Verdict::kFalse) {
        result.verdicts[candidate.track] = Verdict::kNeutral;
      }
    }
  }

  MatchOptions options_;
  std::unordered_map<std::uint32_t, std::uint32_t> track_of_truth_;
  std::unordered_map<std::uint32_t, std::uint32_t> truth_of_track_;
};

}  // namespace

void MatchOptions::visit(OptionVisitor& visitor) {
  visitor.number({"gate", "m",
                  "largest distance at which a track may be matched to a true object (Bernardin "
                  "and Stiefelhagen 2008, threshold T); about a car's width"},
                 gate, {0.01, 100.0});
  visitor.choice(
      {"distance", "",
       "from a track's center to the true box (to_box, 0 inside: a scanner sees one side "
       "of a long object) or to its center (to_center)"},
      distance, {{"to_box", MatchDistance::kToBox}, {"to_center", MatchDistance::kToCenter}});
}

std::size_t FrameMatching::falseTracks() const {
  return static_cast<std::size_t>(std::count(verdicts.begin(), verdicts.end(), Verdict::kFalse));
}

double matchDistance(const TrueState& truth, const TrackState& track, const MatchOptions& options) {
  const Point2& center = track.box.center.position();
  return options.distance == MatchDistance::kToCenter
             ? (center - truth.box.center.position()).norm()
             : truth.box.distanceTo(center);
}

std::vector<Candidate> candidatesOf(const Frame& frame, const MatchOptions& options) {
  std::vector<Candidate> result;
  for (std::size_t i = 0; i < frame.truths.size(); ++i) {
    const TrueState& truth = frame.truths[i];
    const double reach = options.gate + truth.box.halfDiagonal();
    for (std::size_t j = 0; j < frame.tracks.size(); ++j) {
      const TrackState& track = frame.tracks[j];
      // Avoids computing the distance to the box for nearly all pairs.
      if ((track.box.center.position() - truth.box.center.position()).squaredNorm() >
          reach * reach) {
        continue;
      }
      const double distance = matchDistance(truth, track, options);
      if (distance <= options.gate) {
        result.push_back({i, j, distance});
      }
    }
  }
  return result;
}

Matching matchFrames(const Frames& frames, const MatchOptions& options) {
  Matcher matcher(options);
  Matching result;
  result.reserve(frames.size());
  for (const Frame& frame : frames) {
    result.push_back(matcher.match(frame));
  }
  return result;
}

}  // namespace datmo::evaluation
