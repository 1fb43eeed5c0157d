// SPDX-License-Identifier: BSD-3-Clause
// The output of run_bag --report on a drive whose scanner was silent for a while, and repeated a
// scan.
#include <csignal>

#include "run_bag_drive.h"
#include <nlohmann/json.hpp>
#include <sys/resource.h>

namespace datmo {
namespace {

using nlohmann::json;

constexpr int kLastBefore = 9;   ///< scan before the silence
constexpr int kFirstAfter = 28;  ///< and after it
constexpr int kRepeated = 5;     ///< comes twice

class RunBagReport : public RunBag {
 protected:
  json report() {
    arguments_.report = path("report.json");
    run();
    return json::parse(bytes(arguments_.report));
  }

  void writeSilentDrive() const {
    rosbag::Bag bag(arguments_.input, rosbag::bagmode::Write);
    bag.write("/tf_static", toTime(kStart),
              transform(Pose2(2.0, 0.0, 0.0), kStart, "base_link", "scanner"));
    for (int i = 0; i < kScans; ++i) {
      const Stamp stamp = kStart + i * kPeriod;
      const nav_msgs::Odometry odometry = odometryAt(stamp);
      bag.write("/odometry", toTime(stamp), odometry);
      bag.write("/tf", toTime(stamp),
                transform(fromMessage(odometry.pose.pose), stamp, "odom", "base_link"));
      if (i <= kLastBefore || i >= kFirstAfter) {
        bag.write("/scan", toTime(stamp), scanAt(stamp));
      }
      if (i == kRepeated) {
        bag.write("/scan", toTime(stamp + 0.01), scanAt(stamp));
      }
    }
  }
};

/// While it lives, writing a file beyond this size (bytes) fails as on a full disk.
class SmallFiles {
 public:
  explicit SmallFiles(rlim_t size) : handler_(std::signal(SIGXFSZ, SIG_IGN)) {
    getrlimit(RLIMIT_FSIZE, &before_);
    const rlimit small{size, before_.rlim_max};
    setrlimit(RLIMIT_FSIZE, &small);
  }
  ~SmallFiles() {
    setrlimit(RLIMIT_FSIZE, &before_);
    std::signal(SIGXFSZ, handler_);
  }
  SmallFiles(const SmallFiles&) = delete;
  SmallFiles& operator=(const SmallFiles&) = delete;

 private:
  rlimit before_{};
  void (*handler_)(int);
};

TEST_F(RunBagReport, NoneIsLeftOfARunWhoseBagDoesNotFitOnTheDisk) {
  arguments_.report = path("report.json");
  arguments_.text.tum = path("poses.txt");
  {
    const SmallFiles limit(16 * 1024);  // room for both of these
    EXPECT_EQ(failure().rfind(arguments_.output + ": cannot be written", 0), 0U);
  }
  EXPECT_FALSE(std::filesystem::exists(arguments_.report));
  EXPECT_FALSE(std::filesystem::exists(arguments_.text.tum));
}

TEST_F(RunBagReport, OutputsAreWrittenAllTogetherOrNotAtAll) {
  arguments_.report = path("report.json");
  arguments_.text.tum = path("poses.txt");
  std::filesystem::create_directories(arguments_.report + ".part/in_the_way");
  EXPECT_EQ(failure().rfind(arguments_.report + ": cannot be written", 0), 0U);
  EXPECT_FALSE(std::filesystem::exists(arguments_.text.tum));
  EXPECT_FALSE(std::filesystem::exists(arguments_.text.tum + ".part"));
}

TEST_F(RunBagReport, GoodDriveHasAnEmptyReport) {
  const json said = report();
  EXPECT_EQ(said.at("scans"), kScans);
  EXPECT_NEAR(said.at("duration_s"), (kScans - 1) * kPeriod, 1e-6);
  EXPECT_GT(said.at("processor_s"), 0.0);
  EXPECT_TRUE(said.at("silences").empty()) << said;
  EXPECT_TRUE(said.at("dropped").empty()) << said;
  EXPECT_TRUE(said.at("conditions").empty()) << said;
  EXPECT_NEAR(said.at("pose").at("longest_gap_s"), kPeriod, 1e-6);
  EXPECT_FALSE(said.at("has_truth"));
}

TEST_F(RunBagReport, SilenceAndDropsHaveTheirTimes) {
  writeSilentDrive();
  const json said = report();
  ASSERT_EQ(said.at("silences").size(), 1U) << said;
  const json& silence = said.at("silences")[0];
  EXPECT_EQ(silence.at("topic"), "/scan");
  EXPECT_NEAR(silence.at("from_s"), kLastBefore * kPeriod, 1e-6);
  EXPECT_NEAR(silence.at("for_s"), (kFirstAfter - kLastBefore) * kPeriod, 1e-6);
  ASSERT_EQ(said.at("dropped").size(), 1U) << said;
  EXPECT_EQ(said.at("dropped")[0].at("count"), 1);
  EXPECT_NEAR(said.at("dropped")[0].at("max_from_s"), kRepeated * kPeriod + 0.01, 1e-6);
  EXPECT_NEAR(said.at("pose").at("longest_gap_s"), (kFirstAfter - kLastBefore) * kPeriod, 1e-6);
}

TEST_F(RunBagReport, CopiedTruthIsNamed) {
  arguments_.with_truth = true;
  EXPECT_TRUE(report().at("has_truth"));
}

}  // namespace
}  // namespace datmo
