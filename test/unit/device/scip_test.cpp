// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/device/scip.h"

#include <cmath>
#include <limits>

#include "device/fake_hokuyo.h"
#include <gtest/gtest.h>

#include "datmo_fusion/common/angle.h"
#include "datmo_fusion/device/device_error.h"

namespace datmo::scip_test {
namespace {

using samples::FakeHokuyo;

ScipAnswer answerOf(const std::string& bytes) {
  ScipReader reader;
  reader.feed(bytes);
  return reader.next().value();
}

ScipModel model() {
  ScipAnswer answer{"PP", "00", FakeHokuyo::kModel};
  for (std::string& line : answer.lines) {
    line += ";?";
  }
  return scipModel(answer);
}

std::string reasonOf(const std::string& bytes) {
  try {
    scipScan(answerOf(bytes), model());
  } catch (const DeviceError& error) {
    return error.reason();
  }
  return "";
}

TEST(Scip, ChecksumsAreThoseOfTheSpecification) {
  EXPECT_EQ(scipChecksum("00"), 'P');
  EXPECT_EQ(scipChecksum("99"), 'b');
}

TEST(Scip, AnswersAreCutAtEmptyLines) {
  ScipReader reader;
  reader.feed("QT\n00P\n\nBM\n0");
  const ScipAnswer first = reader.next().value();
  EXPECT_EQ(first.command, "QT");
  EXPECT_EQ(first.status, "00");
  EXPECT_TRUE(first.lines.empty());
  EXPECT_FALSE(reader.next());
  reader.feed("2R\n\n");
  EXPECT_EQ(reader.next().value().status, "02");
}

TEST(Scip, InvalidAnswersAreRefused) {
  ScipReader reader;
  reader.feed("HTTP/1.1 400 Bad Request\nServer: x\n\n");
  EXPECT_THROW(reader.next(), DeviceError);
  ScipReader endless;
  endless.feed(std::string(70000, 'x'));
  EXPECT_THROW(endless.next(), DeviceError);
}

TEST(Scip, AModelHasTheGeometryOfItsSteps) {
  const ScipModel scanner = model();
  EXPECT_EQ(scanner.name, "UST-10LX");
  EXPECT_EQ(scanner.beams(), FakeHokuyo::kBeams);
  EXPECT_NEAR(scanner.firstBearing(), degrees(-45.0), 1e-9);
  EXPECT_NEAR(scanner.beamSpacing(), degrees(22.5), 1e-9);
  EXPECT_DOUBLE_EQ(scanner.scanTime(), 0.025);
  EXPECT_DOUBLE_EQ(scanner.beamTime(), 0.025 / 16.0);
  EXPECT_EQ(scipScanRequest(scanner), "MD0006001001000");
}

TEST(Scip, AChecksumMayBeASemicolon) {
  ScipAnswer answer{"PP", "00", FakeHokuyo::kModel};
  for (std::string& line : answer.lines) {
    line += ";;";
  }
  EXPECT_EQ(scipModel(answer).beamSpacing(), model().beamSpacing());
}

TEST(Scip, ADeviceOtherThanAScannerIsRefused) {
  EXPECT_THROW(scipModel({"PP", "00", {"MODL:radio;x"}}), DeviceError);
  std::vector<std::string> lines = FakeHokuyo::kModel;
  lines[3] = "ARES:0";
  for (std::string& line : lines) {
    line += ";?";
  }
  EXPECT_THROW(scipModel({"PP", "00", lines}), DeviceError);
}

TEST(Scip, AScanHasRangesNoReturnsAndNoMeasurements) {
  const ScipScan scan =
      scipScan(answerOf(FakeHokuyo::scan(0x123456, {1000, 29999, 65533, 7, 20})), model());
  EXPECT_EQ(scan.clock, 0x123456U);
  ASSERT_EQ(scan.ranges.size(), 5U);
  EXPECT_FLOAT_EQ(scan.ranges[0], 1.0F);
  EXPECT_FLOAT_EQ(scan.ranges[1], 29.999F);
  EXPECT_EQ(scan.ranges[2], std::numeric_limits<float>::infinity());
  EXPECT_TRUE(std::isnan(scan.ranges[3]));
  EXPECT_FLOAT_EQ(scan.ranges[4], 0.02F);
}

TEST(Scip, BrokenScansAreRefused) {
  const std::string good = FakeHokuyo::scan(1, {1000, 1000, 1000, 1000, 1000});
  EXPECT_EQ(reasonOf(good), "");
  std::string flipped = good;
  ++flipped[flipped.size() - 6];
  EXPECT_EQ(reasonOf(flipped), "bad_answer");
  EXPECT_EQ(reasonOf(FakeHokuyo::scan(1, {1000, 1000})), "bad_answer");
  EXPECT_EQ(reasonOf("MD0006001001000\n99b\n\n"), "bad_answer");
  EXPECT_EQ(reasonOf("MD0006001001000\n0M" + std::string(1, scipChecksum("0M")) + "\n\n"),
            "device_fault");
}

}  // namespace
}  // namespace datmo::scip_test
