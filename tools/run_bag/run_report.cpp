// SPDX-License-Identifier: BSD-3-Clause
#include "run_report.h"

#include <algorithm>
#include <cmath>
#include <ctime>
#include <iterator>

#include <Eigen/Eigenvalues>

#include "datmo_fusion/common/quantile.h"
#include "datmo_fusion/ros/convert/message_conversion.h"

namespace datmo {

namespace {

constexpr int kReportFormat = 1;

/// A topic, or the pose, is silent if nothing arrives for this time and for this many of its
/// periods.
constexpr double kSilence = 1.0;  // s
constexpr double kSilentPeriods = 5.0;

/// The time in which drops are counted together.
constexpr double kWindow = 2.0;  // s

/// From one of `times` to the next.
struct Gap {
  Stamp from;
  double length = 0.0;  ///< s
};

std::vector<Gap> gapsOf(const std::vector<Stamp>& times) {
  std::vector<Gap> gaps;
  for (std::size_t i = 1; i < times.size(); ++i) {
    gaps.push_back({times[i - 1], secondsBetween(times[i - 1], times[i])});
  }
  return gaps;
}

/// Gaps that are longer than usual; `end`: end of the recording, up to which the last one lasts.
std::vector<Gap> silencesOf(std::vector<Stamp> times, Stamp end) {
  if (times.size() < 2) {
    return {};  // once at the start, like calibrations: there is no period
  }
  std::vector<double> periods;
  for (const Gap& gap : gapsOf(times)) {
    periods.push_back(gap.length);
  }
  const double limit = std::max(kSilence, kSilentPeriods * quantile(periods, 0.5));
  times.push_back(end);
  std::vector<Gap> silences = gapsOf(times);
  silences.erase(std::remove_if(silences.begin(), silences.end(),
                                [&](const Gap& gap) { return gap.length <= limit; }),
                 silences.end());
  return silences;
}

struct Window {
  Stamp from;
  std::size_t count = 0;
};

/// Contains most of the times.
Window fullestWindow(const std::vector<Stamp>& times) {
  Window fullest;
  std::size_t first = 0;
  for (std::size_t last = 0; last < times.size(); ++last) {
    while (secondsBetween(times[first], times[last]) > kWindow) {
      ++first;
    }
    if (last - first + 1 > fullest.count) {
      fullest = {times[first], last - first + 1};
    }
  }
  return fullest;
}

double worstSigma(const geometry_msgs::PoseWithCovarianceStamped& pose) {
  constexpr int kRow = 6;  // of x, y, z and three angles
  const auto& covariance = pose.pose.covariance;
  Eigen::Matrix2d position;
  position << covariance[0], covariance[1], covariance[kRow], covariance[kRow + 1];
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> solver(position, Eigen::EigenvaluesOnly);
  return std::sqrt(std::max(0.0, solver.eigenvalues().maxCoeff()));
}

const char* nameOf(HealthLevel level) {
  return level == HealthLevel::kNoOutput   ? "no output"
         : level == HealthLevel::kDegraded ? "degraded"
                                           : "ok";
}

double processorSeconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

}  // namespace

void RunReport::book(const std::string& topic, Stamp now, const GraphRunner& graph) {
  if (!start_) {
    start_ = now;
  }
  arrivals_[topic].push_back(now);
  for (const StageMonitor* monitor : graph.monitors()) {
    bookDrops(*monitor, now);
    bookCondition(*monitor, now);
  }
}

void RunReport::bookDrops(const StageMonitor& monitor, Stamp now) {
  const std::uint64_t dropped = monitor.droppedCount();
  if (all_drops_[monitor.stage()] == dropped) {
    return;
  }
  all_drops_[monitor.stage()] = dropped;
  for (const auto& [reason, count] : monitor.drops()) {
    Times& times = drops_[{monitor.stage(), reason}];
    times.resize(count, now);
  }
}

void RunReport::bookCondition(const StageMonitor& monitor, Stamp now) {
  const auto open = open_conditions_.find(monitor.stage());
  const bool is_open = open != open_conditions_.end();
  if (is_open && conditions_[open->second].level == monitor.health() &&
      conditions_[open->second].why == monitor.healthReason()) {
    return;
  }
  if (is_open) {
    conditions_[open->second].to = now;
    open_conditions_.erase(open);
  }
  if (monitor.health() != HealthLevel::kOk) {
    open_conditions_[monitor.stage()] = conditions_.size();
    conditions_.push_back(
        {monitor.stage(), monitor.health(), monitor.healthReason(), now, std::nullopt});
  }
}

void RunReport::add(const Publication& publication) {
  // The drift of the map would hide when the vehicle was lost in it.
  if (publication.topic == "pose/local") {
    const auto pose = publication.as<geometry_msgs::PoseWithCovarianceStamped>();
    poses_.push_back({toStamp(pose->header.stamp), worstSigma(*pose)});
  }
}

nlohmann::json RunReport::silences(Stamp end) const {
  nlohmann::json list = nlohmann::json::array();
  for (const auto& [topic, times] : arrivals_) {
    for (const Gap& gap : silencesOf(times, end)) {
      list.push_back({{"topic", topic}, {"from_s", since(gap.from)}, {"for_s", gap.length}});
    }
  }
  return list;
}

nlohmann::json RunReport::dropped() const {
  nlohmann::json list = nlohmann::json::array();
  for (const auto& [what, times] : drops_) {
    const Window window = fullestWindow(times);
    list.push_back({{"stage", what.first},
                    {"reason", what.second},
                    {"count", times.size()},
                    {"max_from_s", since(window.from)},
                    {"max_count", window.count}});
  }
  return list;
}

nlohmann::json RunReport::conditions(Stamp end) const {
  nlohmann::json list = nlohmann::json::array();
  for (const Condition& one : conditions_) {
    list.push_back({{"stage", one.stage},
                    {"level", nameOf(one.level)},
                    {"why", one.why},
                    {"from_s", since(one.from)},
                    {"for_s", secondsBetween(one.from, one.to.value_or(end))}});
  }
  return list;
}

nlohmann::json RunReport::pose(Stamp end) const {
  if (poses_.empty()) {
    return nullptr;
  }
  std::vector<Stamp> stamps;
  std::transform(poses_.begin(), poses_.end(), std::back_inserter(stamps),
                 [](const Pose& one) { return one.stamp; });
  stamps.push_back(std::max(end, stamps.back()));
  const std::vector<Gap> gaps = gapsOf(stamps);
  const Gap& longest = *std::max_element(
      gaps.begin(), gaps.end(), [](const Gap& a, const Gap& b) { return a.length < b.length; });
  const Pose& widest = *std::max_element(
      poses_.begin(), poses_.end(), [](const Pose& a, const Pose& b) { return a.sigma < b.sigma; });
  return {{"longest_gap_s", longest.length},
          {"longest_gap_from_s", since(longest.from)},
          {"first_s", since(poses_.front().stamp)},
          {"widest_sigma_m", widest.sigma},
          {"widest_sigma_at_s", since(widest.stamp)}};
}

nlohmann::json RunReport::loops(const LoopClosingStage& closing) const {
  nlohmann::json list = nlohmann::json::array();
  for (const ClosedLoop& loop : closing.loops()) {
    list.push_back({{"from_s", since(loop.from)},
                    {"to_s", since(loop.to)},
                    {"x_m", loop.motion.x()},
                    {"y_m", loop.motion.y()},
                    {"heading_rad", loop.motion.heading()}});
  }
  const LoopCounts& counts = closing.counts();
  return {{"closed", std::move(list)},
          {"unconfirmed", counts.unconfirmed},
          {"ambiguous", counts.ambiguous},
          {"unlike", counts.unlike},
          {"refuted", counts.refuted}};
}

std::string RunReport::json(const DriveSummary& drive, const RunTime& time, Stamp end,
                            const GraphRunner& graph) const {
  nlohmann::json report = {{"format", kReportFormat},
                           {"start_s", start_.value_or(end).seconds()},
                           {"duration_s", time.data},
                           {"wall_s", time.wall},
                           {"processor_s", processorSeconds()},
                           {"scans", drive.scans()},
                           {"has_truth", has_truth_},
                           {"distance_m", drive.distance()},
                           {"tracks", drive.tracks()},
                           {"pose", pose(end)},
                           {"dropped", dropped()},
                           {"silences", silences(end)},
                           {"conditions", conditions(end)}};
  if (graph.has("loop_closing")) {
    report["loops"] = loops(graph.stage<LoopClosingStage>("loop_closing"));
  }
  return report.dump(1, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
}

}  // namespace datmo
