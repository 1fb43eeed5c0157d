// SPDX-License-Identifier: BSD-3-Clause
#include "evaluate/gospa.h"

#include <cmath>

#include "evaluate/pair_choice.h"

namespace datmo::evaluation {

namespace {

std::vector<Point2> requiredCenters(const Frame& frame) {
  std::vector<Point2> result;
  for (const TrueState& truth : frame.truths) {
    if (truth.duty == Duty::kRequired) {
      result.push_back(truth.box.center.position());
    }
  }
  return result;
}

std::vector<Point2> scoredCenters(const Frame& frame, const FrameMatching& matching) {
  std::vector<Point2> result;
  for (std::size_t i = 0; i < frame.tracks.size(); ++i) {
    if (matching.verdicts[i] != Verdict::kNeutral) {
      result.push_back(frame.tracks[i].box.center.position());
    }
  }
  return result;
}

}  // namespace

void GospaOptions::visit(OptionVisitor& visitor) {
  visitor.number({"cutoff", "m",
                  "distance of centers beyond which a track is not an estimate of an object (c of "
                  "Rahmathullah et al. 2017): about a car's length; a miss or a false track costs "
                  "this divided by the square root of 2"},
                 cutoff, {0.01, 1000.0});
}

Gospa gospa(const std::vector<Point2>& truths, const std::vector<Point2>& tracks,
            const GospaOptions& options) {
  const double square_of_cutoff = options.cutoff * options.cutoff;
  std::vector<PairGain> pairs;
  for (std::size_t i = 0; i < truths.size(); ++i) {
    for (std::size_t j = 0; j < tracks.size(); ++j) {
      // What a pair saves compared with one miss and one false track.
      const double gain = square_of_cutoff - (truths[i] - tracks[j]).squaredNorm();
      if (gain > 0.0) {
        pairs.push_back({i, j, gain});
      }
    }
  }
  const std::vector<std::size_t> chosen = choosePairs(pairs);
  double localization = 0.0;
  for (const std::size_t index : chosen) {
    localization += square_of_cutoff - pairs[index].gain;
  }
  const double missed = 0.5 * square_of_cutoff * static_cast<double>(truths.size() - chosen.size());
  const double wrong = 0.5 * square_of_cutoff * static_cast<double>(tracks.size() - chosen.size());
  return {std::sqrt(localization + missed + wrong), std::sqrt(localization), std::sqrt(missed),
          std::sqrt(wrong)};
}

std::vector<Gospa> gospaOfFrames(const Frames& frames, const Matching& matching,
                                 const GospaOptions& options) {
  std::vector<Gospa> result;
  result.reserve(frames.size());
  for (std::size_t i = 0; i < frames.size(); ++i) {
    result.push_back(
        gospa(requiredCenters(frames[i]), scoredCenters(frames[i], matching[i]), options));
  }
  return result;
}

std::optional<Gospa> meanGospa(const std::vector<Gospa>& frames) {
  if (frames.empty()) {
    return std::nullopt;
  }
  const double share = 1.0 / static_cast<double>(frames.size());
  Gospa mean;
  for (const Gospa& frame : frames) {
    mean.total += share * frame.total;
    mean.localization += share * frame.localization;
    mean.missed += share * frame.missed;
    mean.false_tracks += share * frame.false_tracks;
  }
  return mean;
}

}  // namespace datmo::evaluation
