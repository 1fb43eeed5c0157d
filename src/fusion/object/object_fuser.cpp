// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/fusion/object/object_fuser.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string>
#include <utility>

#include "object_intake.h"

#include "datmo_fusion/assignment/assignment.h"
#include "datmo_fusion/common/class_belief.h"
#include "datmo_fusion/fusion/object/object_combination.h"
#include "datmo_fusion/fusion/sync/names_in_use.h"

namespace datmo {

namespace {

/// An object moves if at least this share of its beams, over the views of all sources, ends where
/// the map is free; like moving_share of moving_objects.
constexpr double kMinMovingShare = 0.3;

/// Log odds beyond this count as certain; larger terms would swamp all others.
constexpr double kMaxLogOdds = 20.0;

/// Minimum probability of a known class.
constexpr double kKnownClass = 0.5;

/// An object of the result, and which sources see it.
struct FusedObject {
  Object object;
  std::vector<bool> seen_by;
  std::size_t scan_points = 0;  ///< the scanner's points on it
  PositionEvidence evidence;    ///< of the scan, about another source's view of it
};

double positionStd(const Object& object) {
  return std::sqrt(0.5 * object.position_covariance.trace());
}

bool isPole(const Object& object) {
  return probabilityOf(ObjectClass::kPole, object.class_probabilities) > kKnownClass;
}

}  // namespace

void ObjectSourceOptions::visit(OptionVisitor& visitor) {
  visitor.toggle({"use", "", "off: its objects are not read", Tier::kPublic}, use);
  visitor.number({"detection_probability", "1",
                  "probability that the source lists an object that it could see; an object that "
                  "it does not list is accordingly less likely to exist",
                  Tier::kPublic},
                 detection_probability, {0.01, 0.99});
  visitor.number({"false_agreement_probability", "1",
                  "probability that a false object of another source has one of this source in its "
                  "gate, by chance"},
                 false_agreement_probability, {0.001, 1.0});
  visitor.number({"late_by", "s",
                  "if more than 0, the reference does not wait for this source's lists, which are "
                  "used when they arrive, up to this much later"},
                 late_by, {0.0, 5.0});
  visitor.group("covariance", [&] { covariance.visit(visitor); });
}

ObjectFuserOptions::ObjectFuserOptions() {
  sources["lidar"].detection_probability = 0.8;
  sources["stereo"];
}

void ObjectFuserOptions::visit(OptionVisitor& visitor) {
  visitor.each({"sources", "", "the sensors whose objects are fused"}, sources);
  visitor.text(
      {"scanner", "", "source whose list the labeled scan belongs to; it lists no static objects"},
      scanner, {});
  visitor.integer({"max_objects", "1",
                   "maximum number of objects taken from one list, the nearest ones; bounds the "
                   "time of a step"},
                  max_objects, {1, 10000});
  association.visit(visitor);
  visitor.group("visibility", [&] { visibility.visit(visitor); });
  visitor.group("scan_support", [&] { scan_support.visit(visitor); });
}

std::vector<std::string> ObjectFuserOptions::sourcesInUse() const { return namesInUse(sources); }

std::map<std::string, double> ObjectFuserOptions::lateSources() const {
  std::map<std::string, double> late;
  for (const auto& [name, source] : sources) {
    if (source.use && source.late_by > 0.0) {
      late[name] = source.late_by;
    }
  }
  return late;
}

void ObjectFuserOptions::check() const {
  for (const auto& [name, source] : sources) {
    source.covariance.check("sources/" + name + "/covariance");
  }
  if (sources.count(scanner) > 0) {
    return;
  }
  std::string names;
  for (const auto& [name, source] : sources) {
    names += (names.empty() ? "" : ", ") + name;
  }
  // The scan would be used to judge the scanner's own objects like those of others.
  throw OptionError("scanner = \"" + scanner + "\": expected one of the sources (" + names + ")");
}

ObjectFuser::ObjectFuser(const Checked<ObjectFuserOptions>& options) : options_(*options) {}

/// One call of `fuse`.
class ObjectFuser::Fusion {
 public:
  Fusion(const ObjectFuserOptions& options, const std::vector<SourceObjects>& sources,
         const LabeledScan* scan)
      : options_(options), sources_(sources) {
    if (scan != nullptr) {
      scan_support_.emplace(*scan, options_.scan_support);
    }
    result_.list.stamp = sources.at(0).list.stamp;
    for (const SourceObjects& source : sources) {
      intakes_.push_back(ingest(source, result_.list.stamp,
                                scan_support_ ? &*scan_support_ : nullptr, options,
                                result_.counts));
      const std::vector<SensorView>& views = intakes_.back().list.views;
      result_.list.views.insert(result_.list.views.end(), views.begin(), views.end());
    }
  }

  ObjectFusionResult run() {
    for (std::size_t source = 0; source < intakes_.size(); ++source) {
      add(source);
    }
    for (FusedObject& fused : objects_) {
      judge(fused);
      result_.list.objects.push_back(std::move(fused.object));
    }
    return std::move(result_);
  }

 private:
  const ObjectSourceOptions& optionsOf(std::size_t source) const {
    return options_.sources.at(sources_[source].source);
  }

  /// Merges a source's objects with the result so far.
  void add(std::size_t source) {
    std::vector<Object> known;
    known.reserve(objects_.size());
    for (const FusedObject& fused : objects_) {
      known.push_back(fused.object);
    }
    const ObjectIntake& intake = intakes_[source];
    const std::vector<int> matches =
        associate(known, intake.list.objects, intake.sensor, options_.association);
    const ObjectSourceOptions& own = optionsOf(source);
    const double seen_too = std::log(own.detection_probability / own.false_agreement_probability);
    for (std::size_t i = 0; i < matches.size(); ++i) {
      const Object& object = intake.list.objects[i];
      if (matches[i] == kUnassigned) {
        objects_.push_back({object, std::vector<bool>(sources_.size(), false), 0, {}});
        note(source, i, objects_.back());
        continue;
      }
      FusedObject& fused = objects_[static_cast<std::size_t>(matches[i])];
      const bool first_pair = std::count(fused.seen_by.begin(), fused.seen_by.end(), true) == 1;
      result_.counts.fused += first_pair ? 1 : 0;
      fused.object = combined(fused.object, object);
      fused.object.log_odds += std::max(0.0, seen_too);
      note(source, i, fused);
    }
  }

  /// Notes that one more source sees an object, as its object with this index.
  void note(std::size_t source, std::size_t index, FusedObject& fused) const {
    const ObjectIntake& intake = intakes_[source];
    fused.seen_by[source] = true;
    if (sources_[source].source == options_.scanner) {
      fused.scan_points = intake.list.objects[index].points.size();
    } else if (intake.scan_evidence[index].beams > fused.evidence.beams) {
      fused.evidence = intake.scan_evidence[index];
    }
  }

  /// For an object of another source, the scanner may see moving points just in front of or beside
  /// it: its moving share is reduced to the share of the beams toward it that are not occluded.
  void weighMotion(FusedObject& fused) const {
    Object& object = fused.object;
    const double others = fused.evidence.beamsElsewhere();
    if (fused.scan_points == 0 || others <= 0.0) {
      return;
    }
    const auto own = static_cast<double>(fused.scan_points);
    object.moving_fraction *= own / (own + others);
    if (object.dynamic_state == DynamicState::kMoving && object.moving_fraction < kMinMovingShare) {
      object.dynamic_state = DynamicState::kUnknown;
    }
  }

  /// Applies the evidence of the sources that do not see an object.
  void judge(FusedObject& fused) const {
    weighMotion(fused);
    Object& object = fused.object;
    for (std::size_t source = 0; source < sources_.size(); ++source) {
      if (fused.seen_by[source]) {
        continue;
      }
      const double detection = optionsOf(source).detection_probability;
      if (scan_support_ && sources_[source].source == options_.scanner) {
        const double met = std::min(1.0, fused.evidence.beams) * fused.evidence.through_share;
        object.log_odds += std::log1p(-detection * met);
      } else if (intakes_[source].visibility) {
        const double visible =
            intakes_[source].visibility->detectionProbability(object.box, positionStd(object));
        object.log_odds += std::log1p(-detection * visible);
      }
    }
    if (isPole(object)) {
      treatAsStanding(object);
    }
    object.log_odds = std::clamp(object.log_odds, -kMaxLogOdds, kMaxLogOdds);
  }

  const ObjectFuserOptions& options_;
  const std::vector<SourceObjects>& sources_;
  std::optional<ScanSupport> scan_support_;
  std::vector<ObjectIntake> intakes_;
  std::vector<FusedObject> objects_;
  ObjectFusionResult result_;
};

ObjectFusionResult ObjectFuser::fuse(const std::vector<SourceObjects>& sources,
                                     const LabeledScan* scan) const {
  return Fusion(options_, sources, scan).run();
}

}  // namespace datmo
