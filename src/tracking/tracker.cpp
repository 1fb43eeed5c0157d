// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/tracking/tracker.h"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>
#include <vector>

#include "datmo_fusion/tracking/multiple_hypotheses.h"
#include "datmo_fusion/tracking/nearest_neighbor.h"

namespace datmo {

namespace {

/// A track is published without detections for this share of the time for which it was followed:
/// half as long as it is kept.
constexpr double kPublishedShare = 0.5;

/// s; minimum coasting time of a young track.
constexpr double kMinCoasting = 0.5;

double positionStd(const Target& target) {
  return std::sqrt(target.filter().estimate().covariance.diagonal().head<2>().maxCoeff());
}

std::unique_ptr<TargetSet> makeTargets(const TrackerOptions& options) {
  if (options.association == TrackerAssociation::kGlobalNearestNeighbor) {
    return std::make_unique<NearestNeighborTargets>(options.target, options.gating);
  }
  return std::make_unique<MultipleHypotheses>(options.target, options.gating, options.hypotheses,
                                              options.split_merge);
}

}  // namespace

Tracker::Tracker(const Checked<TrackerOptions>& options, StepClock clock)
    : options_(*options),
      clock_(std::move(clock)),
      unknown_view_(options->visibility),
      clutter_(options->clutter),
      transition_priors_(options->target.filter.transitions),
      scans_(options->scans),
      targets_(makeTargets(*options)),
      late_classes_(options->gating.gate) {}

void Tracker::setOptions(const Checked<TrackerOptions>& options) { options_ = *options; }

void Tracker::addScan(const LabeledScan& scan) { scans_.add(scan); }

TrackList Tracker::process(const ObjectList& objects, const Pose2& base_in_fixed,
                           const Visibility& visibility) {
  const StepBudget budget(clock_, options_.time_budget);
  const double seconds = stamp_ ? std::max(0.0, secondsBetween(*stamp_, objects.stamp)) : 0.0;
  stamp_ = stamp_ ? std::max(*stamp_, objects.stamp) : objects.stamp;
  AssociationScan scan =
      ingest(objects.objects, base_in_fixed, visibility, clutter_, options_.intake, counts_.intake);
  scan.transition_priors = &transition_priors_;
  targets_->predict(seconds, scan);
  removeLost();
  makeRoom(scan.objects, seconds);
  targets_->associate(scan, budget);
  removeDuplicates();
  removeLost();
  late_classes_.note(objects.stamp, targets_->best(), scan);
  updateClasses();
  confirm();
  learnClutter(scan, seconds);
  counts_.association = targets_->counts();
  TrackList tracks = published(objects.stamp, scan);
  for (const ViewFan& fan : visibility.fans()) {
    tracks.views.push_back(transformed(base_in_fixed, fan));
  }
  return tracks;
}

TrackList Tracker::process(const ObjectList& objects, const Pose2& base_in_fixed) {
  return process(objects, base_in_fixed, unknown_view_);
}

void Tracker::addClasses(ObjectList classes) {
  late_classes_.add(std::move(classes));
  updateClasses();
}

void Tracker::updateClasses() {
  for (const TargetClass& one : late_classes_.take()) {
    targets_->change(one.number, [&one](Target& target) { target.updateClass(one.probabilities); });
  }
  counts_.classes = late_classes_.counts();
}

Tracker Tracker::ahead() const {
  Tracker copy = *this;
  copy.confirmable_ = targets_->nextNumber();
  return copy;
}

void Tracker::keepIds(const Tracker& ahead) {
  for (const BestTarget& best : ahead.targets_->best()) {
    const std::uint32_t id = best.target->id();
    if (id >= next_id_) {
      targets_->change(best.target->number(), [id](Target& target) { target.setId(id); });
    }
  }
  next_id_ = ahead.next_id_;
}

void Tracker::reset() {
  targets_->clear();
  clutter_.clear();
  transition_priors_ = TransitionPriors(options_.target.filter.transitions);
  scans_.clear();
  late_classes_.clear();
  paths_.clear();
  stamp_.reset();
  counts_ = TrackerCounts();
}

void Tracker::removeDuplicates() {
  const std::vector<std::uint64_t> duplicates =
      findDuplicates(targets_->best(), options_.duplicates);
  counts_.merged_tracks += duplicates.size();
  remove(duplicates);
}

void Tracker::remove(const std::vector<std::uint64_t>& numbers) {
  if (!numbers.empty()) {
    targets_->removeIf([&](const Target& target) {
      return std::binary_search(numbers.begin(), numbers.end(), target.number());
    });
  }
}

void Tracker::makeRoom(std::size_t objects, double seconds) {
  const std::vector<BestTarget>& all = targets_->best();
  const auto max = static_cast<std::size_t>(options_.gating.max_targets);
  if (all.size() + objects <= max) {
    return;
  }
  std::vector<const Target*> unlikely;
  for (const BestTarget& best : all) {
    const bool missed = best.target->sinceUpdate() > seconds;  // even in the last scan
    if (!best.target->confirmed() && missed) {
      unlikely.push_back(best.target);
    }
  }
  std::sort(unlikely.begin(), unlikely.end(), [this](const Target* a, const Target* b) {
    return std::make_tuple(existence(*a), a->hits(), a->number()) <
           std::make_tuple(existence(*b), b->hits(), b->number());
  });
  unlikely.resize(std::min(unlikely.size(), all.size() + objects - max));
  std::vector<std::uint64_t> numbers;
  numbers.reserve(unlikely.size());
  for (const Target* target : unlikely) {
    numbers.push_back(target->number());
  }
  std::sort(numbers.begin(), numbers.end());
  counts_.evicted_targets += numbers.size();
  remove(numbers);
}

void Tracker::removeLost() {
  for (const BestTarget& best : targets_->best()) {
    const auto& transitions = best.target->filter().transitions();
    if (best.target->confirmed() && transitions && isLost(*best.target)) {
      transition_priors_.learn(best.target->objectClass(), *transitions);
    }
  }
  targets_->removeIf([this](const Target& target) { return isLost(target); });
}

double Tracker::silenceAfter(double followed, double max) const {
  return std::min(max, std::max(kMinCoasting, followed));
}

bool Tracker::isLost(const Target& target) const {
  const double allowed = target.confirmed()
                             ? silenceAfter(target.followed(), options_.confirmed_silence)
                             : options_.tentative_silence;
  return (target.confirmed() && existence(target) < options_.min_existence) ||
         target.sinceUpdate() > allowed ||
         !(positionStd(target) <= options_.max_position_std);  // true for NaN
}

double Tracker::existence(const Target& target) const {
  return target.existenceProbability(options_.target);
}

bool Tracker::isPublished(const BestTarget& best) const {
  const Target& target = *best.target;
  return target.confirmed() &&
         best.probability * existence(target) >= options_.published_existence &&
         target.sinceUpdate() <=
             silenceAfter(kPublishedShare * target.followed(), options_.published_silence);
}

void Tracker::confirm() {
  for (const BestTarget& best : targets_->best()) {
    if (!best.target->confirmed() && isConfirmable(*best.target)) {
      const std::uint32_t id = best.target->id() != 0 ? best.target->id() : next_id_++;
      const std::uint64_t order = ++counts_.confirmed_tracks;
      const JumpCounts prior = transition_priors_.of(best.target->objectClass());
      const bool moves = isLikelyMoving(*best.target);
      targets_->change(best.target->number(), [&](Target& target) {
        target.setId(id);
        target.confirm(order, moves);
        target.setTransitionPrior(prior);
      });
    }
  }
}

bool Tracker::isLikelyMoving(const Target& target) const {
  const double required = options_.target.motion_likelihood.required_probability;
  // A moving target exists: if existence is unlikely, the beams need not be evaluated.
  return existence(target) >= required &&
         target.motionProbability(scans_, *stamp_, options_.target) >= required;
}

bool Tracker::isConfirmable(const Target& target) const {
  return target.number() < confirmable_ && target.measurementIndex() != kUnseen &&
         target.hits() >= static_cast<std::uint32_t>(options_.confirmation_hits) &&
         target.objectClass() != ObjectClass::kPole &&
         existence(target) >= options_.confirmation_existence &&
         (!options_.require_motion || isLikelyMoving(target));
}

void Tracker::learnClutter(const AssociationScan& scan, double seconds) {
  std::vector<bool> explained(scan.objects, false);
  for (const BestTarget& best : targets_->best()) {
    const std::size_t measurement_index = best.target->measurementIndex();
    if (best.target->confirmed() && measurement_index != kUnseen) {
      for (const std::size_t source : scan.observations[measurement_index].sources) {
        explained[source] = true;
      }
    }
  }
  std::vector<Point2> unexplained;
  for (std::size_t i = 0; i < scan.objects; ++i) {
    if (!explained[i]) {
      unexplained.push_back(scan.fixed_in_base * scan.observations[i].object.box.center.position());
    }
  }
  clutter_.learn(unexplained, seconds);
}

TrackList Tracker::published(Stamp stamp, const AssociationScan& scan) {
  TrackList list{stamp, {}, {}};
  for (const BestTarget& best : targets_->best()) {
    if (isPublished(best)) {
      list.tracks.push_back(trackOf(best, scan));
    }
  }
  std::sort(list.tracks.begin(), list.tracks.end(),
            [](const Track& a, const Track& b) { return a.id < b.id; });
  paths_.extend(list, options_.history_time);
  return list;
}

Track Tracker::trackOf(const BestTarget& best, const AssociationScan& scan) const {
  Track track = best.target->track(options_.target);
  track.existence_probability = best.probability * existence(*best.target);
  if (best.target->measurementIndex() != kUnseen) {
    track.objects = scan.listedSources(best.target->measurementIndex());
  }
  return track;
}

}  // namespace datmo
