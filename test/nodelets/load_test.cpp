// SPDX-License-Identifier: BSD-3-Clause
// Overload of the nodelets, in real time: three times the sensors' rates, clouds of all pixels and
// lists of 500 objects; then their process is stopped for long enough to fill each queue.
// Everything that is not processed is counted, memory is bounded, and when the load has ended, new
// scans lead to tracks again, without most of those that have waited. The speed of this computer
// decides how much is dropped and how long that takes, in seconds; no check depends on it.
//
// In simulated time, as here, nothing is too old for a stage (arrivedOf()): what waits for too long
// is lost in full queues. live_devices.test checks the age of live messages.
//
// Parameters: ~seconds of load, ~nominal_seconds before it, ~objects in a list, ~out: a JSON file
// for the measurements.
#include <algorithm>
#include <csignal>
#include <cstddef>
#include <limits>
#include <map>
#include <string>
#include <vector>

#include "latency_summary.h"
#include "paced_drive.h"
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace datmo::load_test {
namespace {

const PacedRates kNominal{50.0, 12.5, 5.0, World::kPixelStep, 12.5, 5};
const PacedRates kLoad{150.0, 37.5, 20.0, 1, 37.5, 500};
constexpr std::size_t kDeepestQueue = 200;  // messages, that of the odometry
constexpr double kStandstill = 2.0;         // s, at least
constexpr double kMaxStandstill = 120.0;    // s, for more than the deepest queue has room for

constexpr double kAfter = 6.0;       // s, with the load gone
constexpr double kMaxOverdue = 0.5;  // 1; of the scans of a standstill, those processed after it
constexpr double kMaxMemoryGrowth = 1000.0;  // MiB: full queues of clouds and lists, several times

/// A stage and the sent topics that it subscribes to, as its diagnostics call them.
struct LoadedStage {
  std::string name;
  std::vector<std::string> topics;
  std::vector<std::string> inputs;
};

const std::vector<LoadedStage> kLoadedStages{
    {"grid_slam", {"scan", "odometry"}, {"scan", "odometry"}},
    {"stereo_grid", {"stereo/points2"}, {"points2"}},
    {"stereo_tracker", {"objects/stereo"}, {"objects"}},
};

class LoadTest : public testing::Test {
 protected:
  double received(const LoadedStage& stage) const {
    double sum = 0.0;
    for (const std::string& input : stage.inputs) {
      sum += drive_.diagnostic(stage.name, input + " received");
    }
    return sum;
  }

  double lost(const LoadedStage& stage) const {
    double sum = 0.0;
    for (const std::string& input : stage.inputs) {
      sum += drive_.diagnostic(stage.name, "lost on " + input);
    }
    return sum;
  }

  /// prepareMotion has sent one before the drive began.
  double sent(const LoadedStage& stage) const {
    double sum = stage.name == "grid_slam" ? 1.0 : 0.0;
    for (const std::string& topic : stage.topics) {
      sum += static_cast<double>(drive_.sent(topic));
    }
    return sum;
  }

  /// Stops the process until no queue has room for what is sent meanwhile; returns whether that
  /// happened.
  bool stopProcess(const PacedRates& load) {
    const pid_t process = processOf("/perception");
    if (process <= 0 || kill(process, SIGSTOP) != 0) {
      return false;
    }
    const bool overflowed = standStill(load);
    return kill(process, SIGCONT) == 0 && overflowed;
  }

  /// Sends until no queue can have room for all messages, however slow this machine is.
  bool standStill(const PacedRates& load) {
    drive_.run(kStandstill, load);
    return drive_.run(kMaxStandstill, load, [this, before = sentByTopic()] {
      return std::all_of(before.begin(), before.end(), [this](const auto& topic) {
        return drive_.sent(topic.first) > topic.second + kDeepestQueue;
      });
    });
  }

  std::map<std::string, std::size_t> sentByTopic() const {
    std::map<std::string, std::size_t> result;
    for (const LoadedStage& stage : kLoadedStages) {
      for (const std::string& topic : stage.topics) {
        result[topic] = drive_.sent(topic);
      }
    }
    return result;
  }

  /// Returns the latencies (s) of the tracks that arrived between two times.
  std::vector<double> latencies(double from, double to) const {
    std::vector<double> found;
    for (const PacedDrive::Received& list : drive_.received()) {
      if (list.at >= from && list.at < to) {
        found.push_back(list.latency);
      }
    }
    return found;
  }

  /// Returns the number of lists of tracks of scans that were measured between two times.
  std::size_t listsOfScans(double from, double to) const {
    const auto& lists = drive_.received();
    return static_cast<std::size_t>(
        std::count_if(lists.begin(), lists.end(), [&](const PacedDrive::Received& list) {
          const double measured = list.at - list.latency;
          return measured >= from && measured < to;
        }));
  }

  /// Returns the time (s) from the end of the load until the tracks' latency is permanently as
  /// before.
  double recovery(double end, double nominal) const {
    double last = end;
    for (const PacedDrive::Received& list : drive_.received()) {
      if (list.at > end && list.latency > 2.0 * nominal) {
        last = list.at;
      }
    }
    return last - end;
  }

  double maxMemory(double from, double to) const {
    double max = 0.0;
    for (const PacedDrive::Memory& sample : drive_.memory()) {
      if (sample.at >= from && sample.at < to) {
        max = std::max(max, sample.resident);
      }
    }
    return max;
  }

  nlohmann::json stages() const {
    nlohmann::json list = nlohmann::json::array();
    for (const LoadedStage& stage : kLoadedStages) {
      list.push_back({{"stage", stage.name},
                      {"sent", sent(stage)},
                      {"received", received(stage)},
                      {"lost", lost(stage)},
                      {"stale", drive_.diagnostic(stage.name, "dropped: stale_message")},
                      {"dropped", drive_.diagnostic(stage.name, "dropped")},
                      {"processed", drive_.diagnostic(stage.name, "processed")}});
    }
    return list;
  }

  /// Returns the whole drive, for use as a soak test.
  nlohmann::json samples() const {
    nlohmann::json lists = nlohmann::json::array();
    for (const PacedDrive::Received& list : drive_.received()) {
      lists.push_back({list.at, list.latency});
    }
    nlohmann::json memory = nlohmann::json::array();
    for (const PacedDrive::Memory& sample : drive_.memory()) {
      memory.push_back({sample.at, sample.resident});
    }
    return {{"tracks", lists}, {"memory_mib", memory}};
  }

  PacedDrive drive_;
};

TEST_F(LoadTest, NoLossIsSilentAndAllRecoversAfterTheLoad) {
  PacedRates load = kLoad;
  load.objects = ros::param::param("~objects", load.objects);
  ASSERT_TRUE(drive_.start({"stereo_grid", "grid_fusion", "tracker", "stereo_tracker",
                            "track_fusion", "road_border", "risk"}));
  ASSERT_TRUE(drive_.run(120.0, kNominal, [this] { return !drive_.received().empty(); }));

  const double begin = drive_.now();
  drive_.run(ros::param::param("~nominal_seconds", 3.0), kNominal);
  ASSERT_TRUE(drive_.run(120.0, kNominal, [&] { return drive_.received().back().at >= begin; }));
  const double loaded = drive_.now();
  drive_.run(ros::param::param("~seconds", 3.0), load);
  const double still = drive_.now();
  const std::size_t scans = drive_.sent("scan");
  ASSERT_TRUE(stopProcess(load));
  const double unloaded = drive_.now();
  const std::size_t waiting = drive_.sent("scan") - scans;
  drive_.run(kAfter, kNominal);
  const double end = drive_.now();
  EXPECT_TRUE(drive_.run(120.0, kNominal, [&] {
    return listsOfScans(end, std::numeric_limits<double>::infinity()) > 0;
  })) << "no tracks of new scans any more";
  const std::size_t overdue = listsOfScans(still, unloaded);
  EXPECT_LT(static_cast<double>(overdue), kMaxOverdue * static_cast<double>(waiting))
      << "newer scans come first";

  // Sends nothing more, so that the diagnostics catch up.
  EXPECT_TRUE(drive_.run(120.0, {}, [this] {
    return std::all_of(
        kLoadedStages.begin(), kLoadedStages.end(),
        [this](const LoadedStage& stage) { return received(stage) + lost(stage) == sent(stage); });
  })) << stages().dump(1);

  for (const LoadedStage& stage : kLoadedStages) {
    EXPECT_GT(lost(stage), 0.0) << stage.name << ": more came than fits into its queue";
  }
  const std::vector<double> before = latencies(begin, loaded);
  ASSERT_FALSE(before.empty());
  EXPECT_LT(maxMemory(loaded, end), maxMemory(0.0, loaded) + kMaxMemoryGrowth);
  const nlohmann::json figures = {
      {"nominal", latencySummary(before)},
      {"load", latencySummary(latencies(loaded, still))},
      {"after", latencySummary(latencies(unloaded, end))},
      {"load_s", still - loaded},
      {"still_s", unloaded - still},
      {"objects", load.objects},
      {"waiting_scans", waiting},
      {"overdue_lists", overdue},
      {"recovered_s", recovery(unloaded, quantile(before, 0.99))},
      {"memory_mib",
       {maxMemory(0.0, loaded), maxMemory(loaded, end), drive_.memory().back().resident}},
      {"nominal_from_to_s", {begin, loaded}},
      {"stages", stages()}};
  writeFigures(figures, "samples", samples());
}

}  // namespace
}  // namespace datmo::load_test
