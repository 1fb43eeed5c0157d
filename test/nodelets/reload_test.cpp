// SPDX-License-Identifier: BSD-3-Clause
// Every nodelet of the package is unloaded from one process and loaded again, while messages
// arrive: the process survives, and in the end there are tracks again.
#include <chrono>
#include <future>
#include <string>
#include <vector>

#include "manager_requests.h"
#include "paced_drive.h"
#include <gtest/gtest.h>

#include <nodelet/nodelet.h>
#include <pluginlib/class_loader.hpp>

namespace datmo::reload_test {
namespace {

const std::string kPackage = "datmo_fusion/";
const PacedRates kRates{50.0, 12.5, 5.0, World::kPixelStep, 0.0, 0};
constexpr double kPatience = 120.0;  // s, on a heavily loaded machine

/// Names of all nodelets that nodelets.xml declares, without the package.
std::vector<std::string> declaredNodelets() {
  pluginlib::ClassLoader<nodelet::Nodelet> loader("nodelet", "nodelet::Nodelet");
  std::vector<std::string> names;
  for (const std::string& type : loader.getDeclaredClasses()) {
    if (type.rfind(kPackage, 0) == 0) {
      names.push_back(type.substr(kPackage.size()));
    }
  }
  return names;
}

class ReloadTest : public testing::Test {
 protected:
  /// Unloads it and loads it again while the drive goes on.
  void reload(const std::string& nodelet) {
    auto reloaded = std::async(std::launch::async, [&nodelet] {
      return unloadNodelet(nodelet) && loadNodelet(nodelet, kPackage + nodelet);
    });
    drive_.run(kPatience, kRates, [&reloaded] {
      return reloaded.wait_for(std::chrono::seconds(0)) == std::future_status::ready;
    });
    EXPECT_TRUE(reloaded.get()) << nodelet;
  }

  /// Drives until there are tracks of a scan that was measured after now.
  bool tracksComeAgain() {
    const double time = drive_.now();
    return drive_.run(kPatience, kRates, [&] {
      const auto& lists = drive_.received();
      return !lists.empty() && lists.back().at - lists.back().latency > time;
    });
  }

  PacedDrive drive_;
};

TEST_F(ReloadTest, EveryNodeletIsUnloadedAndLoadedAgainDuringADrive) {
  const std::vector<std::string> nodelets = declaredNodelets();
  ASSERT_FALSE(nodelets.empty());
  for (const std::string& nodelet : nodelets) {
    ASSERT_TRUE(loadNodelet(nodelet, kPackage + nodelet)) << nodelet;
  }
  const pid_t process = processOf("/perception");
  ASSERT_TRUE(drive_.start({"tracker", "stereo_objects"}));
  ASSERT_TRUE(tracksComeAgain());
  for (const std::string& nodelet : nodelets) {
    reload(nodelet);
  }
  EXPECT_TRUE(tracksComeAgain());
  EXPECT_TRUE(areLoaded(nodelets));
  EXPECT_EQ(processOf("/perception"), process) << "it died, and was started again";
}

}  // namespace
}  // namespace datmo::reload_test
