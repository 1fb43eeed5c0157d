#include "datmo_fusion/tracking/tracker.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <tuple>
#include <vector>

#include "datmo_fusion/tracking/object_check.h"

namespace datmo {

namespace {

/// By place, so that the order in which a sensor lists its objects changes nothing.
bool isBefore(const Object& a, const Object& b) {
  const auto key = [](const Object& object) {
    const Box2& box = object.box;
    return std::make_tuple(box.centre.x(), box.centre.y(), box.centre.heading(), box.length,
                           box.width);
  };
  return key(a) < key(b);
}

double positionStd(const Target& target) {
  return std::sqrt(target.filter().estimate().covariance.diagonal().head<2>().maxCoeff());
}

}  // namespace

void TrackerOptions::visit(OptionVisitor& visitor) {
  visitor.group("target", [&] { target.visit(visitor); });
  visitor.group("association", [&] { association.visit(visitor); });
  visitor.group("duplicates", [&] { duplicates.visit(visitor); });
  visitor.integer(
      {"confirmation_hits", "1", "objects before a track is published (thesis 3.3.4: three steps)"},
      confirmation_hits, {1, 100});
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
  visitor.integer({"most_targets", "1", "targets followed at a time; bounds the time of a step"},
                  most_targets, {1, 5000});
}

class Tracker::State {
 public:
  explicit State(const TrackerOptions& options)
      : options_(options),
        associator_(std::make_unique<GlobalNearestNeighbour>(options.association)) {}

  TrackList process(const ObjectList& list, const Pose2& base_in_fixed) {
    predict(list.stamp);
    const std::vector<Object> objects = accepted(list.objects, base_in_fixed);
    const Association association = associator_->associate(targets_, objects);
    for (const Association::Pair& pair : association.pairs) {
      targets_[pair.target].update(objects[pair.object], options_.target);
    }
    for (const std::size_t index : association.missed) {
      targets_[index].miss(options_.target);
    }
    for (const std::size_t index : association.unexplained) {
      startTarget(objects[index]);
    }
    counts_.merged_tracks += removeDuplicates(targets_, options_.duplicates);
    removeLost();
    confirm();
    return published(list.stamp);
  }

  const TrackerCounts& counts() const { return counts_; }

  void reset() {
    targets_.clear();
    stamp_.reset();
    counts_ = TrackerCounts();
  }

 private:
  void predict(Stamp stamp) {
    const double seconds = stamp_ ? std::max(0.0, secondsBetween(*stamp_, stamp)) : 0.0;
    const ImmStep step = immStep(options_.target.filter, seconds);
    for (Target& target : targets_) {
      target.predict(seconds, step, options_.target);
    }
    stamp_ = stamp;
    removeLost();
  }

  std::vector<Object> accepted(const std::vector<Object>& objects, const Pose2& base_in_fixed) {
    std::vector<Object> result;
    for (const Object& object : objects) {
      result.push_back(transformed(base_in_fixed, object));
      if (!isValid(result.back())) {
        result.pop_back();
      }
    }
    counts_.objects += result.size();
    counts_.rejected_objects += objects.size() - result.size();
    std::sort(result.begin(), result.end(), isBefore);
    return result;
  }

  void startTarget(const Object& object) {
    if (object.dynamic_state == DynamicState::kStatic) {
      return;
    }
    if (targets_.size() >= static_cast<std::size_t>(options_.most_targets)) {
      ++counts_.refused_births;
      return;
    }
    targets_.emplace_back(object, options_.target);
  }

  void removeLost() {
    targets_.erase(std::remove_if(targets_.begin(), targets_.end(),
                                  [this](const Target& target) { return isLost(target); }),
                   targets_.end());
  }

  /// How long a track that was followed for this time may go unseen.
  double silenceAfter(double followed, double most) const {
    return std::min(most, std::max(options_.tentative_silence, followed));
  }

  bool isLost(const Target& target) const {
    const double allowed = target.confirmed()
                               ? silenceAfter(target.followed(), options_.confirmed_silence)
                               : options_.tentative_silence;
    return (target.confirmed() && target.isSpent()) || target.sinceUpdate() > allowed ||
           positionStd(target) > options_.most_position_std;
  }

  bool isPublished(const Target& target) const {
    return target.confirmed() && target.sinceUpdate() <= silenceAfter(0.5 * target.followed(),
                                                                      options_.published_silence);
  }

  void confirm() {
    for (Target& target : targets_) {
      if (!target.confirmed() && target.sinceUpdate() == 0.0 &&
          target.hits() >= static_cast<std::uint32_t>(options_.confirmation_hits) &&
          target.evidentlyMoves(options_.target)) {
        target.confirm(next_id_++);
        ++counts_.confirmed_tracks;
      }
    }
  }

  TrackList published(Stamp stamp) const {
    TrackList list{stamp, {}};
    for (const Target& target : targets_) {
      if (isPublished(target)) {
        list.tracks.push_back(target.track(options_.target));
      }
    }
    std::sort(list.tracks.begin(), list.tracks.end(),
              [](const Track& a, const Track& b) { return a.id < b.id; });
    return list;
  }

  TrackerOptions options_;
  std::unique_ptr<Associator> associator_;
  std::vector<Target> targets_;  ///< in order of their birth
  std::optional<Stamp> stamp_;
  std::uint32_t next_id_ = 1;
  TrackerCounts counts_;
};

Tracker::Tracker(const TrackerOptions& options) {
  checkOptions(options);
  state_ = std::make_unique<State>(options);
}

Tracker::~Tracker() = default;

TrackList Tracker::process(const ObjectList& objects, const Pose2& base_in_fixed) {
  return state_->process(objects, base_in_fixed);
}

const TrackerCounts& Tracker::counts() const { return state_->counts(); }

void Tracker::reset() { state_->reset(); }

}  // namespace datmo
