// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/tracking/early_tracker.h"

#include <utility>

#include "datmo_fusion/common/waiting_bound.h"

namespace datmo {

namespace {

/// Adds what was left out or cut short between the two.
void addEffort(TrackerCounts& sum, const TrackerCounts& before, const TrackerCounts& after) {
  sum.intake.accepted += after.intake.accepted - before.intake.accepted;
  sum.intake.rejected += after.intake.rejected - before.intake.rejected;
  sum.intake.refused += after.intake.refused - before.intake.refused;
  sum.association.refused_births +=
      after.association.refused_births - before.association.refused_births;
  sum.association.cut_hypotheses +=
      after.association.cut_hypotheses - before.association.cut_hypotheses;
  sum.association.best_only_steps +=
      after.association.best_only_steps - before.association.best_only_steps;
}

}  // namespace

void EarlyTracker::setOptions(const Checked<TrackerOptions>& options) {
  complete_.setOptions(options);
  if (ahead_) {
    ahead_->setOptions(options);
  }
}

void EarlyTracker::addScan(const LabeledScan& scan) {
  complete_.addScan(scan);
  if (ahead_) {
    ahead_->addScan(scan);
  }
}

void EarlyTracker::addClasses(const ObjectList& classes) {
  complete_.addClasses(classes);
  if (ahead_) {
    ahead_->addClasses(classes);
  }
}

TrackList EarlyTracker::process(const TrackerInput& complete) {
  TrackList tracks =
      complete_.process(complete.objects, complete.base_in_fixed, complete.visibility);
  while (!waiting_.empty() && waiting_.front().objects.stamp <= complete.objects.stamp) {
    waiting_.pop_front();
  }
  runAgain();
  return tracks;
}

TrackList EarlyTracker::processEarly(TrackerInput early) {
  if (!ahead_) {
    ahead_ = complete_.ahead();
  }
  if (waiting_.size() == kMaxWaitingSamples) {
    waiting_.pop_front();
  }
  waiting_.push_back(std::move(early));
  return goOn(waiting_.back());
}

TrackerCounts EarlyTracker::counts() const {
  TrackerCounts counts = complete_.counts();
  addEffort(counts, TrackerCounts(), early_effort_);
  return counts;
}

TrackList EarlyTracker::goOn(const TrackerInput& early) {
  const TrackerCounts before = ahead_->counts();
  TrackList tracks = ahead_->process(early.objects, early.base_in_fixed, early.visibility);
  addEffort(early_effort_, before, ahead_->counts());
  complete_.keepIds(*ahead_);
  return tracks;
}

void EarlyTracker::runAgain() {
  if (waiting_.empty()) {
    ahead_.reset();
    return;
  }
  ahead_ = complete_.ahead();
  for (const TrackerInput& early : waiting_) {
    goOn(early);
  }
}

void EarlyTracker::reset() {
  complete_.reset();
  ahead_.reset();
  waiting_.clear();
  early_effort_ = TrackerCounts();
}

}  // namespace datmo
