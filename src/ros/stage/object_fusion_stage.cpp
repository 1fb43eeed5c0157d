// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/ros/stage/object_fusion_stage.h"

#include <algorithm>
#include <functional>
#include <memory>
#include <optional>
#include <utility>

#include <boost/make_shared.hpp>

#include "datmo_fusion/fusion/sync/relative_motion.h"
#include "datmo_fusion/ros/convert/message_conversion.h"
#include "datmo_fusion/ros/stage/stage_inputs.h"
#include "datmo_fusion/tracking/object_check.h"

namespace datmo {

namespace {

constexpr char kObjectList[] = "object list";

/// More than a second of a fast scanner: longer than a list may wait (SourceMatcherOptions).
constexpr std::size_t kMaxScans = 64;

/// Names of the sources that have such a list.
std::string sourcesWith(const std::vector<SourceObjects>& lists,
                        const std::function<bool(const std::vector<Object>&)>& is_such) {
  std::string names;
  for (const SourceObjects& one : lists) {
    if (is_such(one.list.objects)) {
      names += (names.empty() ? "" : ", ") + one.source;
    }
  }
  return names;
}

}  // namespace

void ObjectFusionStageOptions::visit(OptionVisitor& visitor) {
  visitor.group("input", [&] { input.visit(visitor); });
  matcher.visit(visitor);
  visitor.toggle({"retroactive", "",
                  "tracks do not wait for objects of other sources, which are fused later, at "
                  "their own stamp (live.launch); false: they wait up to max_wait"},
                 retroactive);
  fuser.visit(visitor);
}

ObjectFusionStage::ObjectFusionStage(const Checked<ObjectFusionStageOptions>& options,
                                     StageMonitor& monitor)
    : options_(*options),
      monitor_(monitor),
      runner_(monitor, options->input, std::string("forgets all ") + kObjectList + "s",
              [this] { reset(); }),
      inputs_({options->frames.base, options->frames, options->motion, options->input,
               options->matcher, options->fuser.sourcesInUse(), kObjectList},
              runner_),
      matcher_(options->matcher, options->fuser.sourcesInUse(), Serving::kOnce,
               options->fuser.lateSources()),
      fuser_(options->fuser) {
  checkSourceNames(sources(), kObjectList, {"early", "fused"});
}

void ObjectFusionStage::reset() {
  inputs_.reset();
  matcher_.reset();
  newest_.reset();
  scans_.clear();
}

void ObjectFusionStage::handleObjects(const std::string& source, const ObjectArray& message,
                                      Stamp now) {
  runner_.serve([&] {
    inputs_.check(source, message.header, now);
    const auto list = std::make_shared<ObjectList>(fromMessage(message));
    for (Object& object : list->objects) {
      if (object.sensors.empty()) {
        object.sensors = {source};
      }
    }
    for (SensorView& view : list->views) {
      if (view.sensor.empty()) {
        view.sensor = source;
      }
    }
    inputs_.report(source, {"bad_view", message.views.size() - list->views.size(), "bad views",
                            "finite numbers, bearings in rad in ascending order, at most a turn "
                            "apart, and sure_range of at most range"});
    matcher_.add(source, list->stamp, list);
  });
}

void ObjectFusionStage::handleLabeledScan(const LabeledScanMessage& message) {
  runner_.serve([&] {
    if (message.header.frame_id != options_.frames.base) {
      throw InputError("wrong_frame", "labeled scan in '" + message.header.frame_id +
                                          "': expected '" + options_.frames.base + "'");
    }
    LabeledScan scan = fromMessage(message);
    runner_.check("/labeled_scan", message.header.stamp);
    scans_.push_back(std::move(scan));
    if (scans_.size() > kMaxScans) {
      scans_.pop_front();
    }
  });
}

const LabeledScan* ObjectFusionStage::scanAt(Stamp stamp) const {
  const auto found = std::find_if(scans_.begin(), scans_.end(),
                                  [stamp](const LabeledScan& scan) { return scan.stamp == stamp; });
  return found == scans_.end() ? nullptr : &*found;
}

std::vector<SourceObjects> ObjectFusionStage::movedLists(
    const Matched& matched, std::vector<MissingSource>& missing) const {
  const auto motion = [this](Stamp from, Stamp to) { return inputs_.motion(from, to); };
  std::vector<SourceObjects> lists;
  for (const SourceSample<ObjectList>& one : matched.samples) {
    if (const auto base = baseAt(one.stamp, matched.stamp(), motion)) {
      lists.push_back({one.source, *one.payload, *base});
    } else {
      missing.push_back({one.source, WhyMissing::kNoMotion});
    }
  }
  return lists;
}

ObjectArrayPtr ObjectFusionStage::next(Stamp now) {
  return runner_.serve([&] {
    const std::optional<Matched> matched = inputs_.nextOf(matcher_, now);
    return matched ? fuse(*matched) : nullptr;
  });
}

ObjectArrayPtr ObjectFusionStage::fuse(const Matched& matched) {
  const Stopwatch watch;
  std::vector<MissingSource> missing = matched.missing;
  const std::vector<SourceObjects> lists = movedLists(matched, missing);
  const LabeledScan* const scan = scanAt(matched.stamp());
  times_without_scan_ += scan == nullptr ? 1 : 0;
  const ObjectFusionResult result = fuser_.fuse(lists, scan);
  // Sets have rising stamps.
  scans_.erase(scans_.begin(),
               std::find_if(scans_.begin(), scans_.end(), [&matched](const LabeledScan& one) {
                 return one.stamp > matched.stamp();
               }));
  newest_ = std::max(newest_.value_or(matched.stamp()), matched.stamp());
  inputs_.report(matched.stamp(), missing);
  report(lists, result.counts);
  auto fused = boost::make_shared<ObjectArray>(toMessage(result.list, options_.frames.base));
  monitor_.processed({matched.stamp(), std::exchange(early_seconds_, 0.0) + watch.seconds()});
  return fused;
}

ObjectArrayPtr ObjectFusionStage::nextEarly(Stamp now) {
  return runner_.serve([&]() -> ObjectArrayPtr {
    const std::optional<Matched> matched =
        options_.retroactive ? inputs_.earlyOf(matcher_, newest_, now) : std::nullopt;
    if (!matched) {
      return nullptr;
    }
    const Stopwatch watch;
    newest_ = matched->stamp();
    std::vector<MissingSource> missing;
    const ObjectFusionResult result =
        fuser_.fuse(movedLists(*matched, missing), scanAt(matched->stamp()));
    auto early = boost::make_shared<ObjectArray>(toMessage(result.list, options_.frames.base));
    early_seconds_ += watch.seconds();
    return early;
  });
}

void ObjectFusionStage::report(const std::vector<SourceObjects>& lists,
                               const ObjectFusionCounts& counts) {
  if (counts.rejected > 0) {
    const auto is_bad = [](const std::vector<Object>& objects) {
      return !std::all_of(objects.begin(), objects.end(), isValid);
    };
    monitor_.warned(
        InputError("bad_object", std::to_string(counts.rejected) + " objects of " +
                                     sourcesWith(lists, is_bad) +
                                     " with numbers that are not finite or out of range, or a "
                                     "covariance that is not positive definite: left out"));
  }
  if (counts.refused > 0) {
    const auto max = static_cast<std::size_t>(options_.fuser.max_objects);
    const auto is_long = [max](const std::vector<Object>& objects) { return objects.size() > max; };
    monitor_.warned(InputError("many_objects", std::to_string(counts.refused) + " objects of " +
                                                   sourcesWith(lists, is_long) +
                                                   " beyond max_objects = " + std::to_string(max) +
                                                   " of a list: the farthest are left out"));
  }
  bad_objects_ += counts.rejected;
  objects_too_many_ += counts.refused;
  monitor_.figure("objects of two or more sources", static_cast<double>(counts.fused));
  monitor_.figure("bad objects", static_cast<double>(bad_objects_));
  monitor_.figure("objects beyond max_objects", static_cast<double>(objects_too_many_));
  monitor_.figure("fused without a labeled scan", static_cast<double>(times_without_scan_));
  inputs_.reportUnserved(matcher_);
}

void ObjectFusionStage::connect(StagePorts& ports) {
  fused_ = ports.out<ObjectArray>("objects/fused");
  early_ = ports.out<ObjectArray>("objects/early");
  connectMotion(ports, options_.motion, *this);
  ports.optionalIn<LabeledScanMessage>(
      "labeled_scan", [this](const auto& scan, Stamp /*now*/) { handleLabeledScan(*scan); });
  for (const std::string& source : sources()) {
    ports.in<ObjectArray>("objects/" + source, [this, source](const auto& objects, Stamp now) {
      handleObjects(source, *objects, now);
    });
  }
}

bool ObjectFusionStage::publishNext(Stamp now) {
  const ObjectArrayPtr objects = next(now);
  fused_.publish(objects);
  const ObjectArrayPtr early = objects ? nullptr : nextEarly(now);
  early_.publish(early);
  return objects || early;
}

}  // namespace datmo
