#include "datmo_fusion/tracking/tracker.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "datmo_fusion/tracking/multiple_hypotheses.h"
#include "datmo_fusion/tracking/nearest_neighbour.h"
#include "datmo_fusion/tracking/track_paths.h"

namespace datmo {

namespace {

constexpr char kMultipleHypotheses[] = "mht";
constexpr char kGlobalNearestNeighbour[] = "gnn";

double positionStd(const Target& target) {
  return std::sqrt(target.filter().estimate().covariance.diagonal().head<2>().maxCoeff());
}

std::unique_ptr<TargetSet> makeTargets(const TrackerOptions& options) {
  if (options.association == kGlobalNearestNeighbour) {
    return std::make_unique<NearestNeighbourTargets>(options.target, options.gating);
  }
  return std::make_unique<MultipleHypotheses>(options.target, options.gating, options.hypotheses,
                                              options.split_merge);
}

}  // namespace

void TrackerOptions::visit(OptionVisitor& visitor) {
  visitor.text({"association", "",
                "which object is of which target: multiple hypotheses over several scans (Reid "
                "1979; thesis 3.3.4), or the global nearest neighbour of each scan by itself"},
               association, {kMultipleHypotheses, kGlobalNearestNeighbour});
  visitor.group("hypotheses", [&] { hypotheses.visit(visitor); });
  visitor.group("split_merge", [&] { split_merge.visit(visitor); });
  visitor.group("intake", [&] { intake.visit(visitor); });
  visitor.group("gating", [&] { gating.visit(visitor); });
  visitor.group("clutter", [&] { clutter.visit(visitor); });
  visitor.group("visibility", [&] { visibility.visit(visitor); });
  visitor.group("target", [&] { target.visit(visitor); });
  visitor.group("duplicates", [&] { duplicates.visit(visitor); });
  visitor.toggle({"require_motion", "",
                  "only what evidently moves becomes a track; off: everything that exists, as for "
                  "detectors that tell road users from other things"},
                 require_motion);
  constexpr Bounds kHits{1, 100};
  visitor.integer(
      {"confirmation_hits", "1", "objects before a track is published (thesis 3.3.4: three steps)"},
      confirmation_hits, kHits);
  visitor.integer({"fused_confirmation_hits", "1",
                   "the same of objects that two sensors see, of which one sees them move (thesis "
                   "3.3.4: one step)"},
                  fused_confirmation_hits, kHits);
  constexpr Bounds kProbability{0.0, 1.0};
  visitor.number(
      {"confirmation_existence", "1", "existence probability from which a target is confirmed"},
      confirmation_existence, kProbability);
  visitor.number(
      {"least_existence", "1", "existence probability below which a confirmed track is deleted"},
      least_existence, kProbability);
  visitor.number({"published_existence", "1",
                  "existence probability from which a confirmed track is published"},
                 published_existence, kProbability);
  constexpr Bounds kSilence{0.0, 60.0};
  visitor.number({"tentative_silence", "s", "an unconfirmed target not seen for longer is deleted"},
                 tentative_silence, kSilence);
  visitor.number({"confirmed_silence", "s",
                  "a confirmed track not seen for longer is deleted; sooner if it was followed for "
                  "a shorter time, but no sooner than an unconfirmed one"},
                 confirmed_silence, kSilence);
  visitor.number({"published_silence", "s",
                  "a track not seen for longer is not published; less long if it was followed for "
                  "less than twice that, but no less than an unconfirmed one is kept"},
                 published_silence, kSilence);
  visitor.number({"most_position_std", "m",
                  "a target is deleted when the standard deviation of its position is larger"},
                 most_position_std, {0.1, 100.0});
  visitor.number({"history_time", "s", "how much of its path is published with a track"},
                 history_time, {0.0, 60.0});
  visitor.number({"time_budget", "s",
                  "a step that takes longer goes on with the most likely hypothesis alone"},
                 time_budget, {1e-4, 10.0});
}

class Tracker::State {
 public:
  State(const TrackerOptions& options, StepClock clock)
      : options_(options),
        clock_(std::move(clock)),
        unknown_view_(options.visibility),
        clutter_(options.clutter),
        targets_(makeTargets(options)) {}

  TrackList process(const ObjectList& list, const Pose2& base_in_fixed,
                    const Visibility& visibility) {
    const StepBudget budget(clock_, options_.time_budget);
    const double seconds = stamp_ ? std::max(0.0, secondsBetween(*stamp_, list.stamp)) : 0.0;
    stamp_ = list.stamp;
    targets_->predict(seconds);
    removeLost();
    AssociationScan scan =
        takeIn(list.objects, base_in_fixed, visibility, clutter_, options_.intake, counts_.intake);
    targets_->associate(scan, budget);
    removeDuplicates();
    removeLost();
    confirm();
    learnClutter(scan, seconds);
    counts_.association = targets_->counts();
    return published(scan);
  }

  const Visibility& unknownView() const { return unknown_view_; }
  const TrackerCounts& counts() const { return counts_; }

  void reset() {
    targets_->clear();
    clutter_.clear();
    paths_.clear();
    stamp_.reset();
    counts_ = TrackerCounts();
  }

 private:
  void removeDuplicates() {
    std::vector<const Target*> targets;
    for (const BestTarget& best : targets_->best()) {
      targets.push_back(best.target);
    }
    const std::set<std::uint64_t> duplicates = findDuplicates(targets, options_.duplicates);
    if (!duplicates.empty()) {
      targets_->removeIf(
          [&](const Target& target) { return duplicates.count(target.number()) > 0; });
      counts_.merged_tracks += duplicates.size();
    }
  }

  void removeLost() {
    targets_->removeIf([this](const Target& target) { return isLost(target); });
  }

  /// How long a track that was followed for this time may go unseen.
  double silenceAfter(double followed, double most) const {
    return std::min(most, std::max(options_.tentative_silence, followed));
  }

  bool isLost(const Target& target) const {
    const double allowed = target.confirmed()
                               ? silenceAfter(target.followed(), options_.confirmed_silence)
                               : options_.tentative_silence;
    return (target.confirmed() && existence(target) < options_.least_existence) ||
           target.sinceUpdate() > allowed || positionStd(target) > options_.most_position_std;
  }

  double existence(const Target& target) const {
    return target.existenceProbability(options_.target);
  }

  bool isPublished(const BestTarget& best) const {
    const Target& target = *best.target;
    return target.confirmed() &&
           best.probability * existence(target) >= options_.published_existence &&
           target.sinceUpdate() <=
               silenceAfter(0.5 * target.followed(), options_.published_silence);
  }

  void confirm() {
    for (const BestTarget& best : targets_->best()) {
      if (!best.target->confirmed() && deservesTrack(*best.target)) {
        const std::uint32_t id = next_id_++;
        targets_->change(best.target->number(), [id](Target& target) { target.confirm(id); });
        ++counts_.confirmed_tracks;
      }
    }
  }

  bool deservesTrack(const Target& target) const {
    const bool fused = target.sensors().size() > 1;
    const int hits = fused ? options_.fused_confirmation_hits : options_.confirmation_hits;
    const bool moves = !options_.require_motion || target.evidentlyMoves(options_.target) ||
                       (fused && target.sawItMove());
    return target.seenAs() != kUnseen && target.hits() >= static_cast<std::uint32_t>(hits) &&
           moves && existence(target) >= options_.confirmation_existence;
  }

  /// What belongs to a confirmed target is no clutter.
  void learnClutter(const AssociationScan& scan, double seconds) {
    std::vector<bool> explained(scan.objects, false);
    for (const BestTarget& best : targets_->best()) {
      const std::size_t seen_as = best.target->seenAs();
      if (best.target->confirmed() && seen_as != kUnseen) {
        for (const std::size_t source : scan.observations[seen_as].sources) {
          explained[source] = true;
        }
      }
    }
    std::vector<Point2> unexplained;
    for (std::size_t i = 0; i < scan.objects; ++i) {
      if (!explained[i]) {
        unexplained.push_back(scan.fixed_in_base *
                              scan.observations[i].object.box.centre.position());
      }
    }
    clutter_.learn(unexplained, seconds);
  }

  TrackList published(const AssociationScan& scan) {
    TrackList list{*stamp_, {}};
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

  Track trackOf(const BestTarget& best, const AssociationScan& scan) const {
    Track track = best.target->track(options_.target);
    track.existence_probability = best.probability * existence(*best.target);
    if (best.target->seenAs() != kUnseen) {
      track.objects = scan.listedSources(best.target->seenAs());
    }
    return track;
  }

  TrackerOptions options_;
  StepClock clock_;
  Visibility unknown_view_;
  ClutterMap clutter_;
  std::unique_ptr<TargetSet> targets_;
  TrackPaths paths_;
  std::optional<Stamp> stamp_;
  std::uint32_t next_id_ = 1;
  TrackerCounts counts_;
};

Tracker::Tracker(const TrackerOptions& options, StepClock clock) {
  checkOptions(options);
  state_ = std::make_unique<State>(options, std::move(clock));
}

Tracker::~Tracker() = default;

TrackList Tracker::process(const ObjectList& objects, const Pose2& base_in_fixed,
                           const Visibility& visibility) {
  return state_->process(objects, base_in_fixed, visibility);
}

TrackList Tracker::process(const ObjectList& objects, const Pose2& base_in_fixed) {
  return state_->process(objects, base_in_fixed, state_->unknownView());
}

const TrackerCounts& Tracker::counts() const { return state_->counts(); }

void Tracker::reset() { state_->reset(); }

}  // namespace datmo
