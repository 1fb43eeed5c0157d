// SPDX-License-Identifier: BSD-3-Clause
// The stack in four processes, as on four machines: each has the nodelets of its part, the clocks
// of all are known, and each is restarted when it is killed. The tests run through one drive, in
// this order.
#include <algorithm>
#include <csignal>
#include <iostream>
#include <string>
#include <vector>

#include "chain.h"
#include <gtest/gtest.h>

#include <nodelet/NodeletList.h>
#include <std_msgs/Time.h>

#include "datmo_fusion/ros/convert/risk_conversion.h"

namespace datmo::parts_test {
namespace {

constexpr std::uint32_t kQueue = 1000;
constexpr double kStep = 1.0 / 16.0;  // s

class PartsChain : public StereoChain {
 public:
  bool waitForNodelets() {
    return StereoChain::waitForNodelets({"stereo_objects", "object_fusion", "tracker", "risk"}) &&
           waitFor(
               [this] { return stereo_.getNumPublishers() >= 1 && risk_.getNumPublishers() >= 1; });
  }

  /// Sends all sensors of the next step, without waiting for results.
  void sendNext() {
    now_ += kStep;
    sendMotion(now_);
    sendCloud(world_.cloud(now_));
    sendScan(world_.scan(now_));
  }

  /// Continues the drive until the condition holds.
  bool driveUntil(const std::function<bool()>& condition) {
    const ros::SteadyTime end = ros::SteadyTime::now() + ros::WallDuration(kMaxWait);
    while (!condition()) {
      if (ros::SteadyTime::now() > end) {
        return false;
      }
      sendNext();
      waitFor(condition, kStep);
    }
    return true;
  }

  std::size_t stereo_objects = 0;  ///< lists
  std::size_t risks = 0;           ///< the same

 private:
  static constexpr double kMaxWait = 120.0;  ///< s, as of a Listener

  ros::NodeHandle node_;
  World world_;
  double now_ = 0.0;  ///< s, of the drive
  ros::Subscriber stereo_ = node_.subscribe<ObjectArray>(
      "objects/stereo", kQueue, [this](const ObjectArrayConstPtr& /*list*/) { ++stereo_objects; });
  ros::Subscriber risk_ = node_.subscribe<RiskArray>(
      "risks", kQueue, [this](const RiskArrayConstPtr& /*list*/) { ++risks; });
};

bool hasNodelet(const std::string& manager, const std::string& name) {
  nodelet::NodeletList list;
  if (!ros::service::call(manager + "/list", list)) {
    return false;
  }
  const auto& names = list.response.nodelets;
  return std::count(names.begin(), names.end(), name) > 0;
}

class PartsTest : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    chain_ = new PartsChain();
    ASSERT_TRUE(chain_->waitForNodelets());
    chain_->sendCameraInfo();
    chain_->mountSensors();
    ASSERT_TRUE(chain_->prepareMotion(0.0));
  }

  static void TearDownTestSuite() { delete chain_; }

  /// Kills the process of a part; waits until its output, which `made` counts, is published again.
  static void killAndWait(const std::string& manager, const std::size_t& made) {
    const pid_t killed = processOf(manager);
    ASSERT_GT(killed, 0);
    const ros::SteadyTime start = ros::SteadyTime::now();
    ASSERT_EQ(kill(killed, SIGKILL), 0);
    ASSERT_TRUE(chain_->driveUntil([&] {
      const pid_t now = processOf(manager);
      return now > 0 && now != killed;
    }));
    const std::size_t before = made;  // all from the killed process has arrived
    EXPECT_TRUE(chain_->driveUntil([&] { return made > before; }))
        << chain_->diagnosticMessage("stack");
    std::cout << manager << " worked again " << (ros::SteadyTime::now() - start).toSec()
              << " s after\n";
  }

  static PartsChain* chain_;
};

PartsChain* PartsTest::chain_ = nullptr;

TEST_F(PartsTest, EachProcessHasItsNodeletsAndTogetherTheyPublishRisks) {
  // A manager lists a nodelet some time after the nodelet has advertised its topics.
  const auto isListed = [](const std::string& manager, const std::string& name) {
    return chain_->waitFor([&] { return hasNodelet(manager, name); });
  };
  EXPECT_TRUE(isListed("/perception_sensors", "/motion"));
  EXPECT_TRUE(isListed("/perception_stereo", "/stereo_objects"));
  EXPECT_TRUE(isListed("/perception", "/tracker"));
  EXPECT_TRUE(isListed("/perception_risk", "/risk"));
  EXPECT_TRUE(chain_->driveUntil([] {
    return chain_->risks > 0 && chain_->stereo_objects > 0 && !chain_->tracks.empty();
  })) << chain_->diagnosticMessage("stack");
}

TEST_F(PartsTest, TheClockOfEachIsKnown) {
  for (const std::string part : {"sensors", "stereo", "risk"}) {
    EXPECT_TRUE(chain_->driveUntil([&] {
      const std::string text = chain_->diagnosticText("stack", "clock of perception_" + part);
      return text.find(" +- ") != std::string::npos;
    })) << part;
  }
}

TEST_F(PartsTest, EachOneIsRestartedWhenKilled) {
  ASSERT_NO_FATAL_FAILURE(killAndWait("/perception_stereo", chain_->stereo_objects));
  ASSERT_NO_FATAL_FAILURE(killAndWait("/perception_risk", chain_->risks));
  const int before = chain_->timings["tracker"];
  ASSERT_NO_FATAL_FAILURE(killAndWait("/perception", chain_->risks));
  // On another topic than the risks, so it may arrive later.
  EXPECT_TRUE(chain_->driveUntil([&] { return chain_->timings["tracker"] > before; }));
  ASSERT_NO_FATAL_FAILURE(killAndWait("/perception_sensors", chain_->risks));
  EXPECT_TRUE(chain_->driveUntil([] { return hasNodelet("/perception_sensors", "/motion"); }));
}

TEST_F(PartsTest, AClockThatIsOffIsNamed) {
  ros::NodeHandle node;
  const ros::Publisher answers = node.advertise<PartClock>("clock_answer", kQueue);
  const ros::Subscriber questions = node.subscribe<std_msgs::Time>(
      "clock_question", kQueue, [&answers](const std_msgs::TimeConstPtr& question) {
        PartClock answer;
        answer.process = "/camera";
        answer.asked = question->data;
        answer.answered = question->data + ros::Duration(100.0);  // far above any load's latency
        answers.publish(answer);
      });
  EXPECT_TRUE(chain_->driveUntil([] {
    const std::string said = chain_->diagnosticMessage("stack");
    return said.find("clock of camera: ") != std::string::npos &&
           said.find(" ms ahead, expected at most 10.0 ms") != std::string::npos;
  })) << chain_->diagnosticMessage("stack");
}

}  // namespace
}  // namespace datmo::parts_test
