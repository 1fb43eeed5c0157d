// SPDX-License-Identifier: BSD-3-Clause
#include "kitti_tracking/evaluated_sequence.h"

#include <algorithm>
#include <cmath>

namespace datmo::kitti {

namespace {

// Limits of Weng et al. 2020, as in the evaluation of KITTI's own tracking benchmark.

/// px: tracks of this height in the image or less are not false positives.
constexpr double kMinImageHeight = 25.0;
/// A track with a larger share of its rectangle in a DontCare region is ignored.
constexpr double kMaxInDontCare = 0.5;
/// Objects that are more occluded or truncated need not be found: "largely occluded" ones must be.
constexpr int kMaxOccluded = 2;
constexpr int kMaxTruncated = 0;

bool isNeighbor(ObjectType type, ObjectType evaluated) {
  return (evaluated == ObjectType::kCar && type == ObjectType::kVan) ||
         (evaluated == ObjectType::kPedestrian && type == ObjectType::kPersonSitting);
}

bool isLookedAt(ObjectType type, ObjectType evaluated) {
  return type == evaluated || isNeighbor(type, evaluated);
}

double area(const ImageBox& box) {
  return std::max(0.0, box.right - box.left) * std::max(0.0, box.bottom - box.top);
}

ImageBox intersection(const ImageBox& a, const ImageBox& b) {
  return {std::max(a.left, b.left), std::max(a.top, b.top), std::min(a.right, b.right),
          std::min(a.bottom, b.bottom)};
}

bool isSmall(const ImageBox& box) { return std::abs(box.bottom - box.top) <= kMinImageHeight; }

/// Numbers trajectories in the order of their first appearance.
class Numbering {
 public:
  std::size_t of(int id) { return numbers_.emplace(id, numbers_.size()).first->second; }
  std::size_t size() const { return numbers_.size(); }

 private:
  std::map<int, std::size_t> numbers_;
};

/// The rows of one frame that count.
struct FrameRows {
  std::vector<const TrackedObject*> labels;
  std::vector<const TrackedObject*> results;
  std::vector<const TrackedObject*> dont_cares;
};

std::map<int, FrameRows> rowsByFrame(const Sequence& sequence, ObjectType evaluated) {
  std::map<int, FrameRows> frames;
  for (const TrackedObject& label : sequence.labels) {
    if (label.type == ObjectType::kDontCare) {
      frames[label.frame].dont_cares.push_back(&label);
    } else if (isLookedAt(label.type, evaluated)) {
      frames[label.frame].labels.push_back(&label);
    }
  }
  for (const TrackedObject& result : sequence.results) {
    if (isLookedAt(result.type, evaluated)) {
      frames[result.frame].results.push_back(&result);
    }
  }
  return frames;
}

bool isInDontCare(const ImageBox& box, const std::vector<const TrackedObject*>& dont_cares) {
  return std::any_of(dont_cares.begin(), dont_cares.end(), [&box](const TrackedObject* region) {
    return area(intersection(box, region->image_box)) > kMaxInDontCare * area(box);
  });
}

bool isRequired(const TrackedObject& label, ObjectType evaluated) {
  return !isNeighbor(label.type, evaluated) && label.occluded <= kMaxOccluded &&
         label.truncated <= kMaxTruncated;
}

std::vector<Candidate> candidatesOf(const FrameRows& rows, double min_overlap) {
  std::vector<Candidate> candidates;
  for (std::size_t truth = 0; truth < rows.labels.size(); ++truth) {
    for (std::size_t track = 0; track < rows.results.size(); ++track) {
      const double overlap = overlap3d(rows.labels[truth]->box, rows.results[track]->box);
      if (overlap >= min_overlap) {
        candidates.push_back({truth, track, overlap});
      }
    }
  }
  return candidates;
}

EvaluatedFrame evaluatedFrame(const FrameRows& rows, const EvaluatedKind& kind, Numbering& truths,
                              Numbering& tracks) {
  EvaluatedFrame frame;
  for (const TrackedObject* label : rows.labels) {
    frame.truths.push_back({truths.of(label->id), isRequired(*label, kind.type)});
  }
  for (const TrackedObject* result : rows.results) {
    const bool optional = isNeighbor(result->type, kind.type) || isSmall(result->image_box) ||
                          isInDontCare(result->image_box, rows.dont_cares);
    frame.tracks.push_back({tracks.of(result->id), optional});
  }
  frame.candidates = candidatesOf(rows, kind.min_overlap);
  return frame;
}

/// Counts the rows of each trajectory and averages their scores, in the order of the frames.
void averageScores(const std::map<int, FrameRows>& frames, Numbering& tracks,
                   EvaluatedSequence& evaluated) {
  evaluated.rows.assign(tracks.size(), 0);
  evaluated.scores.assign(tracks.size(), 0.0);
  for (const auto& [number, rows] : frames) {
    for (const TrackedObject* result : rows.results) {
      const std::size_t trajectory = tracks.of(result->id);
      ++evaluated.rows[trajectory];
      evaluated.scores[trajectory] += result->score;
    }
  }
  for (std::size_t i = 0; i < evaluated.scores.size(); ++i) {
    evaluated.scores[i] /= static_cast<double>(evaluated.rows[i]);
  }
}

}  // namespace

EvaluatedSequence evaluatedSequence(const Sequence& sequence, const EvaluatedKind& kind) {
  const std::map<int, FrameRows> frames = rowsByFrame(sequence, kind.type);
  EvaluatedSequence evaluated;
  Numbering truths;
  Numbering tracks;
  for (const auto& [number, rows] : frames) {
    evaluated.frames[number] = evaluatedFrame(rows, kind, truths, tracks);
  }
  evaluated.truths = truths.size();
  averageScores(frames, tracks, evaluated);
  return evaluated;
}

}  // namespace datmo::kitti
