// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/risk/risk_assessor.h"

#include <algorithm>
#include <cmath>

#include "contact_futures.h"

#include "datmo_fusion/common/square.h"
#include "datmo_fusion/tracking/track_check.h"

namespace datmo {

namespace {

/// If none of this many possible futures has contact with an object, no more are sampled: contact
/// is then less probable than 5 % (with 95 % confidence), far below the threshold of any level.
/// This holds for most objects.
constexpr std::size_t kFirstFutures = 64;

/// Standard deviations by which a state may be off when reachability is checked.
constexpr double kReachSigmas = 4.0;

/// Returns the size of a track, at least `least` (m), that of a pedestrian.
BodySize sizeOf(const Track& track, double least) {
  return {0.5 * std::max(least, track.box.length), 0.5 * std::max(least, track.box.width)};
}

double largestDeviation(const TrackCovariance& covariance, int first) {
  return std::sqrt(covariance(first, first) + covariance(first + 1, first + 1));
}

/// Returns the road beside a point: the host is assumed to drive along it, following its borders or
/// its steering.
RoadCourse roadBeside(const Point2& point, const HostFutures& host) {
  const std::vector<BodyPose>& poses = host.nominal().poses;
  const auto nearest =
      std::min_element(poses.begin(), poses.end(), [&](const BodyPose& a, const BodyPose& b) {
        return (a.center - point).squaredNorm() < (b.center - point).squaredNorm();
      });
  return {nearest->heading, host.curvature()};
}

/// Returns the points without those of tracks, whose risk is assessed separately.
std::vector<Point2> withoutTracks(const std::vector<Point2>& points,
                                  const std::vector<Track>& tracks, double margin) {
  std::vector<Point2> rest;
  std::copy_if(points.begin(), points.end(), std::back_inserter(rest), [&](const Point2& point) {
    return std::none_of(tracks.begin(), tracks.end(),
                        [&](const Track& track) { return track.box.distanceTo(point) <= margin; });
  });
  return rest;
}

/// A method without probabilities warns at its reaction time.
WarningOptions warningOf(const RiskOptions& options) {
  WarningOptions warning = options.warning;
  if (options.method != RiskMethod::kFutures) {
    warning.warning_time = options.rules.driver_time;
    warning.warning_ttc = 0.0;
    warning.imminent_time = 0.0;
  }
  return warning;
}

}  // namespace

void RiskOptions::visit(OptionVisitor& visitor) {
  visitor.choice({"method", "",
                  "futures: seeded joint futures; for comparison: the circles of thesis 5.3.5, "
                  "boxes at constant velocity, responsibility-sensitive safety"},
                 method,
                 {{"futures", RiskMethod::kFutures},
                  {"thesis", RiskMethod::kThesis},
                  {"ttc_boxes", RiskMethod::kBoxes},
                  {"rss", RiskMethod::kRss}});
  visitor.integer({"max_objects", "1",
                   "maximum number of tracks that are assessed, those most likely to exist; bounds "
                   "the time of a step"},
                  max_objects, {1, 1000});
  visitor.number({"max_silence", "s", "a track that was not observed for longer is ignored"},
                 max_silence, {0.0, 10.0});
  visitor.group("vehicle", [&] { vehicle.visit(visitor); });
  visitor.group("horizon", [&] { horizon.visit(visitor); });
  visitor.group("host", [&] { host.visit(visitor); });
  visitor.group("objects", [&] { objects.visit(visitor); });
  visitor.group("rules", [&] { rules.visit(visitor); });
  visitor.group("warning", [&] { warning.visit(visitor); });
}

RiskAssessor::RiskAssessor(const Checked<RiskOptions>& options)
    : options_(*options),
      draws_(static_cast<std::uint64_t>(options->horizon.seed)),
      level_(warningOf(*options)) {}

void RiskAssessor::reset() { level_.reset(); }

RiskReport RiskAssessor::assess(const RiskInput& input) {
  RiskReport report;
  report.stamp = input.stamp;
  const std::vector<Track> tracks = admitted(input, report.counts);
  const auto course = input.road
                          ? courseSteering(input.host, *input.road, options_.vehicle, options_.host)
                          : std::nullopt;
  const HostFutures host(input.host, course, options_.vehicle, options_.host, options_.horizon,
                         draws_);
  report.host = host.nominal();
  report.host_size = options_.vehicle.size();
  const bool by_futures = options_.method == RiskMethod::kFutures;
  report.objects.push_back(ofStanding(input, tracks, host));
  for (const Track& track : tracks) {
    if (!reachable(track, input.host)) {
      ++report.counts.unreachable;
      ObjectRisk risk;
      risk.id = track.id;
      risk.object_class = track.objectClass();
      risk.mode = likeliestMode(track);
      report.objects.push_back(risk);
    } else {
      report.objects.push_back(by_futures ? byFutures(track, host) : byRule(track, host));
    }
  }
  level_.judge(report, input.host.speed);
  return report;
}

std::vector<Track> RiskAssessor::admitted(const RiskInput& input, RiskCounts& counts) const {
  const double since_list = secondsBetween(input.tracks.stamp, input.stamp);
  std::vector<Track> tracks;
  for (const Track& track : input.tracks.tracks) {
    if (!isValid(track) || track.id == kStandingId) {
      ++counts.rejected;
    } else if (track.since_update + since_list > options_.max_silence) {
      ++counts.old;
    } else {
      tracks.push_back(predicted(track, since_list, prediction_));
    }
  }
  const auto most = static_cast<std::size_t>(options_.max_objects);
  if (tracks.size() > most) {
    counts.over_budget = tracks.size() - most;
    std::stable_sort(tracks.begin(), tracks.end(), [](const Track& a, const Track& b) {
      return a.existence_probability > b.existence_probability;
    });
    tracks.resize(most);
  }
  std::stable_sort(tracks.begin(), tracks.end(),
                   [](const Track& a, const Track& b) { return a.id < b.id; });
  return tracks;
}

/// Worst case: both move toward each other, and accelerate as hard as they can.
bool RiskAssessor::reachable(const Track& track, const HostState& host) const {
  const double time = options_.horizon.horizon;
  const double spread =
      std::max(options_.host.acceleration_spread, host.acceleration_sigma.value_or(0.0));
  const double acceleration = options_.objects.max_acceleration +
                              std::max(0.0, std::abs(host.acceleration) + kReachSigmas * spread);
  const double speed = std::abs(host.speed) + track.state.segment<2>(2).norm() +
                       kReachSigmas * largestDeviation(track.covariance, 2);
  const double size = options_.vehicle.size().radius() + options_.vehicle.middleAhead() +
                      sizeOf(track, options_.default_size).radius() +
                      kReachSigmas * largestDeviation(track.covariance, 0);
  const double distance = (track.state.head<2>() - host.pose.position()).norm();
  return distance <= size + speed * time + 0.5 * acceleration * square(time);
}

ObjectRisk RiskAssessor::byFutures(const Track& track, const HostFutures& host) const {
  ObjectRisk risk;
  risk.id = track.id;
  risk.object_class = track.objectClass();
  risk.mode = likeliestMode(track);
  const BodySize host_size = options_.vehicle.size();
  const BodySize size = sizeOf(track, options_.default_size);
  const RoadCourse road = roadBeside(track.state.head<2>(), host);
  const ObjectFutures object(track, road, options_.objects, options_.horizon, draws_);
  const BodyPath nominal = object.nominalPath();
  risk.post_encroachment = postEncroachmentTime({host.nominal(), host_size, nominal, size});
  std::vector<FutureContact> contacts;
  std::size_t free_futures = 0;
  for (std::size_t future = 0; future < host.paths().size(); ++future) {
    if (contacts.empty() && free_futures == kFirstFutures) {
      return risk;
    }
    if (const auto contact = contactOf(host.paths()[future], host_size, object, size, future)) {
      contacts.push_back(*contact);
    } else {
      ++free_futures;
    }
  }
  const std::size_t possible = leaveOutTouching(contacts, host.paths().size());
  if (contacts.empty()) {
    return risk;
  }
  summarize(contacts, possible, track.existence_probability, risk);
  const std::size_t median = contacts[(contacts.size() - 1) / 2].future;
  setCriticality({host.paths()[median], host_size, object.path(median), size}, options_.vehicle,
                 risk);
  return risk;
}

ObjectRisk RiskAssessor::byRule(const Track& track, const HostFutures& host) const {
  const BodySize size = options_.vehicle.size();
  if (options_.method == RiskMethod::kThesis) {
    return thesisRisk(track, host.nominal(), options_.rules);
  }
  if (options_.method == RiskMethod::kBoxes) {
    return boxRisk(track, host.nominal(), size, options_.rules);
  }
  return rssRisk(track, host.nominal(), size, options_.rules);
}

/// Among the methods for comparison, those that consider moving objects only ignore stationary
/// obstacles.
ObjectRisk RiskAssessor::ofStanding(const RiskInput& input, const std::vector<Track>& tracks,
                                    const HostFutures& host) const {
  ObjectRisk risk;
  const bool by_futures = options_.method == RiskMethod::kFutures;
  if (!by_futures && options_.method != RiskMethod::kBoxes) {
    return risk;
  }
  const StandingPoints points(withoutTracks(input.standing, tracks, options_.point_margin),
                              options_.point_spacing);
  const BodySize host_size = options_.vehicle.size();
  std::vector<const BodyPath*> paths{&host.nominal()};
  if (by_futures) {
    paths.clear();
    for (const BodyPath& path : host.paths()) {
      paths.push_back(&path);
    }
  }
  std::vector<FutureContact> contacts;
  for (std::size_t future = 0; future < paths.size(); ++future) {
    if (const auto contact = points.firstContact(*paths[future], host_size)) {
      contacts.push_back(contactWith(*contact, *paths[future], host_size, future));
    }
  }
  const std::size_t possible = leaveOutTouching(contacts, paths.size());
  if (contacts.empty()) {
    return risk;
  }
  summarize(contacts, possible, 1.0, risk);
  const FutureContact& median = contacts[(contacts.size() - 1) / 2];
  const BodyPath& path = *paths[median.future];
  const BodyPath still{path.step,
                       std::vector<BodyPose>(path.poses.size(), bodyPose(median.position, 0.0))};
  setCriticality({path, host_size, still, BodySize()}, options_.vehicle, risk);
  risk.post_encroachment = 0.0;
  if (!by_futures) {
    risk.time_to_brake = std::max(0.0, risk.median_ttc - options_.rules.vehicle_time);
  }
  return risk;
}

}  // namespace datmo
