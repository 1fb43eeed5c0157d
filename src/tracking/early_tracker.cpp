// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/tracking/early_tracker.h"

#include <utility>

namespace datmo {

namespace {

/// More than of a fast scanner come while the slowest source is waited for
/// (SourceMatcherOptions::max_wait, 0.3 s for images that a processor matches).
constexpr std::size_t kMaxWaiting = 16;

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
    ahead_ = complete_;
  }
  if (waiting_.size() == kMaxWaiting) {
    waiting_.pop_front();
  }
  waiting_.push_back(std::move(early));
  const TrackerInput& newest = waiting_.back();
  return ahead_->process(newest.objects, newest.base_in_fixed, newest.visibility);
}

void EarlyTracker::runAgain() {
  if (waiting_.empty()) {
    ahead_.reset();
    return;
  }
  ahead_ = complete_;
  for (const TrackerInput& early : waiting_) {
    ahead_->process(early.objects, early.base_in_fixed, early.visibility);
  }
}

void EarlyTracker::reset() {
  complete_.reset();
  ahead_.reset();
  waiting_.clear();
}

}  // namespace datmo
