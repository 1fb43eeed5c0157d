// SPDX-License-Identifier: BSD-3-Clause
#include "kitti_tracking/tracking_report.h"

#include <iomanip>
#include <optional>
#include <sstream>

#include "evaluate/json_number.h"

namespace datmo::kitti {

namespace {

constexpr int kColumnWidth = 7;
constexpr int kTypeWidth = 12;

/// Text cells, right-aligned.
class Row {
 public:
  explicit Row(const std::string& first) {
    text_ << std::left << std::setw(kTypeWidth) << first << std::right;
  }

  Row& cell(const std::string& text) {
    text_ << ' ' << std::setw(kColumnWidth) << text;
    return *this;
  }
  Row& count(std::size_t value) { return cell(std::to_string(value)); }
  Row& fraction(double value) { return cell(decimals(value)); }
  Row& percent(const std::optional<double>& value) {
    return cell(value ? decimals(100.0 * *value) : "-");
  }

  std::string line() const { return text_.str() + "\n"; }

 private:
  static std::string decimals(double value) {
    std::ostringstream text;
    text << std::fixed << std::setprecision(2) << value;
    return text.str();
  }

  std::ostringstream text_;
};

std::string header() {
  Row row("class");
  for (const char* name : {"IoU", "sAMOTA", "AMOTA", "AMOTP", "MOTA", "MOTP", "IDS", "FRAG", "FP",
                           "FN", "MT", "ML", "recall", "thresh"}) {
    row.cell(name);
  }
  return row.line();
}

/// Share of the true trajectories that must be found.
std::optional<double> shareOf(std::size_t part, const ThresholdScore& score) {
  if (score.trajectories == 0) {
    return std::nullopt;
  }
  return static_cast<double>(part) / static_cast<double>(score.trajectories);
}

std::string line(const TrackingScore& score) {
  const ThresholdScore& best = score.best;
  Row row(nameOf(score.kind.type));
  row.fraction(score.kind.min_overlap);
  row.percent(score.samota).percent(score.amota).percent(score.amotp);
  row.percent(best.mota()).percent(best.motp());
  row.count(best.id_switches).count(best.fragmentations);
  row.count(best.false_positives).count(best.false_negatives);
  row.percent(shareOf(best.mostly_tracked, best)).percent(shareOf(best.mostly_lost, best));
  return row.percent(best.recall()).fraction(best.threshold).line();
}

nlohmann::json toJson(const ThresholdScore& score) {
  return {{"threshold", score.threshold},
          {"mota", evaluation::orNull(score.mota())},
          {"motp", score.motp()},
          {"recall", score.recall()},
          {"precision", score.precision()},
          {"id_switches", score.id_switches},
          {"fragmentations", score.fragmentations},
          {"false_positives", score.false_positives},
          {"false_negatives", score.false_negatives},
          {"matches", score.matches},
          {"required", score.required},
          {"mostly_tracked", evaluation::orNull(shareOf(score.mostly_tracked, score))},
          {"mostly_lost", evaluation::orNull(shareOf(score.mostly_lost, score))}};
}

nlohmann::json toJson(const LevelScore& level) {
  nlohmann::json json = toJson(level.score);
  json["level"] = level.recall;
  json["smota"] = evaluation::orNull(level.score.scaledMota(level.recall));
  return json;
}

nlohmann::json toJson(const TrackingScore& score) {
  nlohmann::json levels = nlohmann::json::array();
  for (const LevelScore& level : score.levels) {
    levels.push_back(toJson(level));
  }
  return {{"class", nameOf(score.kind.type)},
          {"min_overlap", score.kind.min_overlap},
          {"samota", evaluation::orNull(score.samota)},
          {"amota", evaluation::orNull(score.amota)},
          {"amotp", evaluation::orNull(score.amotp)},
          {"best", toJson(score.best)},
          {"levels", levels}};
}

}  // namespace

std::string toTable(const std::vector<TrackingScore>& scores) {
  std::string table = header();
  for (const TrackingScore& score : scores) {
    table += line(score);
  }
  return table;
}

nlohmann::json toJson(const std::vector<TrackingScore>& scores) {
  nlohmann::json json = nlohmann::json::array();
  for (const TrackingScore& score : scores) {
    json.push_back(toJson(score));
  }
  return json;
}

}  // namespace datmo::kitti
