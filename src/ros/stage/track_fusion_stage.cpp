// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/ros/stage/track_fusion_stage.h"

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <utility>

#include <boost/make_shared.hpp>

#include "datmo_fusion/common/scan.h"
#include "datmo_fusion/ros/convert/descriptions.h"
#include "datmo_fusion/ros/convert/message_conversion.h"
#include "datmo_fusion/tracking/track_check.h"

namespace datmo {

namespace {

constexpr char kTrackList[] = "track list";

/// The source whose silence is no fault: the stage v2x publishes only when another station sends.
constexpr char kOtherStations[] = "v2x";

/// The valid tracks, by rising id; the first of several with the same id.
std::vector<Track> validTracks(const std::vector<Track>& all) {
  std::vector<Track> tracks;
  std::copy_if(all.begin(), all.end(), std::back_inserter(tracks),
               [](const Track& track) { return track.id > 0 && isValid(track); });
  std::stable_sort(tracks.begin(), tracks.end(),
                   [](const Track& a, const Track& b) { return a.id < b.id; });
  tracks.erase(std::unique(tracks.begin(), tracks.end(),
                           [](const Track& a, const Track& b) { return a.id == b.id; }),
               tracks.end());
  return tracks;
}

}  // namespace

TrackFusionStageOptions::TrackFusionStageOptions() {
  matcher.tolerance = 0.6;
  matcher.silent_after = 1.0;
}

void TrackFusionStageOptions::visit(OptionVisitor& visitor) {
  visitor.group("input", [&] { input.visit(visitor); });
  matcher.visit(visitor);
  fuser.visit(visitor);
}

TrackFusionStage::TrackFusionStage(const Checked<TrackFusionStageOptions>& options,
                                   StageMonitor& monitor)
    : options_(*options),
      monitor_(monitor),
      runner_(monitor, options->input, std::string("forgets all ") + kTrackList + "s",
              [this] { reset(); }),
      inputs_({options->frames.map, options->frames, std::nullopt, options->input, options->matcher,
               options->fuser.sourcesInUse(), kTrackList, std::set<std::string>{kOtherStations}},
              runner_),
      matcher_(options->matcher, options->fuser.sourcesInUse(), Serving::kOften),
      fuser_(options->fuser) {
  checkSourceNames(sources(), kTrackList, {"fused"});
}

void TrackFusionStage::reset() {
  inputs_.reset();
  matcher_.reset();
  fuser_.reset();
}

void TrackFusionStage::handleTracks(const std::string& source, const TrackArray& message,
                                    Stamp now) {
  runner_.serve([&] {
    inputs_.check(source, message.header, now);
    const auto list = std::make_shared<TrackList>(listOf(source, message));
    matcher_.add(source, list->stamp, list);
  });
}

TrackList TrackFusionStage::listOf(const std::string& source, const TrackArray& message) {
  TrackList list = fromMessage(message);
  inputs_.report(source, {"bad_view", message.views.size() - list.views.size(), "bad views",
                          "finite numbers, a beam_spacing other than 0, no negative reach, and " +
                              std::to_string(kMaxBeams) + " beams at most"});
  list.tracks = validTracks(list.tracks);
  inputs_.report(source, {"bad_track", message.tracks.size() - list.tracks.size(), "bad tracks",
                          "finite numbers in range, a covariance that is positive definite, and a "
                          "unique id of at least 1"});
  const auto max = static_cast<std::size_t>(options_.fuser.max_tracks);
  const std::size_t beyond = list.tracks.size() - std::min(list.tracks.size(), max);
  inputs_.report(source,
                 {"many_tracks", beyond, "tracks too many",
                  "max_tracks = " + std::to_string(max) + " at most, the most certain ones"});
  return list;
}

TrackArrayPtr TrackFusionStage::next(Stamp now) {
  return runner_.serve([&] {
    const std::optional<Matched> matched = inputs_.nextOf(matcher_, now);
    return matched ? fuse(*matched) : nullptr;
  });
}

TrackArrayPtr TrackFusionStage::fuse(const Matched& matched) {
  std::vector<SourceTracks> lists;
  for (const SourceSample<TrackList>& one : matched.samples) {
    lists.push_back({one.source, one.payload});
  }
  const TrackFusionResult result = fuser_.fuse(matched.stamp(), lists);
  inputs_.report(matched.stamp(), matched.missing);
  report(result.counts);
  auto fused = boost::make_shared<TrackArray>(toMessage(result.list, options_.frames.map));
  if (!fused->tracks.empty()) {
    monitor_.announce("track",
                      "first track: " + descriptionOf(fused->tracks.front(), options_.frames.map));
  }
  runner_.processed(matched.stamp());
  return fused;
}

void TrackFusionStage::report(const TrackFusionCounts& counts) {
  monitor_.figure("tracks of two or more sources", static_cast<double>(counts.fused));
  monitor_.figure("tracks published", static_cast<double>(counts.published));
  inputs_.reportUnserved(matcher_);
}

void TrackFusionStage::change(const OptionValues& values) {
  const auto changed = withLiveValues(options_, values);
  fuser_.setOptions(changed.fuser);
  options_ = changed;
}

void TrackFusionStage::connect(StagePorts& ports) {
  fused_ = ports.out<TrackArray>("tracks/fused");
  for (const std::string& source : sources()) {
    const auto take = [this, source](const auto& tracks, Stamp now) {
      handleTracks(source, *tracks, now);
    };
    if (source == kOtherStations) {
      ports.optionalIn<TrackArray>("tracks/" + source, take);
    } else {
      ports.in<TrackArray>("tracks/" + source, take);
    }
  }
}

bool TrackFusionStage::publishNext(Stamp now) {
  const TrackArrayPtr tracks = next(now);
  fused_.publish(tracks);
  return tracks != nullptr;
}

}  // namespace datmo
