// SPDX-License-Identifier: BSD-3-Clause
#include "kitti_tracking/tracking_report.h"

#include <sstream>

#include "made_rows.h"
#include <gtest/gtest.h>

namespace datmo::kitti::tracking_report_test {
namespace {

TrackingScore scoreOf(const EvaluatedKind& kind) {
  Sequence sequence{"0000", {}, {}};
  for (int frame = 0; frame < 200; ++frame) {
    sequence.labels.push_back(rowAt(frame, 1, 0.0));
    sequence.results.push_back(resultAt(frame, frame < 100 ? 1 : 2, 0.0, 2.0));
  }
  return evaluateTracking({sequence}, kind);
}

std::vector<std::string> cellsOf(const std::string& line) {
  std::istringstream stream(line);
  std::vector<std::string> cells;
  for (std::string cell; stream >> cell;) {
    cells.push_back(cell);
  }
  return cells;
}

TEST(TrackingReport, TableHasALineForEachScore) {
  std::istringstream table(toTable({scoreOf({ObjectType::kCar, 0.5})}));
  std::string header;
  std::string line;
  std::getline(table, header);
  std::getline(table, line);
  EXPECT_EQ(cellsOf(header),
            (std::vector<std::string>{"class", "IoU", "sAMOTA", "AMOTA", "AMOTP", "MOTA", "MOTP",
                                      "IDS", "FRAG", "FP", "FN", "MT", "ML", "recall", "thresh"}));
  EXPECT_EQ(cellsOf(line),
            (std::vector<std::string>{"Car", "0.50", "99.99", "99.50", "100.00", "99.50", "100.00",
                                      "1", "1", "0", "0", "100.00", "0.00", "100.00", "2.00"}));
}

TEST(TrackingReport, UndefinedFiguresAreADash) {
  const std::string table = toTable({scoreOf({ObjectType::kCyclist, 0.5})});
  EXPECT_EQ(cellsOf(table.substr(table.find('\n') + 1)).at(2), "-");
}

TEST(TrackingReport, JsonHasEachLevel) {
  const nlohmann::json json = toJson(std::vector<TrackingScore>{scoreOf({})});
  ASSERT_EQ(json.size(), 1U);
  EXPECT_EQ(json[0]["class"], "Car");
  EXPECT_EQ(json[0]["best"]["id_switches"], 1);
  EXPECT_EQ(json[0]["levels"].size(), kRecalls);
  EXPECT_DOUBLE_EQ(json[0]["levels"][0]["smota"], 1.0);
  EXPECT_TRUE(toJson(std::vector<TrackingScore>{scoreOf({ObjectType::kCyclist, 0.5})})[0]["samota"]
                  .is_null());
}

}  // namespace
}  // namespace datmo::kitti::tracking_report_test
