// SPDX-License-Identifier: BSD-3-Clause
#include "evaluate/score_json.h"

#include <algorithm>
#include <iterator>

#include "evaluate/attainable_json.h"
#include "evaluate/json_number.h"
#include "evaluate/series_json.h"

namespace datmo::evaluation {

namespace {

using nlohmann::json;

double milliseconds(double seconds) { return 1e3 * seconds; }

/// All options by their full keys.
class OptionLister : public OptionVisitor {
 public:
  void number(const OptionInfo& info, double& value, const Bounds& /*bounds*/) override {
    values_[key(info)] = value;
  }
  void numbers(const OptionInfo& info, std::vector<double>& values,
               const Bounds& /*bounds*/) override {
    values_[key(info)] = values;
  }
  void integer(const OptionInfo& info, int& value, const Bounds& /*bounds*/) override {
    values_[key(info)] = value;
  }
  void toggle(const OptionInfo& info, bool& value) override { values_[key(info)] = value; }
  void text(const OptionInfo& info, std::string& value,
            const std::vector<std::string>& /*allowed*/) override {
    values_[key(info)] = value;
  }

  const json& values() const { return values_; }

 private:
  json values_ = json::object();
};

json optionsJson(ScoreOptions options) {
  OptionLister lister;
  options.visit(lister);
  return lister.values();
}

json toJson(const ClearMot& score) {
  return {{"mota", orNull(score.mota)},
          {"motp_m", orNull(score.motp)},
          {"misses", score.misses},
          {"false_positives", score.false_positives},
          {"id_switches", score.switches.size()},
          {"fragmentations", score.fragmentations},
          {"required", score.required},
          {"matches", score.matches},
          {"mostly_tracked", orNull(score.mostly_tracked)},
          {"mostly_lost", orNull(score.mostly_lost)}};
}

json toJson(const IdentityScores& score) {
  return {{"idf1", orNull(score.idf1)}, {"idp", orNull(score.idp)}, {"idr", orNull(score.idr)}};
}

json toJson(const HotaScores& score) {
  return {{"hota", orNull(score.hota)}, {"deta", orNull(score.deta)},
          {"assa", orNull(score.assa)}, {"loca", orNull(score.loca)},
          {"alphas", score.alphas},     {"hota_alpha", score.hota_alpha}};
}

json gospaJson(const std::optional<Gospa>& score, double cutoff) {
  json result = {{"mean_m", nullptr},
                 {"localization_m", nullptr},
                 {"missed_m", nullptr},
                 {"false_m", nullptr},
                 {"cutoff_m", cutoff}};
  if (score) {
    result["mean_m"] = score->total;
    result["localization_m"] = score->localization;
    result["missed_m"] = score->missed;
    result["false_m"] = score->false_tracks;
  }
  return result;
}

json toJson(const StateErrors& errors) {
  return {{"position_rmse_m", orNull(errors.position)},
          {"velocity_rmse_mps", orNull(errors.velocity)},
          {"heading_rmse_rad", orNull(errors.heading)},
          {"heading_modulo_pi_rmse_rad", orNull(errors.heading_modulo_pi)},
          {"samples", errors.samples}};
}

json toJson(const Consistency& score) {
  return {{"mean_nees", orNull(score.mean_nees)},
          {"dof", score.degrees_of_freedom},
          {"samples", score.samples},
          {"unusable", score.unusable},
          {"lower", orNull(score.lower)},
          {"upper", orNull(score.upper)},
          {"inside_share", orNull(score.inside_share)}};
}

json nearJson(const StateErrors& errors, double range) {
  json result = toJson(errors);
  result["range_m"] = range;
  return result;
}

json toJson(const ClassShare& score) {
  return {{"right_share", orNull(score.share())},
          {"frames", score.frames},
          {"right", score.right},
          {"silent", score.silent}};
}

json toJson(const ClassScores& scores) {
  json result = toJson(scores.all);
  result["by_class"] = json::object();
  for (const auto& [object_class, share] : scores.by_class) {
    result["by_class"][nameOf(object_class)] = toJson(share);
  }
  return result;
}

json toJson(const DelayScore& score) {
  return {{"mean_s", orNull(score.mean)},
          {"median_s", orNull(score.median)},
          {"objects", score.objects}};
}

json objectsJson(const RunScore& score) {
  json objects = json::array();
  const Stamp start = score.frames.front().stamp;
  for (const ObjectScore& object : score.tracks.objects) {
    json entry = toJson(object.errors);
    entry.update({{"id", object.id},
                  {"label", score.truth_labels.at(object.id)},
                  {"class", nameOf(object.classification)},
                  {"first_s", secondsBetween(start, object.first)},
                  {"last_s", secondsBetween(start, object.last)},
                  {"required_frames", object.required_frames},
                  {"tracked_frames", object.tracked_frames},
                  {"found", object.found()},
                  {"delay_s", orNull(object.delay)},
                  {"completeness", object.completeness()},
                  {"track_ids", object.track_ids}});
    objects.push_back(entry);
  }
  if (score.delays) {
    addDelays(*score.delays, objects);
  }
  return objects;
}

json standingJson(const RunScore& score) {
  json objects = json::array();
  for (const StandingObject& object : score.standing_objects) {
    objects.push_back({{"id", object.id},
                       {"label", score.truth_labels.at(object.id)},
                       {"class", nameOf(object.classification)},
                       {"frames", object.frames},
                       {"tracked_frames", object.tracked_frames}});
  }
  return objects;
}

json thesisJson(const RunScore& score) {
  const ThesisCounts& counts = score.tracks.thesis;
  const auto& detections = score.false_detections;
  const auto& intersections = score.intersections;
  return {{"moving_objects", counts.moving_objects},
          {"missed_objects", counts.missed_objects},
          {"tracks", counts.tracks},
          {"false_tracks", counts.false_tracks},
          {"confirmed_tracks", counts.confirmed_tracks},
          {"confirmed_true_tracks", counts.confirmed_true_tracks},
          {"false_moving_objects_frames", detections ? orNull(detections->perFrame()) : json()},
          {"false_moving_objects_episodes", detections ? json(detections->episodes) : json()},
          {"intersections", intersections ? json(intersections->intersections) : json()},
          {"intersections_found", intersections ? orNull(intersections->found) : json()},
          {"intersections_false", intersections ? orNull(intersections->wrong) : json()}};
}

json toJson(const RelativePoseError& error) {
  json rotation = error.rotation ? json(toDegrees(*error.rotation)) : json();
  return {{"distance_m", error.distance},
          {"translation_m", orNull(error.translation)},
          {"rotation_deg", rotation},
          {"pairs", error.pairs}};
}

json poseJson(const std::optional<PoseScore>& score) {
  if (!score) {
    return nullptr;
  }
  json relative = json::array();
  std::transform(score->relative.begin(), score->relative.end(), std::back_inserter(relative),
                 [](const RelativePoseError& error) { return toJson(error); });
  return {{"end_error_m", score->end_error},
          {"end_error_deg", toDegrees(score->end_heading_error)},
          {"path_length_m", score->path_length},
          {"end_error_share", orNull(score->end_share)},
          {"position_rmse_m", score->position_rmse},
          {"heading_rmse_rad", score->heading_rmse},
          {"largest_jump_m", score->largest_jump},
          {"relative", relative},
          {"mean_nees", orNull(score->consistency.mean_nees)},
          {"samples", score->consistency.samples},
          {"unusable", score->consistency.unusable},
          {"dof", score->consistency.degrees_of_freedom}};
}

json toJson(const DurationScore& score) {
  return {{"median_ms", milliseconds(score.median)},
          {"p99_ms", milliseconds(score.percentile_99)},
          {"worst_ms", milliseconds(score.worst)}};
}

json timingJson(const std::map<std::string, StageScore>& stages) {
  json timing;
  for (const auto& [stage, score] : stages) {
    timing[stage] = toJson(score.processing);
    timing[stage]["latency"] = score.latency ? toJson(*score.latency) : json();
  }
  return timing;
}

}  // namespace

json toJson(const RunScore& score, const ScoreOptions& options, const ScoredFiles& files) {
  const TrackScores& tracks = score.tracks;
  const Stamp start = score.frames.front().stamp;
  return {{"format", kReportFormat},
          {"run", files.run},
          {"truth", files.truth},
          {"options", optionsJson(options)},
          {"start_s", start.seconds()},
          {"duration_s", secondsBetween(start, score.frames.back().stamp)},
          {"frames", score.frames.size()},
          {"messages_left_out", score.left_out},
          {"truth_objects", tracks.thesis.moving_objects},
          {"tracks", tracks.thesis.tracks},
          {"clear_mot", toJson(tracks.clear_mot)},
          {"false_movers_per_frame", orNull(tracks.false_movers.perFrame())},
          {"identity", toJson(tracks.identity)},
          {"hota", toJson(tracks.hota)},
          {"gospa", gospaJson(tracks.gospa, options.metrics.gospa.cutoff)},
          {"errors", toJson(tracks.errors)},
          {"near_errors", nearJson(score.near_errors, options.near_range)},
          {"classes", toJson(tracks.classes)},
          {"delay", toJson(tracks.delay)},
          {"attainable", score.delays ? delaysJson(tracks.objects, *score.delays) : json()},
          {"consistency",
           {{"position", toJson(tracks.consistency.position)},
            {"velocity", toJson(tracks.consistency.velocity)}}},
          {"objects", objectsJson(score)},
          {"standing_objects", standingJson(score)},
          {"thesis", thesisJson(score)},
          {"pose", poseJson(score.pose)},
          {"timing", timingJson(score.stages)},
          {"series", seriesJson(score)}};
}

}  // namespace datmo::evaluation
