// SPDX-License-Identifier: BSD-3-Clause
// Traffic between the topics and the socket of `v2x_wire`: which wire it is for, and what is
// reported.
#include "datmo_fusion/ros/v2x_wire.h"

#include "../fusion/wire_messages.h"
#include "monitor_counts.h"
#include <gtest/gtest.h>

namespace datmo::v2x_wire_test {
namespace {

const Stamp kNoon = Stamp::fromSeconds(1772366400.0);

class V2xWireTest : public testing::Test {
 protected:
  StageMonitor monitor_{"v2x_wire"};
  V2xWire wire_{StationWireOptions(), monitor_};
};

TEST_F(V2xWireTest, ItsHealthIsThatOfTheSocket) {
  EXPECT_EQ(monitor_.health(), HealthLevel::kNoOutput) << "it does not listen yet";
  wire_.listening();
  EXPECT_EQ(monitor_.health(), HealthLevel::kOk);
  wire_.failed(DeviceError("port_in_use", "another one listens"), kNoon);
  EXPECT_EQ(monitor_.health(), HealthLevel::kNoOutput);
  EXPECT_EQ(samples::drops(monitor_, "port_in_use"), 1U);
}

TEST_F(V2xWireTest, DatagramsGoToTheWireOfTheirKind) {
  const StationTracksMessagePtr tracks = wire_.received(samples::wireCpm().bytes(), kNoon);
  ASSERT_TRUE(tracks);
  EXPECT_EQ(tracks->tracks.size(), 1U);
  // Of a traffic light message all but the header is missing.
  std::string lights = samples::wireCpm().bytes().substr(0, 8);
  lights[1] = 4;
  ASSERT_TRUE(SignalWire::accepts(lights));
  EXPECT_FALSE(wire_.received(lights, kNoon));
  EXPECT_EQ(samples::drops(monitor_, "truncated_message"), 1U);
}

TEST_F(V2xWireTest, BeforeRosTimeBeginsDatagramsAreRefused) {
  EXPECT_THROW(wire_.received(samples::wireCpm().bytes(), Stamp()), InputError);
}

TEST_F(V2xWireTest, WithoutADestinationNothingIsSentAndNothingIsWrong) {
  EXPECT_FALSE(wire_.serveOwn(StationTracksMessage())) << "no lanes were received";
  EXPECT_TRUE(monitor_.warnings().empty());
}

}  // namespace
}  // namespace datmo::v2x_wire_test
