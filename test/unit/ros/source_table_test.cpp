// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/ros/display/source_table.h"

#include <gtest/gtest.h>

namespace datmo::source_table_test {
namespace {

using diagnostic_msgs::DiagnosticArray;
using diagnostic_msgs::DiagnosticStatus;

void add(DiagnosticStatus& status, const std::string& key, const std::string& value) {
  status.values.emplace_back();
  status.values.back().key = key;
  status.values.back().value = value;
}

DiagnosticArray slamReport() {
  DiagnosticArray message;
  DiagnosticStatus status;
  status.name = "grid_slam: stage";
  status.level = DiagnosticStatus::WARN;
  status.message = "no odometry for 2.0 s";
  add(status, "scan received", "120");
  add(status, "scan rate [Hz]", "10.0");
  add(status, "scan age [s]", "0.05");
  add(status, "odometry received", "12");
  add(status, "odometry rate [Hz]", "50.0");
  add(status, "odometry age [s]", "2.00");
  add(status, "latency, last [ms]", "31.5");
  add(status, "processing time, median [ms]", "8.00");
  add(status, "dropped", "4");
  add(status, "dropped: old_stamp", "3");
  add(status, "dropped: bad_scan", "1");
  message.status = {status};
  return message;
}

TEST(SourceTable, EachInputIsARowAndTheFirstHasTheStagesCells) {
  SourceTable table;
  table.update(slamReport(), 10.0);
  const auto rows = table.rows(10.0);
  ASSERT_EQ(rows.size(), 2U);
  EXPECT_EQ(rows[0].stage, "grid_slam");
  EXPECT_EQ(rows[0].input, "scan");
  EXPECT_EQ(rows[0].rate, "10.0");
  EXPECT_EQ(rows[0].age, "0.05");
  EXPECT_EQ(rows[0].latency, "31.5");
  EXPECT_EQ(rows[0].dropped, "4");
  EXPECT_EQ(rows[0].why, "old_stamp 3, bad_scan 1");
  EXPECT_EQ(rows[0].state, "no odometry for 2.0 s");
  EXPECT_EQ(rows[0].level, DiagnosticStatus::WARN);
  EXPECT_EQ(rows[1].input, "odometry");
  EXPECT_EQ(rows[1].age, "2.00");
  EXPECT_EQ(rows[1].dropped, "");
}

TEST(SourceTable, AThirdPartyNodeIsARowToo) {
  DiagnosticArray message;
  message.status.resize(1);
  message.status[0].name = "/drivers: lidar";
  message.status[0].message = "rotor too slow";
  SourceTable table;
  table.update(message, 0.0);
  const auto rows = table.rows(1.0);
  ASSERT_EQ(rows.size(), 1U);
  EXPECT_EQ(rows[0].stage, "drivers: lidar");
  EXPECT_EQ(rows[0].input, "");
  EXPECT_EQ(rows[0].state, "rotor too slow");
}

TEST(SourceTable, ASilentSourceIsStaleUntilItReturns) {
  SourceTable table;
  table.update(slamReport(), 10.0);
  EXPECT_EQ(table.rows(16.0)[1].level, DiagnosticStatus::STALE);
  EXPECT_EQ(table.rows(16.0)[0].state, "silent for 6 s");
  table.update(slamReport(), 16.5);
  EXPECT_EQ(table.rows(17.0).size(), 2U);
  EXPECT_EQ(table.rows(17.0)[0].level, DiagnosticStatus::WARN);
}

TEST(SourceTable, AnEmptyReportIsNoRow) {
  SourceTable table;
  table.update(DiagnosticArray(), 1.0);
  EXPECT_TRUE(table.rows(1.0).empty());
}

}  // namespace
}  // namespace datmo::source_table_test
